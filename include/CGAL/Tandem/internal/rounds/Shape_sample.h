// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sample of the points of a shape: those of the least hash of their position. That of a union of shapes is a merge of
// theirs, so that shapes can unite without a pass over the points.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_SAMPLE_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_SAMPLE_H

#include <CGAL/Tandem/internal/backend/lanes.h>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Sampled_point {
  std::uint32_t hash, level; // level: of its tolerance
  Grid_point point;
};

// By rising hash.
struct Shape_sample {
  static constexpr std::uint32_t capacity = 64;
  std::uint32_t size;
  Sampled_point item[capacity];
};

// Whether an item of the other one is among the least hashes of both.
CGAL_TANDEM_HD inline bool has_least(const Shape_sample& target, const Shape_sample& other)
{
  return other.size > 0 &&
         (target.size < Shape_sample::capacity || other.item[0].hash < target.item[Shape_sample::capacity - 1].hash);
}

// The items of a sample, two in each of 32 lanes: that of the rank of the lane, and the one 32 places behind.
struct Sample_in_lanes {
  Sampled_point item[2];
  std::uint32_t size;
  std::uint64_t hashes; // of both items

  CGAL_TANDEM_HD explicit Sample_in_lanes(const Shape_sample& sample) : item(), size(sample.size)
  {
    for(std::uint32_t k = 0; k < 2; ++k)
      if(place(k) < size)
        item[k] = sample.item[place(k)];
    hashes = std::uint64_t(item[1].hash) << 32 | item[0].hash;
  }

  CGAL_TANDEM_HD static std::uint32_t place(std::uint32_t k) { return 32 * k + Lane_group::rank(); }

  // The number of items of less hash, by bisection.
  CGAL_TANDEM_HD std::uint32_t below(std::uint32_t hash) const
  {
    std::uint32_t n = 0;
    for(std::uint32_t step = Shape_sample::capacity; step > 0; step /= 2) {
      const std::uint32_t last = n + step - 1;
      const std::uint64_t both = Lane_group::of_lane(hashes, last % 32);
      if(last < size && std::uint32_t(last < 32 ? both : both >> 32) < hash)
        n += step;
    }
    return n;
  }

  // Writes the items to their places in a merge with another sample; no two have one hash.
  CGAL_TANDEM_HD void write(const Sample_in_lanes& other, Shape_sample& merged) const
  {
    for(std::uint32_t k = 0; k < 2; ++k) {
      const std::uint32_t at = place(k) + other.below(item[k].hash);
      if(place(k) < size && at < Shape_sample::capacity)
        merged.item[at] = item[k];
    }
  }
};

// merge_sample() by 32 lanes.
CGAL_TANDEM_HD inline void merge_sample_by_group(Shape_sample& target, const Shape_sample& other)
{
  static_assert(Shape_sample::capacity == 64, "two items for each lane");
  const Sample_in_lanes a(target), b(other);
  Lane_group::sync(); // all have read
  a.write(b, target);
  b.write(a, target);
  const std::uint32_t both = a.size + b.size;
  Lane_group::single([&] { target.size = both < Shape_sample::capacity ? both : Shape_sample::capacity; });
}

// The least hashes of both.
CGAL_TANDEM_HD inline void merge_sample(Shape_sample& target, const Shape_sample& other)
{
  if(!has_least(target, other))
    return;
  if(Lane_group::size() > 1)
    return merge_sample_by_group(target, other);
  const std::uint32_t both = target.size + other.size;
  const std::uint32_t n = both < Shape_sample::capacity ? both : Shape_sample::capacity;
  std::uint32_t a = 0, b = 0; // how many of each are among the least n
  while(a + b < n)
    if(b == other.size || (a < target.size && target.item[a].hash < other.item[b].hash))
      ++a;
    else
      ++b;
  for(std::uint32_t i = n; b > 0;) // from the end, so that nothing is overwritten before it has been moved
    if(a > 0 && target.item[a - 1].hash > other.item[b - 1].hash)
      target.item[--i] = target.item[--a];
    else
      target.item[--i] = other.item[--b];
  target.size = n;
}

// By id.
template <class Backend>
using Shape_samples = typename Backend::template Buffer<Shape_sample>;

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_SAMPLE_H
