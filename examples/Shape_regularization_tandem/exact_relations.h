// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether what is parallel, orthogonal or coplanar is exactly so.

#ifndef TANDEM_EXAMPLES_EXACT_RELATIONS_H
#define TANDEM_EXAMPLES_EXACT_RELATIONS_H

#include <cmath>
#include <cstddef>

// Exact means exact: there is no tolerance but for the rounding of the product of two vectors.
template <class Shapes>
bool are_relations_exact(const Shapes& shapes)
{
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    for(std::size_t t = 0; t < s; ++t) {
      const auto p = shapes.plane(s), q = shapes.plane(t);
      const auto m = p.orthogonal_vector(), n = q.orthogonal_vector();
      if((shapes.are_parallel(s, t) && m != n) || (shapes.are_coplanar(s, t) && p != q) ||
         (shapes.are_orthogonal(s, t) && std::fabs(m * n) > 1e-15))
        return false;
    }
  return true;
}

#endif // TANDEM_EXAMPLES_EXACT_RELATIONS_H
