// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random points of the grid: coordinates in [-2^bits, 2^bits), normals of all directions.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_RANDOM_POINTS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_RANDOM_POINTS_H

#include "scenes/scenes.h"

#include <CGAL/Tandem/internal/base/linear_algebra.h>

namespace CGAL::Tandem::internal {

inline std::int32_t random_coordinate(scenes::Random& random, int bits)
{
  const std::int64_t range = std::int64_t(1) << bits;
  return std::int32_t(std::int64_t(random.bits() % std::uint64_t(2 * range)) - range);
}

inline Grid_point random_point(scenes::Random& random, int bits)
{
  const scenes::Vec n = random.direction();
  return {random_coordinate(random, bits), random_coordinate(random, bits), random_coordinate(random, bits),
          encode_normal({n.x, n.y, n.z})};
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_RANDOM_POINTS_H
