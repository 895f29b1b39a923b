// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which of the points that have just been read are valid, and their bounds.

#ifndef CGAL_TANDEM_INTERNAL_CLOUD_INSPECT_POINTS_H
#define CGAL_TANDEM_INTERNAL_CLOUD_INSPECT_POINTS_H

#include <CGAL/Tandem/internal/cloud/Import.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace Tandem {
namespace internal {

// Consecutive points in memory: three values a point, and as many of normals.
template <class Value>
struct Values {
  Value* point;
  Value* normal; // null: there are none

  // The points from the i-th on.
  Values from(std::size_t i) const { return {point + 3 * i, normal != nullptr ? normal + 3 * i : nullptr}; }
};

// The next three functions take n values, three of each point. They have no branches, so that they vectorize.

// Whether no value is infinite or NaN. The comparison is false for NaN.
template <class Value>
bool are_finite(const Value* v, std::size_t n)
{
  int is_other = 0;
  for(std::size_t i = 0; i < n; ++i)
    is_other |= !(std::fabs(v[i]) <= (std::numeric_limits<Value>::max)());
  return is_other == 0;
}

// Whether a vector is null.
template <class Value>
bool has_null(const Value* v, std::size_t n)
{
  int is_null = 0;
  for(std::size_t i = 0; i < n; i += 3)
    is_null |= int(v[i] == 0) & int(v[i + 1] == 0) & int(v[i + 2] == 0);
  return is_null != 0;
}

// The bounds of finite values. Element k of the tables belongs to axis k % 3.
template <class Value>
Coordinate_box box_around(const Value* v, std::size_t n)
{
  constexpr std::size_t lanes = 24; // a multiple of three; of fewer, g++ unrolls the loops instead
  Value low[lanes], high[lanes];
  std::fill_n(low, lanes, std::numeric_limits<Value>::infinity());
  std::fill_n(high, lanes, -std::numeric_limits<Value>::infinity());
  std::size_t i = 0;
  for(; i + lanes <= n; i += lanes) {
    for(std::size_t k = 0; k < lanes; ++k)
      low[k] = v[i + k] < low[k] ? v[i + k] : low[k];
    for(std::size_t k = 0; k < lanes; ++k)
      high[k] = high[k] < v[i + k] ? v[i + k] : high[k];
  }
  for(; i < n; ++i) {
    low[i % 3] = (std::min)(low[i % 3], v[i]);
    high[i % 3] = (std::max)(high[i % 3], v[i]);
  }
  // Minima and maxima are the same in any order.
  Coordinate_box box;
  for(std::size_t k = 0; k < lanes; ++k) {
    box.low[k % 3] = (std::min)(box.low[k % 3], double(low[k]));
    box.high[k % 3] = (std::max)(box.high[k % 3], double(high[k]));
  }
  return box;
}

// Whether all points are valid: finite coordinates, and finite normals that are not null.
template <class Value>
bool are_usable(const Values<Value>& values, std::size_t points)
{
  const std::size_t n = 3 * points;
  return are_finite(values.point, n) &&
         (values.normal == nullptr || (are_finite(values.normal, n) && !has_null(values.normal, n)));
}

// Adds the valid points to the box. Returns false if some are invalid. The points are tested one by one only then.
template <class Value>
bool inspect_points(const Values<Value>& values, std::size_t points, Coordinate_box& box)
{
  const bool is_complete = are_usable(values, points);
  if(is_complete)
    box.add(box_around(values.point, 3 * points));
  for(std::size_t i = 0; i < points && !is_complete; ++i)
    if(are_usable(values.from(i), 1))
      box.add(box_around(values.from(i).point, 3));
  return is_complete;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CLOUD_INSPECT_POINTS_H
