// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sets of intervals on a line.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_INTERVALS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_INTERVALS_H

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

struct Interval {
  double first, last;
  double length() const { return last - first; }
};

using Intervals = std::vector<Interval>; // ascending, apart

constexpr double shortest = 4; // shortest border, in spacings

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

// Where the points that are chosen follow each other closely. `points` are sorted along the line.
template <class Near_point, class Is_chosen>
Intervals runs(const std::vector<Near_point>& points, Is_chosen is_chosen)
{
  Intervals result;
  std::size_t count = 0;
  float last_spacing = 0;
  double sum = 0;
  const auto drop_short = [&] {
    if(!result.empty() && result.back().length() < shortest * sum / double(count))
      result.pop_back();
  };
  for(const Near_point& p : points) {
    if(!is_chosen(p))
      continue;
    if(result.empty() || count == 0 || p.along - result.back().last > 2 * (double(p.spacing) + last_spacing)) {
      if(count > 0)
        drop_short();
      result.push_back({p.along, p.along});
      count = 0;
      sum = 0;
    }
    result.back().last = p.along;
    ++count;
    sum += p.spacing;
    last_spacing = p.spacing;
  }
  if(count > 0)
    drop_short();
  return result;
}

// Across gaps up to a length, of half of it where there are obstacles. What is not covered for the most part is left out.
inline Intervals bridged(const Intervals& pieces, const Intervals& obstacles, double longest_gap)
{
  Intervals result;
  std::vector<double> covered;
  for(const Interval& piece : pieces) {
    if(!result.empty()) {
      const Intervals gap = {{result.back().last, piece.first}};
      if(gap[0].length() <= longest_gap / 2 ||
         (gap[0].length() <= longest_gap && intersection(gap, obstacles).empty())) {
        result.back().last = piece.last;
        covered.back() += piece.length();
        continue;
      }
    }
    result.push_back(piece);
    covered.push_back(piece.length());
  }
  Intervals kept;
  for(std::size_t i = 0; i < result.size(); ++i)
    if(covered[i] > .6 * result[i].length())
      kept.push_back(result[i]);
  return kept;
}

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_INTERVALS_H
