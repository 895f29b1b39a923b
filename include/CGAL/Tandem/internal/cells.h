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
#include <limits>
#include <tuple>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

constexpr int code_bits = 21; // an axis

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
  while((extent >> frame.shift) >> code_bits)
    ++frame.shift;
  return frame;
}

// Sorts the points of one code by (code inside, coordinates, normal, position).
inline void sort_equal_codes(Keyed_index* first, Keyed_index* last, const Grid_point* point, const Code_frame& frame)
{
  const std::uint64_t code = first->key;
  for(Keyed_index* e = first; e != last; ++e)
    e->key = frame.code_inside(point[e->index]);
  std::sort(first, last, [&](const Keyed_index& a, const Keyed_index& b) {
    const Grid_point &p = point[a.index], &q = point[b.index];
    return std::tie(a.key, p.x, p.y, p.z, p.normal, a.index) < std::tie(b.key, q.x, q.y, q.z, q.normal, b.index);
  });
  for(Keyed_index* e = first; e != last; ++e)
    e->key = code;
}

// Sorts positions of `point` along the curve, with a tie-break down to the position.
// The last one concerns exact duplicates only, so the order of the points does not
// depend on the order in which they come.
template <class Backend>
typename Backend::template Buffer<Keyed_index> sort_along_curve(Backend& backend, const Grid_point* point,
                                                                std::size_t n, const Code_frame& frame)
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
    sort_equal_codes(order.begin() + i, order.begin() + last + 1, point, frame);
  });
  return order;
}

// Splits the root octant until a leaf has at most cell_size points and is at most
// 2^24 steps wide. Points of one finest octant are cut in the order of the sort.
class Leaf_splitter {
public:
  Leaf_splitter(const Keyed_index* order, const Code_frame& frame, std::size_t cell_size, std::vector<Range>& leaves)
    : order_(order), shift_(frame.shift), cell_size_(cell_size), leaves_(leaves)
  {}

  void split(Range r, int level)
  {
    if(r.size() == 0)
      return;
    const bool is_narrow = code_bits - level + shift_ <= cell_extent_bits;
    if(r.size() <= cell_size_ && is_narrow) {
      leaves_.push_back(r);
      return;
    }
    if(level == code_bits) {
      for(std::uint32_t first = r.first; first < r.last; first += std::uint32_t(cell_size_))
        leaves_.push_back({first, (std::min)(first + std::uint32_t(cell_size_), r.last)});
      return;
    }
    const int bits = 3 * (code_bits - level - 1);
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
