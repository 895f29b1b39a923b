// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program replace_ransac_before.cpp with Tandem in place of Efficient RANSAC and
// regularize_planes(); compare the two with diff.

#include "far_points.h"
#include "house_cloud.h"

#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/structure_point_set.h>

#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;
using Points = std::vector<Point_with_normal>;
using Plane_map = CGAL::Identity_property_map<Kernel::Plane_3>;

int main(int argc, char* argv[])
{
  const Points points = example_cloud(argc, argv);
  const auto shapes = CGAL::Tandem::detect_planes(points, CGAL::Tandem::parameters::point_map(Point_map())
                                                            .normal_map(Normal_map())
                                                            .maximum_distance(.05)
                                                            .maximum_angle(25)
                                                            .minimum_region_size(200)
                                                            .angle_tolerance(8)
                                                            .maximum_offset(.05));
  const auto planes = CGAL::Tandem::distinct_planes(shapes);
  const auto index_map = CGAL::Tandem::plane_index_map(shapes);

  Points structured;
  CGAL::structure_point_set(points, planes, std::back_inserter(structured), .25,
                            CGAL::parameters::point_map(Point_map())
                              .normal_map(Normal_map())
                              .plane_map(Plane_map())
                              .plane_index_map(index_map));

  std::cout << planes.size() << " planes, " << structured.size() << " structured points, "
            << number_of_far_points(points, planes, Plane_map(), index_map)
            << " points farther than 0.05 from their plane\n";
  return planes.size() > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
