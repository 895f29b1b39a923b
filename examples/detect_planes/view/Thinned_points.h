// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_THINNED_POINTS_H
#define DETECT_PLANES_THINNED_POINTS_H

#include "output/write_results.h"

#include <cstdint>
#include <vector>

namespace program {

// The points that are shown, shape by shape, then those without a shape. Of every `stride` points in this order one is
// taken, by a hash: a fixed one would follow the lines of a scan.
class Thinned_points {
public:
  Thinned_points(const Point_set& points, const Shapes& shapes, std::size_t largest_size)
    : stride(stride_of(points, largest_size)), shown(shapes.number_of_shapes() + 1)
  {
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      for(std::uint32_t i : shapes.points(s))
        add(i, s);
    std::uint32_t position = 0;
    for(Point_set::Index i : points) {
      if(shapes.shape_index(position) < 0 && is_finite(points.point(i)))
        add(position, shapes.number_of_shapes());
      ++position;
    }
  }

  std::size_t size() const { return positions.size(); }

  const std::size_t stride;
  std::vector<std::uint32_t> positions; // in the cloud
  std::vector<std::size_t> shown;       // points of each shape; at the end, of none

private:
  static std::size_t stride_of(const Point_set& points, std::size_t largest_size)
  {
    return (std::max)(std::size_t(1), (points.size() + largest_size - 1) / largest_size);
  }

  static std::uint64_t hash(std::uint64_t x)
  {
    x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdu;
    x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53u;
    return x ^ (x >> 33);
  }

  void add(std::uint32_t position, std::size_t shape)
  {
    const std::size_t row = count / stride;
    if(count++ % stride != hash(row + 1) % stride)
      return;
    positions.push_back(position);
    ++shown[shape];
  }

  std::size_t count = 0;
};

} // namespace program

#endif // DETECT_PLANES_THINNED_POINTS_H
