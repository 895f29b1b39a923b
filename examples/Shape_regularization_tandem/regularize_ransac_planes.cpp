// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keeps Efficient RANSAC, or any detector, and regularizes its planes with Tandem: a change
// of namespace. Planes are related where their points lose little by it, and orthogonal ones are exactly so.

#include "house_cloud.h"

#include <CGAL/Shape_detection/Efficient_RANSAC.h>
#include <CGAL/Shape_regularization_tandem/regularize_planes.h>

#include <algorithm>
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

  // The parameters of CGAL::Shape_regularization::Planes::regularize_planes(); the result describes the relations.
  const CGAL::Tandem::Plane_relations relations =
    CGAL::Tandem::regularize_planes(planes, points,
                                    CGAL::parameters::plane_map(Plane_map())
                                      .point_map(Point_map())
                                      .plane_index_map(index_map)
                                      .maximum_angle(8)
                                      .maximum_offset(.05));

  std::cout << planes.size() << " planes: " << relations.number_of_parallel_groups() << " directions, "
            << relations.orthogonal_groups.size() << " pairs of them orthogonal, "
            << relations.number_of_coplanar_groups() << " distinct planes\n";
  // And what happened to each plane.
  double largest_angle = 0;
  for(double angle : relations.angle)
    largest_angle = (std::max)(largest_angle, angle);
  std::cout << "turned by at most " << largest_angle << " degrees; "
            << std::count(relations.is_rolled_back.begin(), relations.is_rolled_back.end(), true)
            << " planes rolled back\n";
  return planes.size() > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
