// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sets of intervals on a line.

#ifndef DETECT_PLANES_INTERVALS_H
#define DETECT_PLANES_INTERVALS_H

#include <algorithm>
#include <cstddef>
#include <vector>

namespace program {

struct Interval {
  double first, last;
  double length() const { return last - first; }
};

using Intervals = std::vector<Interval>; // ascending, apart

inline Intervals intersection(const Intervals& a, const Intervals& b)
{
  Intervals result;
  for(std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const Interval both = {(std::max)(a[i].first, b[j].first), (std::min)(a[i].last, b[j].last)};
    if(both.first < both.last)
      result.push_back(both);
    ++(a[i].last < b[j].last ? i : j);
  }
  return result;
}

inline Intervals difference(const Intervals& a, const Intervals& b)
{
  Intervals result;
  for(Interval rest : a) {
    for(const Interval& hole : b) {
      if(hole.last <= rest.first || hole.first >= rest.last)
        continue;
      if(hole.first > rest.first)
        result.push_back({rest.first, hole.first});
      rest.first = hole.last;
    }
    if(rest.first < rest.last)
      result.push_back(rest);
  }
  return result;
}

} // namespace program

#endif // DETECT_PLANES_INTERVALS_H
