// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shapes of random sizes around random directions.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PLATES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PLATES_H

#include "direction_families.h"
#include "rectangles.h"

#include <cmath>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

inline std::vector<int> all_of(const Shape_fits& shapes)
{
  std::vector<int> all(shapes.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// Plates of some sizes whose normals lie around some directions, within a multiple of the tolerance of 8 degrees.
inline Shape_fits random_plates(Random& random, int n, int centers, double spread)
{
  const Directions center = random_directions(random, centers);
  Shape_fits shapes;
  for(int i = 0; i < n; ++i) {
    const Vector normal =
      unit(add_scaled(center[std::size_t(i % centers)], spread * .14 * random.uniform(), random.direction()));
    const double size = std::exp(4 * random.uniform()) * epsilon;
    const Vector place = 100 * epsilon * random.vector();
    shapes.push_back(make_shape({normal, place, size, size * (.05 + random.uniform()), .3 * epsilon,
                                 double(100 + random.below(20) * random.below(100))}));
  }
  return shapes;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PLATES_H
