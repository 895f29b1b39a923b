// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Detects planes on a CUDA device where the program is linked to Tandem::tandem_cuda and
// a device is there, and on the processors otherwise: the result is the same.
//   detect_planes_on_device [CLOUD [maximum_distance]]

#include "house_cloud.h"

#include <CGAL/Shape_regularization_tandem.h>

#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;

int main(int argc, char* argv[])
{
  const std::vector<Point_with_normal> points = example_cloud(argc, argv);
  const auto np = CGAL::Tandem::parameters::point_map(Point_map())
                    .normal_map(Normal_map())
                    .maximum_distance(argc > 2 ? std::atof(argv[2]) : .05);

  // Cuda_tag instead would insist on a device, and throw an exception if there is none.
  const auto shapes = CGAL::Tandem::detect_planes<CGAL::Tandem::Cuda_if_available_tag>(points, np);
  std::cout << shapes.number_of_shapes() << " shapes, by the back end " << shapes.statistics().backend << '\n';

  const auto same = CGAL::Tandem::detect_planes<CGAL::Sequential_tag>(points, np);
  const bool is_equal = shapes.hash() == same.hash();
  std::cout << "bit for bit " << (is_equal ? "the same" : "not the same") << " as sequentially\n";
  return is_equal ? EXIT_SUCCESS : EXIT_FAILURE;
}
