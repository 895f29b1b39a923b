// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole method on Late_backend, which shuffles, and works as late as it may: after each
// round, and at the end, the bits of the sequential one. A difference is reported with the
// round in which it comes up. After -- an argument SEED repeats one random case.

#include "testing/Late_backend.h"
#include "testing/patches_cloud.h"
#include "testing/random_case.h"
#include "testing/tolerances.h"

BOOST_AUTO_TEST_SUITE(test_shuffled_engine)

using Point_map = First<Kernel>;

template <class Normal_map>
using Sequential_traits = CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, Point_map, Normal_map, CGAL::Sequential_tag>;

template <class Normal_map>
struct Shuffled_traits : Sequential_traits<Normal_map> {
  using Backend = CGAL::Tandem::internal::Late_backend;
  using Execution = CGAL::Tandem::internal::Execution_on<Backend>;
  explicit Shuffled_traits(std::uint64_t seed = 1) : seed(seed) {}
  Backend backend() const { return Backend(seed); }
  std::uint64_t seed;
};

// Returns the number of shapes. list: named parameters.
template <class Normal_map, class List>
std::size_t compare_lists(const std::string& name, const Cloud& cloud, const List& list, std::uint64_t seed)
{
  CGAL::Tandem::Planar_shape_detection_3<Sequential_traits<Normal_map>> expected(cloud, list);
  CGAL::Tandem::Planar_shape_detection_3<Shuffled_traits<Normal_map>> shuffled(cloud, list,
                                                                               Shuffled_traits<Normal_map>(seed));
  const int failures_before = failures();
  bool goes_on = true;
  for(int round = 0; goes_on && failures() == failures_before; ++round) {
    goes_on = expected.iterate();
    const std::string where = name + ", seed " + std::to_string(seed) + ", round " + std::to_string(round);
    CHECK_AT(shuffled.iterate() == goes_on, where + ": one of them has ended");
    check_same(shuffled.shapes(), expected.shapes(), where);
  }
  if(failures() > failures_before)
    return 0;
  expected.finish();
  shuffled.finish();
  check_same(shuffled.shapes(), expected.shapes(), name + ", seed " + std::to_string(seed) + ", after the end game");
  return expected.shapes().number_of_shapes();
}

template <class Normal_map>
std::size_t compare(const std::string& name, const Cloud& cloud, const Parameters& parameters, std::uint64_t seed)
{
  return compare_lists<Normal_map>(
    name, cloud, CGAL::Tandem::parameters::settings(parameters).point_map(Point_map()).normal_map(Normal_map()), seed);
}

// Points with tolerances of their own, of several octaves.
BOOST_AUTO_TEST_CASE(test_tolerances)
{
  scenes::Random random(1);
  const Corridor corridor(100, 80, 5, random);
  const auto list =
    CGAL::Tandem::parameters::point_map(Point_map()).cell_size(500).maximum_distance_map(Range_tolerance{.002, .0065});
  CHECK(compare_lists<Second<Kernel>>("tolerances", corridor.cloud, list.normal_map(Second<Kernel>()), 1) >= 4);
  CHECK(compare_lists<CGAL::Default>("tolerances without normals", corridor.cloud, list, 2) >= 4);
}

BOOST_AUTO_TEST_CASE(test_scenes)
{
  struct Case {
    const char* name;
    scenes::Options options;
    double epsilon;
    std::size_t minimum;
  };
  std::uint64_t seed = 1;
  for(const Case& c :
      {Case{"house", scene_options(8000, .001, .1), .08, 40},
       Case{"staircase", scene_options(3000, .001, .05), .01, 30},
       Case{"indoor", scene_options(10000, .0005, .05), .03, 40}, Case{"slope", scene_options(4000, .001), .03, 50}}) {
    const Cloud cloud = to_cloud(scenes::make_scene(c.name, c.options));
    Parameters parameters = make_parameters(c.epsilon, c.minimum);
    parameters.cell_size = ++seed % 2 == 0 ? 8192 : 300;
    parameters.k_neighbors = 10 + 2 * seed;
    CHECK_AT(compare<Second<Kernel>>(c.name, cloud, parameters, seed) >= 2, c.name);
    CHECK_AT(compare<CGAL::Default>(c.name, cloud, parameters, seed) >= 2, c.name);
  }
}

// Several passes.
BOOST_AUTO_TEST_CASE(test_patches)
{
  CHECK(compare<Second<Kernel>>("patches", make_patches_cloud(100, .02), make_parameters(.05, 100), 1) >= 2);
}

BOOST_AUTO_TEST_CASE(test_random_cases)
{
  int with_shapes = 0;
  const std::uint64_t given = argument(1, 0), first = given > 0 ? given : 1, count = given > 0 ? 1 : 20;
  for(std::uint64_t seed = first; seed < first + count; ++seed) {
    const Random_case c = make_random_case(seed, 6000);
    with_shapes += (c.given == Given::normals ? compare<Second<Kernel>>(c.name, c.cloud, c.parameters, seed)
                                              : compare<CGAL::Default>(c.name, c.cloud, c.parameters, seed)) >= 2;
  }
  CHECK_AT(count == 1 || with_shapes >= 3, std::to_string(with_shapes) + " cases with shapes");
}

BOOST_AUTO_TEST_SUITE_END()
