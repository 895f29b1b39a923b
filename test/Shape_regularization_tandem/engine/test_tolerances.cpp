// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tolerances of points: each point is within its own, a constant one is that of the detection bit for bit, a depth camera
// gets the planes of its scene, near layers stay apart where far noise is wider than their distance, and points without a
// tolerance have no shape.

#include "testing/tolerances.h"

#include <CGAL/Shape_regularization_tandem/distance_of_noise.h>

#include <limits>
#include <map>

BOOST_AUTO_TEST_SUITE(test_tolerances)

// In its own arithmetic.
void check_distances(const Cloud& cloud, const Shapes& shapes, const Range_tolerance& map, const std::string& name,
                     Given given = Given::normals)
{
  std::size_t beyond = 0;
  for(std::size_t i = 0; i < cloud.size(); ++i) {
    if(shapes.shape_index(i) < 0)
      continue;
    const auto& c = shapes.coefficients(std::size_t(shapes.shape_index(i)));
    const auto& p = cloud[i].first;
    const double distance = std::fabs(c[0] * p.x() + c[1] * p.y() + c[2] * p.z() + c[3]);
    beyond += distance > (std::min)(get(map, cloud[i]), shapes.parameters().maximum_distance) + 1e-12;
  }
  check_equal(beyond, std::size_t(0), name + ": points beyond their tolerances");
  check_equal(violation_with_tolerances(cloud, shapes, map, given), std::string(), name);
}

void test_constant_tolerance()
{
  for(const char* scene : {"house", "indoor"})
    for(const Given given : {Given::normals, Given::nothing}) {
      const Cloud cloud = to_cloud(scenes::make_scene(scene, scene_options(6000, .001, .02)));
      const Parameters parameters = make_parameters(.04, 40);
      const Shapes expected = detect(cloud, parameters, given);
      CHECK_AT(expected.number_of_shapes() > 4, scene);
      for(const double tolerance : {.04, 1., HUGE_VAL}) {
        const Range_tolerance map = {tolerance, 0};
        const std::string name = std::string(scene) + ", tolerance " + std::to_string(tolerance);
        const Shapes shapes = detect_with_tolerances(cloud, parameters, map, given);
        check_same(shapes, expected, name);
        CHECK_AT(shapes.hash() == expected.hash(), name);
        check_equal(violation_with_tolerances(cloud, shapes, map, given), std::string(), name);
        check_same(detect_with_tolerances<CGAL::Parallel_if_available_tag>(cloud, parameters, map, given), expected,
                   name + ", parallel");
      }
      // Epsilon is that of the tolerances, too.
      Parameters estimated = parameters;
      estimated.maximum_distance = 0;
      check_same(detect_with_tolerances(cloud, estimated, Range_tolerance{.04, 0}, given), expected, "estimated");
    }
}

// The planes of the scene, and no others: each label has one plane, and each plane one label.
void test_depth_camera(std::uint64_t seed, double tolerance_at_one)
{
  scenes::Random random(seed);
  const Corridor corridor(160 + 20 * int(seed), 120, 4.2 + .4 * double(seed), random);
  const Range_tolerance map = {0, tolerance_at_one};
  Parameters parameters;
  parameters.minimum_region_size = 60;
  for(const Given given : {Given::normals, Given::nothing}) {
    const std::string name = "seed " + std::to_string(seed) + (given == Given::normals ? "" : ", own normals");
    const Shapes shapes = detect_with_tolerances(corridor.cloud, parameters, map, given);
    std::map<int, std::size_t> wall_of_plane;
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
      std::size_t count[5] = {0, 0, 0, 0, 0};
      for(const std::size_t i : shapes.points(s))
        ++count[corridor.label[i]];
      const std::size_t wall = std::size_t(std::max_element(count, count + 5) - count);
      // Where walls are as noisy as they are wide, normals that are estimated at an edge are those of the other one.
      const double least = given == Given::normals ? .97 : .75;
      CHECK_AT(double(count[wall]) > least * double(shapes.size(s)),
               name + ": a shape of two walls: " + std::to_string(count[wall]) + " of " +
                 std::to_string(shapes.size(s)));
      wall_of_plane[shapes.coplanar_group(s)] = wall;
    }
    check_equal(wall_of_plane.size(), std::size_t(5), name + ": planes");
    CHECK_AT(shapes.statistics().coverage > .95, name);
    check_distances(corridor.cloud, shapes, map, name, given);
    check_same(detect_with_tolerances<CGAL::Parallel_if_available_tag>(corridor.cloud, parameters, map, given), shapes,
               name + ", parallel");
    Cloud shuffled = corridor.cloud;
    shuffle(shuffled, seed);
    CHECK_AT(labeled_points(shuffled, detect_with_tolerances(shuffled, parameters, map, given)) ==
               labeled_points(corridor.cloud, shapes),
             name + ", shuffled");
  }
}

// Two layers near the origin, closer to each other than the tolerance of what is far.
void test_layers_beside_noise()
{
  scenes::Random random(8);
  Cloud cloud;
  for(int i = 0; i < 6000; ++i) {
    const double a = random.uniform(), b = random.uniform();
    const bool is_upper = i % 2 == 0;
    add(cloud, {a - .5, b - .5, (is_upper ? .012 : 0) + .001 * random.gaussian()}, {0, 0, 1});
    add(cloud, {8 * a - 4, 8 * b - 4, 10 + .05 * random.gaussian()}, {0, 0, 1});
  }
  const Range_tolerance map = {.003, .0016};
  Parameters parameters;
  parameters.minimum_region_size = 100;
  const Shapes shapes = detect_with_tolerances(cloud, parameters, map);
  check_equal(shapes.number_of_shapes(), std::size_t(3), "two layers, and noise far away");
  check_distances(cloud, shapes, map, "two layers");
  std::size_t mixed = 0;
  for(std::size_t i = 0; i < cloud.size(); i += 4)
    mixed += shapes.shape_index(i) >= 0 && shapes.shape_index(i) == shapes.shape_index(i + 2);
  check_equal(mixed, std::size_t(0), "points of both layers in one shape");
}

// Each tenth point has none.
struct Partial_tolerance : Range_tolerance {
  double other;
  Kernel::FT below;

  friend double get(const Partial_tolerance& map, const key_type& item)
  {
    return item.first.x() < map.below ? map.other : map.least;
  }
};

void test_points_without_tolerance()
{
  const Cloud cloud = to_cloud(scenes::make_scene("house", scene_options(5000)));
  double below = 0;
  std::vector<double> x;
  for(const auto& item : cloud)
    x.push_back(item.first.x());
  std::nth_element(x.begin(), x.begin() + 500, x.end());
  below = x[500];
  for(const double other : {0., -1., std::numeric_limits<double>::quiet_NaN(), -HUGE_VAL}) {
    const Partial_tolerance map = {{.02, 0}, other, below};
    const Shapes shapes = detect_with_tolerances(cloud, make_parameters(.02, 40), map);
    const std::string name = "tolerance " + std::to_string(other);
    check_equal(shapes.statistics().number_of_ignored_tolerances, std::size_t(500), name);
    CHECK_AT(shapes.number_of_shapes() > 3, name);
    for(std::size_t i = 0; i < cloud.size(); ++i)
      CHECK_AT(shapes.shape_index(i) < 0 || cloud[i].first.x() >= below, name);
    check_equal(violation_with_tolerances(cloud, shapes, map), std::string(), name);
  }
  // So small that nothing is within.
  const Partial_tolerance tiny = {{.02, 0}, 1e-300, below};
  const Shapes shapes = detect_with_tolerances(cloud, make_parameters(.02, 40), tiny);
  for(std::size_t i = 0; i < cloud.size(); ++i)
    CHECK_AT(shapes.shape_index(i) < 0 || cloud[i].first.x() >= below, "tiny tolerances");
  check_equal(violation_with_tolerances(cloud, shapes, tiny), std::string(), "tiny tolerances");
}

// The checker looks at the tolerance of each point.
void test_checker()
{
  const Cloud cloud = to_cloud(scenes::make_scene("house", scene_options(5000, .001)));
  const Shapes shapes = detect(cloud, make_parameters(.04, 40));
  const std::string why = violation_with_tolerances(cloud, shapes, Range_tolerance{.01, 0});
  CHECK_AT(why.find("too far from its plane") != std::string::npos, why);
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  test_constant_tolerance();
  for(std::uint64_t seed = 1; seed <= 3; ++seed)
    test_depth_camera(seed, CGAL::Tandem::distance_of_noise(.0028));
  test_depth_camera(4, 3 * .0028);
  test_layers_beside_noise();
  test_points_without_tolerance();
  test_checker();
}

BOOST_AUTO_TEST_SUITE_END()
