// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuda_tag gives the bits of Sequential_tag: on all scenes, for all options, for bad
// input, and after each round.
// After -- an argument SEED: for other random cases, from this seed on.

#include "testing/cuda_support.h"
#include "testing/patches_cloud.h"
#include "testing/random_case.h"
#include "testing/tolerances.h"

BOOST_AUTO_TEST_SUITE(test_cuda_parity, *boost::unit_test::precondition(has_device))

// Labels, planes, relations, and what the statistics say of the way to them.
void check_same_result(const Shapes& device, const Shapes& host, const std::string& name)
{
  check_same(device, host, name);
  CHECK_AT(device.hash() == host.hash(), name + ": hash");
  const auto &a = device.statistics(), &b = host.statistics();
  CHECK_AT(a.backend == std::string("cuda") || a.number_of_rounds == 0, name + ": " + a.backend);
  check_equal(a.number_of_rounds, b.number_of_rounds, name + ": rounds");
  check_equal(a.number_of_ignored_coordinates, b.number_of_ignored_coordinates, name + ": ignored coordinates");
  check_equal(a.number_of_ignored_normals, b.number_of_ignored_normals, name + ": ignored normals");
  check_equal(a.number_of_ignored_tolerances, b.number_of_ignored_tolerances, name + ": ignored tolerances");
  check_equal(a.number_of_far_points, b.number_of_far_points, name + ": far points");
  check_equal(a.is_grid_coarse, b.is_grid_coarse, name + ": coarse grid");
}

// Returns the number of shapes.
std::size_t compare_with_host(const std::string& name, const Cloud& cloud, const Parameters& parameters, Given given)
{
  const std::string what = name + (given == Given::normals ? "" : ", own normals");
  const Shapes device = detect<Cuda_tag>(cloud, parameters, given);
  check_same_result(device, detect(cloud, parameters, given), what);
  check_valid(cloud, device, what, given);
  return device.number_of_shapes();
}

BOOST_AUTO_TEST_CASE(all_scenes)
{
  std::size_t shapes = 0;
  for(const std::string& name : scenes::scene_names())
    for(Given given : {Given::normals, Given::nothing}) {
      shapes += compare_with_host(name, make_cloud(name, 20000), Parameters(), given); // with estimated parameters
      shapes += compare_with_host(name + ", .02", make_cloud(name, 3000), make_parameters(.02, 30), given);
    }
  CHECK_AT(shapes > 250, std::to_string(shapes) + " shapes in all");
}

// Each option on its own.
std::vector<std::pair<std::string, Parameters>> variants(const Parameters& base)
{
  std::vector<std::pair<std::string, Parameters>> list;
  auto add = [&](const std::string& name, auto change) {
    list.emplace_back(name, base);
    change(list.back().second);
  };
  add("no parallelism", [](Parameters& p) { p.regularize_parallelism = false; });
  add("no orthogonality", [](Parameters& p) { p.regularize_orthogonality = false; });
  add("no coplanarity", [](Parameters& p) { p.regularize_coplanarity = false; });
  add("no regularity",
      [](Parameters& p) { p.regularize_parallelism = p.regularize_orthogonality = p.regularize_coplanarity = false; });
  for(std::size_t k : {3, 8, 12, 20, 25, 64}) // two searches, a packet of each size
    add("k = " + std::to_string(k), [&](Parameters& p) { p.k_neighbors = k; });
  for(std::size_t size : {64, 300, 8192, 8193, 65536}) // queues in fast and in slow memory
    add("cells of " + std::to_string(size), [&](Parameters& p) { p.cell_size = size; });
  add("large epsilon", [](Parameters& p) { p.maximum_distance *= 20; });
  add("small epsilon", [](Parameters& p) { p.maximum_distance /= 50; });
  add("wide angle", [](Parameters& p) { p.maximum_angle = 80; });
  add("narrow angle", [](Parameters& p) { p.maximum_angle = 2; });
  add("no tolerance", [](Parameters& p) { p.angle_tolerance = p.maximum_offset = 0; });
  add("points", [](Parameters& p) { p.surfel_size = 0; });
  add("details", [](Parameters& p) { p.simplicity = p.regularity = 0; });
  add("simple and regular", [](Parameters& p) { p.simplicity = .3, p.regularity = 1; });
  add("all shapes", [](Parameters& p) { p.minimum_region_size = 3; });
  return list;
}

BOOST_AUTO_TEST_CASE(options)
{
  const Cloud house = make_cloud("house", 70000), indoor = make_cloud("indoor", 70000);
  for(const auto& [name, parameters] : variants(make_parameters(.08, 80)))
    compare_with_host("house, " + name, house, parameters, Given::normals);
  for(const auto& [name, parameters] : variants(make_parameters(.03, 80)))
    compare_with_host("indoor, " + name, indoor, parameters, Given::nothing);
}

BOOST_AUTO_TEST_CASE(bad_input)
{
  const Cloud cube = make_cloud("cube", 6000, .001, .02);
  const Cloud far = joined(cube, moved(repeated(1), 30000, 0, 0));
  Cloud invalid = spoiled(cube, 800), line;
  shuffle(invalid, 1);
  for(int i = 0; i < 3000; ++i)
    line.emplace_back(Kernel::Point_3(.001 * i, .002 * i, -.003 * i), Kernel::Vector_3(2, -1, 0));
  std::vector<std::pair<std::string, Cloud>> clouds = {{"duplicates", joined(cube, cube)},
                                                       {"coarse grid", far},
                                                       {"few points", Cloud(cube.begin(), cube.begin() + 12)},
                                                       {"far clusters", joined(cube, moved(cube, 900, -400, 200))},
                                                       {"a line", line},
                                                       {"invalid points", invalid},
                                                       {"huge offset", moved(cube, 4e6, -5e6, 300)},
                                                       {"empty", {}}};
  for(std::size_t n : {1, 2, 3, 4, 33, 5000})
    clouds.emplace_back(std::to_string(n) + " equal points", repeated(n));
  for(const auto& [name, cloud] : clouds)
    for(Given given : {Given::normals, Given::nothing})
      for(std::size_t minimum : {std::size_t(3), std::size_t(40)})
        compare_with_host(name, cloud, make_parameters(.01, minimum), given);
  CHECK(detect<Cuda_tag>(far, make_parameters(.01, 40)).statistics().is_grid_coarse);
}

template <class Normal_map, class Tag>
using Detection =
  CGAL::Tandem::Planar_shape_detection_3<CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, First<Kernel>, Normal_map, Tag>>;

// A difference is reported with the round in which it comes up.
template <class Normal_map>
void compare_rounds(const std::string& name, const Cloud& cloud, const Parameters& parameters)
{
  const auto list = CGAL::Tandem::parameters::settings(parameters).point_map(First<Kernel>()).normal_map(Normal_map());
  Detection<Normal_map, CGAL::Sequential_tag> host(cloud, list);
  Detection<Normal_map, Cuda_tag> device(cloud, list);
  const int failures_before = failures();
  bool goes_on = true;
  for(int round = 0; goes_on && failures() == failures_before; ++round) {
    goes_on = host.iterate();
    const std::string where = name + ", round " + std::to_string(round);
    CHECK_AT(device.iterate() == goes_on, where + ": one of them has ended");
    check_same(device.shapes(), host.shapes(), where);
  }
  host.finish();
  device.finish();
  check_same_result(device.shapes(), host.shapes(), name + ", after the end game");
  CHECK_AT(host.shapes().number_of_shapes() >= 2, name);
}

BOOST_AUTO_TEST_CASE(rounds)
{
  for(const char* name : {"house", "staircase", "village"}) {
    const Cloud cloud = make_cloud(name, 20000);
    Parameters parameters = make_parameters(.3, 40);
    parameters.cell_size = 1000;
    compare_rounds<Second<Kernel>>(name, cloud, parameters);
    compare_rounds<CGAL::Default>(name + std::string(", own normals"), cloud, parameters);
  }
  compare_rounds<Second<Kernel>>("patches", make_patches_cloud(500, .02), make_parameters(.05, 100)); // several passes
}

// Points with tolerances of their own, of several octaves; few have none.
BOOST_AUTO_TEST_CASE(own_tolerances)
{
  scenes::Random random(6);
  Corridor corridor(320, 240, 5, random);
  corridor.cloud[7].first = Kernel::Point_3(0, 0, 0);
  for(const double least : {0., .002})
    for(const Given given : {Given::normals, Given::nothing})
      for(const double surfel_size : {.55, 0.}) {
        const Range_tolerance map = {least, .0065};
        Parameters parameters;
        parameters.surfel_size = surfel_size;
        const std::string name =
          "tolerances from " + std::to_string(least) + (given == Given::normals ? "" : ", own normals");
        const Shapes host = detect_with_tolerances(corridor.cloud, parameters, map, given);
        check_same_result(detect_with_tolerances<Cuda_tag>(corridor.cloud, parameters, map, given), host, name);
        check_equal(host.statistics().number_of_ignored_tolerances, std::size_t(least == 0), name);
        CHECK_AT(host.number_of_shapes() >= 5, name);
      }
}

// However the device is stopped, the shapes are those of the host stopped there.
BOOST_AUTO_TEST_CASE(cancellation)
{
  const Cloud cloud = make_cloud("house", 20000);
  auto cancelled = [&](auto tag, int calls) {
    const CGAL::Tandem::Callback callback = [&calls](double) { return --calls > 0; };
    const auto list = CGAL::Tandem::parameters::settings(make_parameters(.05, 40)).point_map(First<Kernel>());
    return CGAL::Tandem::detect_planes<decltype(tag)>(cloud, list.normal_map(Second<Kernel>()).callback(callback));
  };
  for(int calls = 1; calls <= 5; ++calls) {
    const Shapes device = cancelled(Cuda_tag(), calls);
    const std::string name = "cancelled by call " + std::to_string(calls);
    CHECK_AT(device.is_cancelled(), name);
    check_same(device, cancelled(CGAL::Sequential_tag(), calls), name);
    check_valid(cloud, device, name);
  }
}

BOOST_AUTO_TEST_CASE(random_cases)
{
  std::size_t shapes = 0;
  for(std::uint64_t seed = argument(1, 1), i = 0; i < 30; ++i) {
    const Random_case c = make_random_case(seed + i, 60000);
    shapes += compare_with_host(c.name, c.cloud, c.parameters, c.given);
  }
  CHECK_AT(shapes > 100, std::to_string(shapes) + " shapes in all");
}

BOOST_AUTO_TEST_SUITE_END()
