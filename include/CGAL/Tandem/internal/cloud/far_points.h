// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Few points that are too far from all others for the grid, such as invalid pixels at zero in map coordinates, do not
// keep a cloud from being detected: they are left out and counted.

#ifndef CGAL_TANDEM_INTERNAL_CLOUD_FAR_POINTS_H
#define CGAL_TANDEM_INTERNAL_CLOUD_FAR_POINTS_H

#include <CGAL/Tandem/internal/base/keys.h>
#include <CGAL/Tandem/internal/cloud/import_cloud.h>

#include <algorithm>
#include <vector>

namespace CGAL::Tandem::internal {

// The value that a ratio of the values of all ranks is below: byte by byte, from counts, which do not depend on the
// order of the values. There has to be one.
template <class Ranks, class F>
double quantile_of_all(const Ranks& ranks, std::size_t n, F value, const tuning::Ratio& ratio)
{
  std::uint64_t rank = 0, found = 0;
  for(int bits = 56; bits >= 0; bits -= 8) {
    std::vector<std::uint64_t> count(256, 0);
    for(std::size_t i = 0; i < n; ++i) {
      const std::uint64_t v = ordered_bits(value(i));
      if(bits == 56 || v >> (bits + 8) == found >> (bits + 8))
        ++count[v >> bits & 255];
    }
    count = ranks.total(std::move(count));
    if(bits == 56) {
      for(const std::uint64_t c : count)
        rank += c;
      rank = std::uint64_t(ratio.of(std::int64_t(rank)));
    }
    std::uint64_t digit = 0;
    for(; digit < 255 && rank >= count[digit]; ++digit)
      rank -= count[digit];
    found |= digit << bits;
  }
  return from_ordered_bits(found);
}

// Leaves out the points that are farther from the median, on an axis, than a quarter of what a grid can hold, if they are few.
// Otherwise no grid can be chosen, which is an error.
template <class Ranks>
void drop_far_points(const Ranks& ranks, Import& in, double epsilon)
{
  const double largest = std::ldexp(epsilon, tuning::grid::largest_extent_bits);
  if(!(in.box.extent() > largest))
    return;
  in.drop_upload();
  constexpr tuning::Ratio half = {1, 2};
  const auto median = [&](auto coordinate) {
    return quantile_of_all(
      ranks, in.size(), [&](std::size_t i) { return coordinate(in.position(i)); }, half);
  };
  const Vector center = {median([](const Vector& p) { return p.x; }), median([](const Vector& p) { return p.y; }),
                         median([](const Vector& p) { return p.z; })};
  const auto is_near = [&](std::size_t i) { return largest_component(in.position(i) - center) <= largest / 4; };
  std::size_t far = 0;
  for(std::size_t i = 0; i < in.size(); ++i)
    far += !is_near(i);
  if(tuning::grid::far_ratio.is_exceeded(std::int64_t(ranks.total(far)), std::int64_t(in.total.points)))
    return;
  in.keep_if(is_near);
  in.number_of_far_points += far;
  in.box = Coordinate_box();
  for(std::size_t i = 0; i < in.size(); ++i)
    in.box.add(in.position(i));
  join_imports(ranks, in);
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CLOUD_FAR_POINTS_H
