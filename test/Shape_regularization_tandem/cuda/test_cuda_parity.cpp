// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuda_tag gives the bits of Sequential_tag: on all scenes, for all options, for bad
// input, and after each round.
// After -- an argument SEED: for other random cases, from this seed on.

#include "testing/cuda_support.h"
#include "testing/patches_cloud.h"
#include "testing/property_case.h"
#include "testing/same_result.h"
#include "testing/tolerances.h"

BOOST_AUTO_TEST_SUITE(test_cuda_parity, *boost::unit_test::precondition(has_device))

void check_same_result(const Shapes& device, const Shapes& host, const std::string& name)
{
  check_equal(difference(device, host), "", name);
  CHECK_AT(device.hash() == host.hash(), name + ": hash");
  const CGAL::Tandem::Statistics& t = device.statistics();
  CHECK_AT(t.backend == std::string("cuda") || t.number_of_rounds == 0, name + ": " + t.backend);
}

Shapes compare_with_host(const std::string& name, const Cloud& cloud, const Parameters& parameters, Given given)
{
  const std::string what = name + (given == Given::normals ? "" : ", own normals");
  const Shapes device = detect<Cuda_tag>(cloud, parameters, given);
  check_same_result(device, detect(cloud, parameters, given), what);
  check_valid(cloud, device, what, given);
  return device;
}

BOOST_AUTO_TEST_CASE(all_scenes)
{
  std::size_t shapes = 0;
  for(const std::string& name : scenes::scene_names())
    for(Given given : {Given::normals, Given::nothing})
      for(const Parameters& parameters : {Parameters(), make_parameters(.02, 30)}) // or estimated
        shapes += compare_with_host(name, make_cloud(name, 10000), parameters, given).number_of_shapes();
  CHECK_AT(shapes > 250, std::to_string(shapes) + " shapes in all");
}

// What random cases seldom have.
BOOST_AUTO_TEST_CASE(options)
{
  std::vector<std::pair<std::string, Parameters>> variants;
  const auto add = [&](const std::string& name, auto change) {
    variants.emplace_back(name, make_parameters(.05, 80));
    change(variants.back().second);
  };
  for(std::size_t k : {20, 25, 64}) // two searches, a packet of each size
    add("k = " + std::to_string(k), [&](Parameters& p) { p.k_neighbors = k; });
  for(std::size_t size : {8193, 65536}) // queues in slow memory
    add("cells of " + std::to_string(size), [&](Parameters& p) { p.cell_size = size; });
  add("all shapes", [](Parameters& p) { p.minimum_region_size = 3; });
  const Cloud house = make_cloud("house", 70000), indoor = make_cloud("indoor", 70000);
  for(const auto& [name, parameters] : variants) {
    compare_with_host("house, " + name, house, parameters, Given::normals);
    compare_with_host("indoor, " + name, indoor, parameters, Given::nothing);
  }
}

BOOST_AUTO_TEST_CASE(bad_input)
{
  auto clouds = border_clouds();
  for(std::size_t n : {2, 3, 4, 33, 5000})
    clouds.emplace_back(std::to_string(n) + " equal points", repeated(n));
  bool is_coarse = false;
  for(const auto& [name, cloud] : clouds)
    for(Given given : {Given::normals, Given::nothing})
      for(std::size_t minimum : {std::size_t(3), std::size_t(40)}) {
        const Shapes shapes = compare_with_host(name, cloud, make_parameters(.01, minimum), given);
        is_coarse |= shapes.statistics().is_grid_coarse;
      }
  CHECK(is_coarse);
}

template <class Normal_map, class Tag>
using Detection =
  CGAL::Tandem::Planar_shape_detection_3<CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, First<Kernel>, Normal_map, Tag>>;

template <class Normal_map>
void compare_rounds_with_host(const std::string& name, const Cloud& cloud, const Parameters& parameters)
{
  const auto list = CGAL::Tandem::parameters::settings(parameters).point_map(First<Kernel>()).normal_map(Normal_map());
  Detection<Normal_map, CGAL::Sequential_tag> host(cloud, list);
  Detection<Normal_map, Cuda_tag> device(cloud, list);
  compare_rounds(device, host, name);
  check_same_result(device.shapes(), host.shapes(), name + ", after the end game");
  CHECK_AT(host.shapes().number_of_shapes() >= 2, name);
}

BOOST_AUTO_TEST_CASE(rounds)
{
  for(const char* name : {"house", "staircase", "village"}) {
    const Cloud cloud = make_cloud(name, 20000);
    Parameters parameters = make_parameters(.3, 40);
    parameters.cell_size = 1000;
    compare_rounds_with_host<Second<Kernel>>(name, cloud, parameters);
    compare_rounds_with_host<CGAL::Default>(name + std::string(", own normals"), cloud, parameters);
  }
  const Cloud patches = make_patches_cloud(500, .02); // several passes
  compare_rounds_with_host<Second<Kernel>>("patches", patches, make_parameters(.05, 100));
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
    const Property_case c = Case_maker(seed + i).make_scene(60000);
    shapes += compare_with_host(c.name, c.cloud, c.parameters, c.given).number_of_shapes();
  }
  CHECK_AT(shapes > 100, std::to_string(shapes) + " shapes in all");
}

BOOST_AUTO_TEST_SUITE_END()
