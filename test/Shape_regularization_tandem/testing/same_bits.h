// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether directions and planes are the same bits.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SAME_BITS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SAME_BITS_H

#include <CGAL/Tandem/internal/base/planes.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace CGAL::Tandem::internal {

inline bool is_same(const Vector& a, const Vector& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

inline bool is_same(const Regular_plane& a, const Regular_plane& b)
{
  return is_same(a.normal, b.normal) && std::memcmp(&a.offset, &b.offset, sizeof a.offset) == 0;
}

inline bool are_same(const std::vector<Regular_plane>& a, const std::vector<Regular_plane>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Regular_plane& p, const Regular_plane& q) { return is_same(p, q); });
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SAME_BITS_H
