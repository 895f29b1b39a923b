// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A first look at an unknown cloud without normals: both the normals and the
// parameters are estimated.
//   estimated_parameters [CLOUD]

#include "house_cloud.h"

#include <CGAL/Shape_regularization_tandem.h>

#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

int main(int argc, char* argv[])
{
  std::vector<Kernel::Point_3> points;
  for(const auto& point_with_normal : example_cloud(argc, argv))
    points.push_back(point_with_normal.first);

  // What detect_planes() would take; this call alone costs far less than a detection.
  const CGAL::Tandem::Parameters estimate = CGAL::Tandem::estimate_parameters(points);
  std::cout << "estimated: maximum distance " << estimate.maximum_distance << ", at least "
            << estimate.minimum_region_size << " points\n";

  // The estimate is a starting point. Here only shapes of twice its size are wanted.
  const auto shapes = CGAL::Tandem::detect_planes(
    points, CGAL::Tandem::parameters::settings(estimate).minimum_region_size(2 * estimate.minimum_region_size));

  const CGAL::Tandem::Parameters& used = shapes.parameters();
  std::cout << "used:      maximum distance " << used.maximum_distance << ", at least " << used.minimum_region_size
            << " points\n"
            << shapes.number_of_shapes() << " shapes, " << 100 * shapes.statistics().coverage
            << " % of the points, normals " << (shapes.has_estimated_normals() ? "estimated" : "given") << '\n';
  return shapes.number_of_shapes() > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
