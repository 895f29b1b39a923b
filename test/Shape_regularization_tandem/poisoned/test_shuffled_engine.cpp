// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole method on Late_backend, which shuffles, and works as late as it may: after each round, and at the end, the
// bits of what works at once, in another order. A difference is reported with the round in which it comes up. After --
// an argument SEED repeats one random case. One engine is compiled here, which takes long; others compare back ends.

#include "testing/Late_backend.h"
#include "testing/patches_cloud.h"
#include "testing/random_case.h"
#include "testing/tolerances.h"

BOOST_AUTO_TEST_SUITE(test_shuffled_engine)

using CGAL::Tandem::internal::Late_backend;
using CGAL::Tandem::internal::Work;

template <class Normal_map>
struct Traits : CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, First<Kernel>, Normal_map, CGAL::Sequential_tag> {
  using Backend = Late_backend;
  using Execution = CGAL::Tandem::internal::Execution_on<Backend>;
  Traits(std::uint64_t s = 1, Work w = Work::late) : seed(s), work(w) {}
  Backend backend() const { return Backend(seed, work); }
  std::uint64_t seed;
  Work work;
};

// Returns the number of shapes. list: named parameters.
template <class Normal_map, class List>
std::size_t compare_lists(const std::string& name, const Cloud& cloud, const List& list, std::uint64_t seed)
{
  using Detection = CGAL::Tandem::Planar_shape_detection_3<Traits<Normal_map>>;
  Detection expected(cloud, list, {~seed, Work::at_once}), late(cloud, list, {seed, Work::late});
  const int failures_before = failures();
  bool goes_on = true;
  for(int round = 0; goes_on && failures() == failures_before; ++round) {
    goes_on = expected.iterate();
    const std::string where = name + ", seed " + std::to_string(seed) + ", round " + std::to_string(round);
    CHECK_AT(late.iterate() == goes_on, where + ": one of them has ended");
    check_same(late.shapes(), expected.shapes(), where);
  }
  expected.finish();
  late.finish();
  const std::string where = name + ", seed " + std::to_string(seed) + ", after the end game";
  check_same(late.shapes(), expected.shapes(), where);
  CHECK_AT(late.shapes().hash() == expected.shapes().hash(), where + ": the normals differ");
  return failures() > failures_before ? 0 : expected.shapes().number_of_shapes();
}

std::size_t compare(const Random_case& c, std::uint64_t seed)
{
  const auto list = CGAL::Tandem::parameters::settings(c.parameters).point_map(First<Kernel>());
  return c.given == Given::normals
           ? compare_lists<Second<Kernel>>(c.name, c.cloud, list.normal_map(Second<Kernel>()), seed)
           : compare_lists<CGAL::Default>(c.name, c.cloud, list, seed);
}

// Points with tolerances of their own, of several octaves.
BOOST_AUTO_TEST_CASE(test_tolerances)
{
  scenes::Random random(1);
  const Corridor corridor(100, 80, 5, random);
  const auto list = CGAL::Tandem::parameters::point_map(First<Kernel>()).cell_size(500);
  const Range_tolerance map = {.002, .0065};
  CHECK(compare_lists<CGAL::Default>("tolerances", corridor.cloud, list.maximum_distance_map(map), 2) >= 4);
}

// Patches take several passes.
BOOST_AUTO_TEST_CASE(test_scenes)
{
  CHECK(compare({"patches", make_patches_cloud(100, .02), make_parameters(.05, 100), Given::normals}, 1) >= 2);
  std::uint64_t seed = 1;
  for(const char* name : {"house", "staircase", "indoor", "slope"}) {
    const scenes::Scene scene = scenes::make_scene(name, scene_options(6000, .001, .05));
    Parameters parameters = make_parameters(.004 * scene.diagonal, 40);
    parameters.cell_size = ++seed % 2 == 0 ? 8192 : 300;
    parameters.k_neighbors = 10 + 2 * seed;
    for(Given given : {Given::normals, Given::nothing})
      CHECK_AT(compare({name, to_cloud(scene), parameters, given}, seed) >= 2, name);
  }
}

BOOST_AUTO_TEST_CASE(test_random_cases)
{
  int with_shapes = 0;
  const std::uint64_t given = argument(1, 0), first = given > 0 ? given : 1, count = given > 0 ? 1 : 20;
  for(std::uint64_t seed = first; seed < first + count; ++seed)
    with_shapes += compare(make_random_case(seed, 6000), seed) >= 2;
  CHECK_AT(count == 1 || with_shapes >= 3, std::to_string(with_shapes) + " cases with shapes");
}

BOOST_AUTO_TEST_SUITE_END()
