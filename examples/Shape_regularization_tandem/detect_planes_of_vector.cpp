// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Detects the planes of points with normals in a vector.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Shape_regularization_tandem.h>

#include <iostream>
#include <utility>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;

int main()
{
  // Two walls that meet at 89.5 degrees.
  std::vector<Point_with_normal> points;
  for(int i = 0; i < 60; ++i)
    for(int j = 0; j < 60; ++j) {
      points.emplace_back(Kernel::Point_3(.05 * i, .05 * j, 0), Kernel::Vector_3(0, 0, 1));
      points.emplace_back(Kernel::Point_3(.000436 * i, .05 * j, .05 * i), Kernel::Vector_3(1, 0, -.0087));
    }

  namespace np = CGAL::Tandem::parameters;
  const auto shapes = CGAL::Tandem::detect_planes<CGAL::Parallel_if_available_tag>(
    points, np::point_map(Point_map()).normal_map(Normal_map()).maximum_distance(.1).minimum_region_size(200));

  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    std::cout << shapes.points(s).size() << " points on the plane " << shapes.plane(s) << '\n';
  std::cout << shapes.orthogonal_groups().size() << " pair of directions is exactly orthogonal\n";
  return shapes.number_of_shapes() == 2 ? EXIT_SUCCESS : EXIT_FAILURE;
}
