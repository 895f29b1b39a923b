// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// To which side of a cube the normal of a point points, in plain arithmetic.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_NAIVE_SIDE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_NAIVE_SIDE_H

#include <CGAL/Tandem/internal/base/types.h>

#include <array>
#include <cstddef>
#include <cstdlib>

// The axis and sign of the largest component.
inline int naive_side(const CGAL::Tandem::internal::Grid_point& p)
{
  const CGAL::Tandem::internal::Int_vector n = CGAL::Tandem::internal::decode_normal(p.normal);
  const std::array<int, 3> v = {n.x, n.y, n.z};
  int largest = 0;
  for(int c = 1; c < 3; ++c)
    if(std::abs(v[std::size_t(c)]) > std::abs(v[std::size_t(largest)]))
      largest = c;
  return 2 * largest + (v[std::size_t(largest)] < 0);
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_NAIVE_SIDE_H
