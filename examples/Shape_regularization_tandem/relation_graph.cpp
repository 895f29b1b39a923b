// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which shapes are parallel, coplanar and orthogonal, and how far each plane is from
// the one that fits its own points best: what regularity has cost.
//   relation_graph [CLOUD [maximum_distance]]

#include "exact_relations.h"
#include "house_cloud.h"

#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/linear_least_squares_fitting_3.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;
using Shapes = CGAL::Tandem::Planar_shapes_3<Kernel>;

double angle_in_degrees(const Kernel::Plane_3& p, const Kernel::Plane_3& q)
{
  const Kernel::Vector_3 m = p.orthogonal_vector(), n = q.orthogonal_vector();
  return std::atan2(std::sqrt(CGAL::cross_product(m, n).squared_length()), std::fabs(m * n)) * 180 / CGAL_PI;
}

void print_shape(const std::vector<Point_with_normal>& points, const Shapes& shapes, std::size_t s)
{
  std::vector<Kernel::Point_3> members;
  for(std::size_t i : shapes.points(s))
    members.push_back(points[i].first);
  Kernel::Plane_3 fitted;
  Kernel::Point_3 center;
  CGAL::linear_least_squares_fitting_3(members.begin(), members.end(), fitted, center, CGAL::Dimension_tag<0>());
  std::printf("shape %2zu: %5zu points, direction %zu, plane %2zu, turned by %.2f degrees, moved by %.3f\n", s,
              members.size(), shapes.parallel_group(s), shapes.coplanar_group(s),
              angle_in_degrees(fitted, shapes.plane(s)), std::sqrt(CGAL::squared_distance(center, shapes.plane(s))));
}

int main(int argc, char* argv[])
{
  const std::vector<Point_with_normal> points = example_cloud(argc, argv);
  const Shapes shapes = CGAL::Tandem::detect_planes(points, CGAL::Tandem::parameters::point_map(Point_map())
                                                              .normal_map(Normal_map())
                                                              .maximum_distance(argc > 2 ? std::atof(argv[2]) : .05));
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    print_shape(points, shapes, s);

  std::printf("orthogonal directions:");
  for(const auto& [g, h] : shapes.orthogonal_groups())
    std::printf(" %d-%d", g, h);
  std::printf("\n");

  const bool is_exact = are_relations_exact(shapes);
  std::printf("%s\n", is_exact ? "all relations are exact" : "a relation is not exact");
  return is_exact && shapes.number_of_shapes() > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
