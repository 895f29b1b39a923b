// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole method on a back end of this test, Thread_backend: the bits of the
// sequential one, for any number of threads. Under ThreadSanitizer this is the
// search for data races.

#include "testing/Thread_backend.h"
#include "testing/checks.h"
#include "testing/scenes.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Shape_regularization_tandem/Planar_shape_detection_3.h>

#include <iostream>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_thread_backend)

using Kernel = CGAL::Simple_cartesian<double>;
using Item = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Range = std::vector<Item>;
using Point_map = CGAL::First_of_pair_property_map<Item>;
using Given_normals = CGAL::Second_of_pair_property_map<Item>;

template <class Normal_map>
using Sequential_traits = CGAL::Tandem::Tandem_traits_3<Kernel, Range, Point_map, Normal_map, CGAL::Sequential_tag>;

template <class Normal_map>
struct Thread_traits : Sequential_traits<Normal_map> {
  using Backend = CGAL::Tandem::internal::Thread_backend;
  using Execution = CGAL::Tandem::internal::Execution_on<Backend>;
  explicit Thread_traits(unsigned threads = 1) : threads(threads) {}
  Backend backend() const { return Backend(threads); }
  unsigned threads;
};

Range make_range(const std::string& name, std::size_t size)
{
  CGAL::Tandem::scenes::Options options;
  options.points = size;
  options.noise = .001;
  options.outliers = .1;
  const CGAL::Tandem::scenes::Scene scene = CGAL::Tandem::scenes::make_scene(name, options);
  Range range;
  for(std::size_t i = 0; i < scene.points.size(); ++i) {
    const auto& p = scene.points[i];
    const auto& n = scene.normals[i];
    range.emplace_back(Kernel::Point_3(p.x, p.y, p.z), Kernel::Vector_3(n.x, n.y, n.z));
  }
  return range;
}

template <class Traits, class Parameters>
std::uint64_t hash_of(const Range& range, const Parameters& np, const Traits& traits, std::size_t& shapes)
{
  CGAL::Tandem::Planar_shape_detection_3<Traits> detection(range, np, traits);
  detection.detect();
  shapes = detection.shapes().number_of_shapes();
  return detection.shapes().hash();
}

template <class Normal_map, class Parameters>
void compare(const std::string& name, const Range& range, const Parameters& np)
{
  std::size_t expected_shapes = 0, shapes = 0;
  const std::uint64_t expected = hash_of(range, np, Sequential_traits<Normal_map>(), expected_shapes);
  CHECK_AT(expected_shapes >= 6, name);
  for(unsigned threads : {1u, 3u, 8u})
    CHECK_AT(hash_of(range, np, Thread_traits<Normal_map>(threads), shapes) == expected,
             name + ", " + std::to_string(threads) + " threads: " + std::to_string(shapes) + " shapes, sequential " +
               std::to_string(expected_shapes));
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  namespace np = CGAL::Tandem::parameters;
  const Range house = make_range("house", 12000);
  const auto given = np::point_map(Point_map()).minimum_region_size(40).cell_size(512);
  compare<Given_normals>("given normals", house, given.normal_map(Given_normals()));
  compare<CGAL::Default>("estimated normals", house, given);
}

BOOST_AUTO_TEST_SUITE_END()
