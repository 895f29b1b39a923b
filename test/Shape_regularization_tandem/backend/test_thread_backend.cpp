// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole method on a back end of this test, Thread_backend: the bits of the
// sequential one, for any number of threads. Under ThreadSanitizer this is the
// search for data races.

#include "testing/Thread_backend.h"
#include "testing/test_support.h"

#include <CGAL/Shape_regularization_tandem/Planar_shape_detection_3.h>

#include <string>

BOOST_AUTO_TEST_SUITE(test_thread_backend)

template <class Normal_map>
struct Traits : CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, First<Kernel>, Normal_map, CGAL::Sequential_tag> {
  using Backend = CGAL::Tandem::internal::Thread_backend;
  using Execution = CGAL::Tandem::internal::Execution_on<Backend>;
  explicit Traits(unsigned threads = 1) : threads(threads) {}
  Backend backend() const { return Backend(threads); }
  unsigned threads;
};

template <class Normal_map>
void compare(Given given)
{
  const Cloud house = to_cloud(scenes::make_scene("house", scene_options(9000, .001, .1)));
  Parameters parameters;
  parameters.minimum_region_size = 40;
  parameters.cell_size = 512;
  const Shapes expected = detect(house, parameters, given);
  CHECK(expected.number_of_shapes() >= 6);
  for(unsigned threads : {3u, 8u}) {
    CGAL::Tandem::Planar_shape_detection_3<Traits<Normal_map>> detection(
      house, CGAL::Tandem::parameters::settings(parameters).point_map(First<Kernel>()).normal_map(Normal_map()),
      Traits<Normal_map>(threads));
    detection.detect();
    const Shapes shapes = detection.shapes();
    check_same(shapes, expected, std::to_string(threads) + " threads");
    CHECK(shapes.hash() == expected.hash());
  }
}

BOOST_AUTO_TEST_CASE(given_normals) { compare<Second<Kernel>>(Given::normals); }
BOOST_AUTO_TEST_CASE(estimated_normals) { compare<CGAL::Default>(Given::nothing); }

BOOST_AUTO_TEST_SUITE_END()
