// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order of the cloud along a space-filling curve, and the octree leaves, which
// are ranges of that order.

#ifndef CGAL_TANDEM_INTERNAL_CELLS_H
#define CGAL_TANDEM_INTERNAL_CELLS_H

#include <CGAL/Tandem/internal/Cloud.h>
#include <CGAL/Tandem/internal/backend/Host_buffer.h>
#include <CGAL/Tandem/internal/curve.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <tuple>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// A cube of 2^21 steps of 2^shift around the cloud.
struct Code_frame {
  std::int32_t low[3];
  int shift;

  CGAL_TANDEM_HD std::uint64_t code(const Grid_point& p) const
  {
    return hilbert_code(std::uint32_t(p.x - low[0]) >> shift, std::uint32_t(p.y - low[1]) >> shift,
                        std::uint32_t(p.z - low[2]) >> shift);
  }

  // The order within one finest octant, which matters where far outliers make that large.
  CGAL_TANDEM_HD std::uint64_t code_inside(const Grid_point& p) const
  {
    const std::uint32_t mask = (1u << shift) - 1;
    return hilbert_code(std::uint32_t(p.x - low[0]) & mask, std::uint32_t(p.y - low[1]) & mask,
                        std::uint32_t(p.z - low[2]) & mask);
  }
};

inline Code_frame make_code_frame(const Grid_point* point, std::size_t n)
{
  constexpr std::int32_t most = (std::numeric_limits<std::int32_t>::max)();
  std::int32_t low[3] = {most, most, most}, high[3] = {-most, -most, -most};
  for(std::size_t i = 0; i < n; ++i) {
    const std::int32_t c[3] = {point[i].x, point[i].y, point[i].z};
    for(int a = 0; a < 3; ++a) {
      low[a] = (std::min)(low[a], c[a]);
      high[a] = (std::max)(high[a], c[a]);
    }
  }
  if(n == 0)
    return {{0, 0, 0}, 0};
  Code_frame frame = {{low[0], low[1], low[2]}, 0};
  const std::uint32_t extent =
    (std::max)({std::uint32_t(high[0] - low[0]), std::uint32_t(high[1] - low[1]), std::uint32_t(high[2] - low[2])});
  while((extent >> frame.shift) >> curve_bits)
    ++frame.shift;
  return frame;
}

// Sorts the points of one code by (code inside, coordinates, normal, precedes).
template <class Precedes>
void sort_equal_codes(Keyed_index* first, Keyed_index* last, const Grid_point* point, const Code_frame& frame,
                      Precedes precedes)
{
  const std::uint64_t code = first->key;
  for(Keyed_index* e = first; e != last; ++e)
    e->key = frame.code_inside(point[e->index]);
  std::sort(first, last, [&](const Keyed_index& a, const Keyed_index& b) {
    const Grid_point &p = point[a.index], &q = point[b.index];
    const auto left = std::tie(a.key, p.x, p.y, p.z, p.normal), right = std::tie(b.key, q.x, q.y, q.z, q.normal);
    return left != right ? left < right : precedes(a.index, b.index);
  });
  for(Keyed_index* e = first; e != last; ++e)
    e->key = code;
}

// Sorts positions of `point` along the curve. precedes(i, j) decides between points
// that are the same on the grid: a total order that depends on their position only
// for exact duplicates, so that the result does not depend on the order of the points.
template <class Backend, class Precedes = std::less<std::uint32_t>>
typename Backend::template Buffer<Keyed_index> sort_along_curve(Backend& backend, const Grid_point* point,
                                                                std::size_t n, const Code_frame& frame,
                                                                Precedes precedes = Precedes())
{
  typename Backend::template Buffer<Keyed_index> order(n);
  backend.for_each(n, [&](std::size_t i) { order[i] = {frame.code(point[i]), std::uint32_t(i)}; });
  backend.sort_by_key(order.begin(), order.end());
  typename Backend::template Buffer<std::uint8_t> is_tie(
    n); // with the next one; sorting a run hides its key for a while
  backend.for_each(n, [&](std::size_t i) { is_tie[i] = i + 1 < n && order[i].key == order[i + 1].key; });
  backend.for_each(n, [&](std::size_t i) {
    if(!is_tie[i] || (i > 0 && is_tie[i - 1]))
      return;
    std::size_t last = i + 1;
    while(is_tie[last])
      ++last;
    sort_equal_codes(order.begin() + i, order.begin() + last + 1, point, frame, precedes);
  });
  return order;
}

// Splits the root octant until a leaf has at most cell_size points and is at most
// 2^23 steps wide. Points of one finest octant are cut in the order of the sort.
class Leaf_splitter {
public:
  Leaf_splitter(const Keyed_index* order, const Code_frame& frame, std::size_t cell_size, std::vector<Range>& leaves)
    : order_(order), shift_(frame.shift), cell_size_(cell_size), leaves_(leaves)
  {}

  void split(Range r, int level)
  {
    if(r.size() == 0)
      return;
    const bool is_narrow = curve_bits - level + shift_ <= cell_extent_bits;
    if(r.size() <= cell_size_ && is_narrow) {
      leaves_.push_back(r);
      return;
    }
    if(level == curve_bits) {
      for(std::uint32_t first = r.first; first < r.last; first += std::uint32_t(cell_size_))
        leaves_.push_back({first, (std::min)(first + std::uint32_t(cell_size_), r.last)});
      return;
    }
    const int bits = 3 * (curve_bits - level - 1);
    while(r.first < r.last) {
      const std::uint64_t octant = order_[r.first].key >> bits;
      const Keyed_index* end = std::partition_point(order_ + r.first, order_ + r.last,
                                                    [&](const Keyed_index& e) { return (e.key >> bits) == octant; });
      const std::uint32_t last = std::uint32_t(end - order_);
      split({r.first, last}, level + 1);
      r.first = last;
    }
  }

private:
  const Keyed_index* order_;
  int shift_;
  std::size_t cell_size_;
  std::vector<Range>& leaves_;
};

inline std::vector<Range> split_leaves(const Keyed_index* order, std::size_t n, const Code_frame& frame,
                                       std::size_t cell_size)
{
  std::vector<Range> leaves;
  Leaf_splitter(order, frame, cell_size, leaves).split({0, std::uint32_t(n)}, 0);
  return leaves;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CELLS_H
