// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// To which side of a cube the normal of a point points, in plain arithmetic.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_NAIVE_SIDE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_NAIVE_SIDE_H

#include <CGAL/Tandem/internal/base/types.h>

#include <algorithm>
#include <cstdlib>

// The axis and sign of the largest component.
inline int naive_side(const CGAL::Tandem::internal::Grid_point& p)
{
  const auto n = CGAL::Tandem::internal::decode_normal(p.normal);
  const int v[] = {n.x, n.y, n.z};
  const int* const largest = std::max_element(v, v + 3, [](int a, int b) { return std::abs(a) < std::abs(b); });
  return 2 * int(largest - v) + (*largest < 0);
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_NAIVE_SIDE_H
