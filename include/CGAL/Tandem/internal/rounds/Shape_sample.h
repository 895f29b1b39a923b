// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sample of the points of a shape: those of the least hash of their position. That of a union of shapes is a merge of
// theirs, so that shapes can unite without a pass over the points.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_SAMPLE_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_SAMPLE_H

#include <CGAL/Tandem/internal/base/types.h>

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

// The least hashes of both.
CGAL_TANDEM_HD inline void merge_sample(Shape_sample& target, const Shape_sample& other)
{
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
