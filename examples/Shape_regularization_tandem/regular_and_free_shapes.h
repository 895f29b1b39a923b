// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shapes of the example cloud, with and without regularization.

#ifndef TANDEM_EXAMPLES_REGULAR_AND_FREE_SHAPES_H
#define TANDEM_EXAMPLES_REGULAR_AND_FREE_SHAPES_H

#include "house_cloud.h"

#include <CGAL/Shape_regularization_tandem.h>

#include <cstdlib>
#include <vector>

struct Regular_and_free_shapes {
  using Shapes = CGAL::Tandem::Planar_shapes_3<house::Kernel>;
  std::vector<house::Point_with_normal> points;
  Shapes regular, free;
};

// The arguments: [CLOUD [maximum_distance [minimum_region_size]]]
inline Regular_and_free_shapes detect_regular_and_free_shapes(int argc, char* argv[])
{
  const std::vector<house::Point_with_normal> points = example_cloud(argc, argv);
  const auto np = CGAL::Tandem::parameters::point_map(CGAL::First_of_pair_property_map<house::Point_with_normal>())
                    .normal_map(CGAL::Second_of_pair_property_map<house::Point_with_normal>())
                    .maximum_distance(argc > 2 ? std::atof(argv[2]) : .05)
                    .minimum_region_size(argc > 3 ? std::size_t(std::atol(argv[3])) : 200);
  return {points, CGAL::Tandem::detect_planes(points, np),
          CGAL::Tandem::detect_planes(
            points, np.regularize_parallelism(false).regularize_orthogonality(false).regularize_coplanarity(false))};
}

#endif // TANDEM_EXAMPLES_REGULAR_AND_FREE_SHAPES_H
