// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the end game must not lose: faces of hardly more than the minimum size, to relations; and points that fit a
// shape around them.

#include "testing/test_support.h"

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_end_game)

namespace {

constexpr double epsilon = .02;

// A floor, and small faces over it that are nearly parallel to it: it would take so many of their points that they fall
// below the minimum size.
BOOST_AUTO_TEST_CASE(test_small_faces)
{
  const std::size_t floor_size = 20000, face_size = 104;
  const int columns = 6;
  const double width = .6, turn = 1.8 * epsilon / width;
  scenes::Random random(1);
  Cloud cloud;
  for(std::size_t i = 0; i < floor_size; ++i)
    cloud.emplace_back(Kernel::Point_3(columns * random.uniform(), columns * random.uniform(), 0),
                       Kernel::Vector_3(0, 0, 1));
  for(int face = 0; face < columns * columns; ++face)
    for(std::size_t i = 0; i < face_size; ++i) {
      const double x = width * random.uniform(), y = width * random.uniform();
      const double z = 10 * epsilon + turn * x + .3 * epsilon * random.gaussian();
      cloud.emplace_back(Kernel::Point_3(face % columns + x, face / columns + y, z), Kernel::Vector_3(-turn, 0, 1));
    }
  const Shapes shapes = detect(cloud, make_parameters(epsilon, 100));
  check_equal(shapes.number_of_shapes(), std::size_t(1 + columns * columns), "a floor and small faces over it");
}

// Each free point is far from the planes of the shapes of its neighbors, or turned away from them. Those that the exact
// check frees, and those of slabs of clutter, may be near.
BOOST_AUTO_TEST_CASE(test_free_points)
{
  using Point_of = CGAL::Pointer_property_map<Kernel::Point_3>::const_type;
  using Traits = CGAL::Search_traits_adapter<std::size_t, Point_of, CGAL::Search_traits_3<Kernel>>;
  using Search = CGAL::Orthogonal_k_neighbor_search<Traits>;
  const scenes::Scene scene = scenes::make_scene("part", scene_options(100000, .0003, .02));
  const Cloud cloud = to_cloud(scene);
  Parameters parameters = make_parameters(epsilon, 200);
  const Shapes shapes = detect(cloud, parameters);
  std::vector<Kernel::Point_3> point;
  for(const auto& p : cloud)
    point.push_back(p.first);
  std::vector<std::size_t> index(point.size());
  std::iota(index.begin(), index.end(), std::size_t(0));
  const Point_of point_of = CGAL::make_property_map(static_cast<const std::vector<Kernel::Point_3>&>(point));
  Search::Tree tree(index.begin(), index.end(), Search::Splitter(), Traits(point_of));
  const double cosine = CGAL::Tandem::internal::cosine_deg(parameters.maximum_angle);
  std::size_t free = 0, near = 0;
  for(std::size_t i = 0; i < cloud.size(); ++i) {
    if(shapes.shape_index(i) >= 0)
      continue;
    ++free;
    bool is_near = false;
    for(const auto& found : Search(tree, point[i], 13, 0, true, Search::Distance(point_of))) {
      const int s = shapes.shape_index(found.first);
      if(s < 0)
        continue;
      const auto& c = shapes.coefficients(std::size_t(s));
      const Kernel::Vector_3 normal(c[0], c[1], c[2]);
      const double distance = normal * (point[i] - CGAL::ORIGIN) + c[3];
      is_near = is_near || (std::abs(distance) <= .999 * parameters.maximum_distance &&
                            std::abs(normal * cloud[i].second) >= cosine * 1.001);
    }
    near += is_near;
  }
  CHECK_AT(free > 0 && 300 * near <= free,
           std::to_string(near) + " of " + std::to_string(free) + " free points fit the shape of a neighbor");
}

} // namespace

BOOST_AUTO_TEST_SUITE_END()
