// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The loops over values that have just been read, which vectorize: whether they are finite, null vectors, and bounds.

#include "testing/test_support.h"

#include <CGAL/Tandem/internal/cloud/import_cloud.h>

#include <algorithm>
#include <limits>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_inspect_points)

using namespace CGAL::Tandem::internal;

// All that can be used, up to the largest and down to the smallest numbers, wherever it is among others.
template <class Value>
void test_values()
{
  using Limits = std::numeric_limits<Value>;
  const Value large = (Limits::max)(), small = Limits::denorm_min(), infinite = Limits::infinity();
  for(std::size_t points : {1, 2, 7, 8, 9, 40})
    for(std::size_t i = 0; i < 3 * points; ++i) {
      std::vector<Value> v(3 * points, Value(1));
      for(Value value : {large, -large, small, -small, Value(0)}) {
        v[i] = value;
        CHECK(are_finite(v.data(), v.size()) && !has_null(v.data(), v.size()));
        const Coordinate_box box = box_around(v.data(), v.size());
        for(std::size_t c = 0; c < 3; ++c) {
          const Value other = points > 1 || c != i % 3 ? Value(1) : value;
          CHECK(box.low[c] == double(c == i % 3 ? (std::min)(value, other) : other));
          CHECK(box.high[c] == double(c == i % 3 ? (std::max)(value, other) : other));
        }
      }
      for(Value value : {Limits::quiet_NaN(), infinite, -infinite}) {
        v[i] = value;
        CHECK(!are_finite(v.data(), v.size()));
      }
      std::fill_n(v.begin() + std::ptrdiff_t(i / 3 * 3), 3, Value(0));
      CHECK(has_null(v.data(), v.size()));
      v[i] = -small;
      CHECK(!has_null(v.data(), v.size()));
    }
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  test_values<float>();
  test_values<double>();
}

BOOST_AUTO_TEST_SUITE_END()
