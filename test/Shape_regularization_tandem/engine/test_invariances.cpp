// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What must not change a result: the orientation of normals, where the cloud lies and in which units;
// copies of its points, and how many copies of a scene are side by side.

#include "testing/test_support.h"

BOOST_AUTO_TEST_SUITE(test_invariances)

using scenes::Random;
using scenes::Vec;

// Coordinates that are multiples of 2^-20, so that shifts by them are exact.
Cloud make_cloud(const std::string& name, const scenes::Options& options)
{
  Cloud cloud = to_cloud(scenes::make_scene(name, options));
  const auto rounded = [](double x) { return std::ldexp(std::nearbyint(std::ldexp(x, 20)), -20); };
  for(auto& item : cloud)
    item.first = Kernel::Point_3(rounded(item.first.x()), rounded(item.first.y()), rounded(item.first.z()));
  return cloud;
}

void check_same_labels(const Shapes& a, const Shapes& b, const std::string& name)
{
  const long at = first_difference(a.shape_indices(), b.shape_indices());
  CHECK_AT(at < 0, name + ": the labels differ, first of point " + std::to_string(at));
  for(std::size_t s = 0; s < a.number_of_shapes() && s < b.number_of_shapes(); ++s)
    for(int c = 0; c < 3; ++c)
      CHECK_AT(a.coefficients(s)[c] == b.coefficients(s)[c], name + ": normal of shape " + std::to_string(s));
  CHECK_AT(a.data().coplanar_group == b.data().coplanar_group, name);
}

// Given normals may have any orientation and length. The opposite ones have the same planes.
void check_flipped_normals(const std::string& name, Cloud cloud, const Parameters& parameters, const Shapes& expected)
{
  Random random(1);
  for(auto& item : cloud)
    item.second = std::ldexp(random.bits() % 2 == 0 ? 1 : -1, int(random.bits() % 1201) - 900) * item.second;
  const Shapes shapes = detect(cloud, parameters);
  check_same(shapes, expected, name + ", flipped normals");
  for(auto& item : cloud)
    item.second = -1 * item.second;
  const Shapes opposite = detect(cloud, parameters);
  CHECK_AT(shapes.number_of_shapes() != opposite.number_of_shapes() ||
             shapes.data().coefficients == opposite.data().coefficients,
           name + ", opposite normals");
}

// Shifts by multiples of the grid step, and powers of two, change no labels; feet are other bits, and the same shapes.
BOOST_AUTO_TEST_CASE(test_frames)
{
  for(const auto& [name, options, epsilon] : {std::make_tuple("cube", scene_options(4000, .001), .0071),
                                              std::make_tuple("staircase", scene_options(6000), .011),
                                              std::make_tuple("house", scene_options(8000, .0005, .05), .05)})
    for(const Given given : {Given::normals, Given::nothing}) {
      const Cloud cloud = make_cloud(name, options);
      const Parameters parameters = make_parameters(epsilon, 60);
      const Shapes expected = detect_valid(name, cloud, parameters, given);
      CHECK_AT(expected.number_of_shapes() >= 6, name);
      if(given == Given::normals)
        check_flipped_normals(name, cloud, parameters, expected);
      const double step = expected.statistics().grid_step;
      const Kernel::Vector_3 none(0, 0, 0), shifts[] = {{step, -3 * step, 17 * step}, {1, 2, -3}, {-6.5e5, 6.8e6, 0}};
      const auto check = [&](const Kernel::Vector_3& shift, double scale) {
        const std::string where = name + (", at " + std::to_string(shift.x())) + ", scaled by " + std::to_string(scale);
        const Shapes shapes =
          detect_valid(where, transformed(cloud, scale, shift), make_parameters(scale * epsilon, 60), given);
        if(scale == .3048)
          check_counts(where, shapes, expected.number_of_shapes(), expected.number_of_parallel_groups(),
                       expected.number_of_coplanar_groups());
        else {
          check_same_labels(shapes, expected, where);
          check_equal(shapes.statistics().grid_step, scale * step, where + ": grid step");
        }
      };
      for(const Kernel::Vector_3& shift : shifts)
        check(shift, 1);
      for(double scale : {1024., std::ldexp(1, -60), std::ldexp(1, 80)})
        check(none, scale);
      if(name != std::string("house"))
        check(none, .3048);
    }
}

// A cube that is turned about the vertical, and copies side by side, which the octree cuts in other ways than one: top
// and bottom of all copies are two planes. No two walls are in one plane, for the pitch is not that of their direction.
BOOST_AUTO_TEST_CASE(test_turned_tiles)
{
  const Cloud one =
    to_cloud(scenes::make_scene(scenes::make_cube(scenes::Frame().turned({0, 0, 1}, .2)), scene_options(3000, .0005)));
  for(int n : {1, 4, 7}) {
    Cloud all;
    for(int tile = 0; tile < n * n; ++tile)
      for(const auto& item : transformed(one, 1, {2.3 * (tile / n), 2.3 * (tile % n), 0}))
        all.push_back(item);
    const std::string name = std::to_string(n * n) + " cubes";
    // Across 49 cubes, all of the same noise, the common direction is not as precise as the offsets: one plane costs more
    // than it is worth.
    check_counts(name, detect_valid(name, all, make_parameters(.006, 60)), std::size_t(6 * n * n), 3,
                 std::size_t(4 * n * n + (n < 7 ? 2 : 6)));
  }
}

// Copies of points are what one of them is: the planes of the scene, three walls of a room, 4 by 3 by 2.5, whatever the
// number of copies is. A cluster of all points of a dead sensor beside it changes nothing.
BOOST_AUTO_TEST_CASE(test_copies)
{
  Random random(1);
  for(const std::size_t copies : {1, 4, 20, 70}) { // of many, few surfels in a cell
    Cloud cloud;
    for(int i = 0; i < 900; ++i) {
      const double a = random.uniform(), b = random.uniform();
      const Vec p = i % 3 == 0 ? Vec{4 * a, 3 * b, 0} : i % 3 == 1 ? Vec{4 * a, 3, 2.5 * b} : Vec{4, 3 * a, 2.5 * b};
      cloud.resize(cloud.size() + copies, {Kernel::Point_3(p.x, p.y, p.z), Kernel::Vector_3(0, 0, 1)});
    }
    if(copies == 4)
      cloud.resize(cloud.size() + 70000, {Kernel::Point_3(7, 7, 7), Kernel::Vector_3(0, 0, 1)});
    const std::string name = std::to_string(copies) + " copies";
    const Shapes shapes = detect_valid(name, cloud, make_parameters(.02, 40), Given::nothing);
    check_counts(name, shapes, 3, 3, 3);
    CHECK_AT(copies == 4 || shapes.statistics().coverage > .93, name + ": coverage");
  }
}

BOOST_AUTO_TEST_SUITE_END()
