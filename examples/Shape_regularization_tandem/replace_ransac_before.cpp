// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A program as many have it: planes by Efficient RANSAC, regularized, for structuring.
// replace_ransac_after.cpp is the same with Tandem; compare the two with diff.

#include "far_points.h"
#include "house_cloud.h"

#include <CGAL/Shape_detection/Efficient_RANSAC.h>
#include <CGAL/Shape_regularization/regularize_planes.h>
#include <CGAL/structure_point_set.h>

#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;
using Points = std::vector<Point_with_normal>;
using Traits = CGAL::Shape_detection::Efficient_RANSAC_traits<Kernel, Points, Point_map, Normal_map>;
using Ransac = CGAL::Shape_detection::Efficient_RANSAC<Traits>;
using Plane_map = CGAL::Shape_detection::Plane_map<Traits>;

int main(int argc, char* argv[])
{
  Points points = example_cloud(argc, argv);
  Ransac ransac;
  ransac.set_input(points); // will be reordered
  ransac.add_shape_factory<CGAL::Shape_detection::Plane<Traits>>();
  Ransac::Parameters parameters;
  parameters.epsilon = .05;
  parameters.normal_threshold = .9063; // the cosine of 25 degrees
  parameters.min_points = 200;
  parameters.cluster_epsilon = .3;
  parameters.probability = .01;
  ransac.detect(parameters);
  auto planes = ransac.planes();
  const CGAL::Shape_detection::Point_to_shape_index_map<Traits> index_map(points, planes);

  CGAL::Shape_regularization::Planes::regularize_planes(planes, points,
                                                        CGAL::parameters::plane_map(Plane_map())
                                                          .point_map(Point_map())
                                                          .plane_index_map(index_map)
                                                          .regularize_axis_symmetry(false)
                                                          .maximum_angle(8)
                                                          .maximum_offset(.05));

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
