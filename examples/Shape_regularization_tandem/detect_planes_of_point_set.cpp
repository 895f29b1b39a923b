// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Detects the planes of a CGAL::Point_set_3 and writes it with the shape of each point.
//   detect_planes_of_point_set [CLOUD [maximum_distance]]

#include "house_cloud.h"

#include <CGAL/Point_set_3.h>
#include <CGAL/Point_set_3/IO.h>
#include <CGAL/Shape_regularization_tandem.h>

#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_set = CGAL::Point_set_3<Kernel::Point_3>;

int main(int argc, char* argv[])
{
  Point_set points;
  points.add_normal_map();
  for(const auto& [point, normal] : example_cloud(argc, argv))
    points.insert(point, normal);

  // A point set brings its maps along, so that only the parameters are to be given.
  const auto shapes = CGAL::Tandem::detect_planes(
    points, CGAL::Tandem::parameters::maximum_distance(argc > 2 ? std::atof(argv[2]) : .05));

  // An int property "shape", -1 for points without one: viewers color by it.
  CGAL::Tandem::add_shape_property(points, shapes);
  CGAL::IO::write_point_set("shapes.ply", points);

  std::cout << shapes.number_of_shapes() << " shapes in " << shapes.number_of_coplanar_groups() << " planes of "
            << shapes.number_of_parallel_groups() << " directions, " << shapes.statistics().number_of_assigned_points
            << " of " << points.size() << " points\n";
  return EXIT_SUCCESS;
}
