// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order of the cloud along the Hilbert curve. Only positions are sorted here; engine/connect_cloud.h moves the points.
// The result does not depend on the order of the caller's points.

#ifndef CGAL_TANDEM_INTERNAL_CLOUD_SORT_ALONG_CURVE_H
#define CGAL_TANDEM_INTERNAL_CLOUD_SORT_ALONG_CURVE_H

#include <CGAL/Tandem/internal/backend/buffers.h>
#include <CGAL/Tandem/internal/base/types.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- The Hilbert curve through a cube of 2^21 positions an axis. Each octant of the cube, and each octant of an octant, is
// one contiguous range of codes. So a cloud in the order of the codes is also in the order of an octree. Consecutive
// positions are adjacent, unlike those of Morton codes, so ranges of points are compact.

// Bits of a coordinate in a code, which has 3 * 21 = 63 bits.
constexpr int curve_bits = 21;

// Moves bit i of v < 2^21 to bit 3 i, so that three coordinates can be interleaved.
CGAL_TANDEM_HD inline std::uint64_t spread_bits(std::uint32_t v)
{
  std::uint64_t s = v;
  s = (s | s << 32) & 0x001f00000000ffffu;
  s = (s | s << 16) & 0x001f0000ff0000ffu;
  s = (s | s << 8) & 0x100f00f00f00f00fu;
  s = (s | s << 4) & 0x10c30c30c30c30c3u;
  s = (s | s << 2) & 0x1249249249249249u;
  return s;
}

// Octants are numbered by their bits x y z. u and v are octants of two successive levels, in the same axes. Returns v in
// the axes that the curve has inside u: a reflection and up to two swaps (Skilling 2004), and another reflection where
// the Gray code of u is odd.
constexpr unsigned inside_octant(unsigned u, unsigned v)
{
  unsigned x = v >> 2 ^ u >> 2, y = v >> 1 & 1u, z = v & 1u;
  const unsigned x_of_curve = (u >> 1 & 1u) != 0 ? x ^ 1u : y;
  y = (u >> 1 & 1u) != 0 ? y : x;
  x = (u & 1u) != 0 ? x_of_curve ^ 1u : z;
  z = (u & 1u) != 0 ? z : x_of_curve;
  return (x ^ u >> 2 ^ (u >> 1 & 1u) ^ (u & 1u)) << 2 | y << 1 | z;
}

// The curve as an automaton. A state is what the axes of the curve are inside an octant: eight octal digits, of which
// digit v is octant v of the cube in these axes. In them octants follow each other in a Gray code.
struct Curve_automaton {
  static constexpr unsigned states = 24;
  std::uint16_t step[states][64]; // two levels: the state inside, then 6 bits of the code
};

// A function, since nvcc leaves what a constexpr constructor has computed out of the memory of a device.
constexpr Curve_automaton make_curve_automaton()
{
  constexpr unsigned states = Curve_automaton::states;
  std::uint32_t axes[states + 1] = {076543210};
  unsigned level[states][8] = {};
  for(unsigned s = 0, size = 1; s < size; ++s)
    for(unsigned octant = 0; octant < 8; ++octant) {
      const unsigned u = axes[s] >> 3 * octant & 7u;
      axes[size] = 0;
      for(unsigned v = 0; v < 8; ++v)
        axes[size] |= inside_octant(u, axes[s] >> 3 * v & 7u) << 3 * v;
      unsigned next = 0;
      while(axes[next] != axes[size])
        ++next;
      size += next == size;
      level[s][octant] = next << 3 | (u ^ u >> 1 ^ u >> 2);
    }
  Curve_automaton automaton = {};
  for(unsigned s = 0; s < states; ++s)
    for(unsigned i = 0; i < 64; ++i) {
      const unsigned upper = level[s][i >> 3], lower = level[upper >> 3][i & 7u];
      automaton.step[s][i] = std::uint16_t(lower >> 3 << 6 | (upper & 7u) << 3 | (lower & 7u));
    }
  return automaton;
}

// The position along the curve; all coordinates are below 2^21. The first step is of one level, so it begins one level
// above. In the lowest octant the axes are exchanged in turn, and three levels of it leave them as they are.
CGAL_TANDEM_HD inline std::uint64_t hilbert_code(std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
  static constexpr Curve_automaton automaton = make_curve_automaton();
  const std::uint64_t octants = spread_bits(x) << 2 | spread_bits(y) << 1 | spread_bits(z);
  unsigned state = automaton.step[0][0] >> 6;
  std::uint64_t code = 0;
  for(int shift = 3 * (curve_bits - 1); shift >= 0; shift -= 6) {
    const unsigned step = automaton.step[state][octants >> shift & 63u];
    code = code << 6 | (step & 63u);
    state = step >> 6;
  }
  return code;
}

// The face that a normal points to, of the six of a cube; 0 without a normal.
CGAL_TANDEM_HD inline std::uint32_t face_of(std::uint32_t normal)
{
  const Int_vector n = decode_normal(normal);
  const std::int32_t x = n.x < 0 ? -n.x : n.x, y = n.y < 0 ? -n.y : n.y, z = n.z < 0 ? -n.z : n.z;
  const bool is_x = x >= y && x >= z, is_y = !is_x && y >= z;
  const std::int32_t largest = is_x ? n.x : is_y ? n.y : n.z;
  return (is_x ? 0u : is_y ? 2u : 4u) + (largest < 0);
}

// The root of the octree: a cube around the cloud, 2^21 finest octants wide. A finest octant is 2^shift steps wide.
// Unsigned differences to the low corner cannot overflow: the cloud has at most 2^29 steps.
//
// With surfels the root is 2^20 of their cells wide, and a finest octant is the part of a cell with normals to one
// face. 2^shift is at least half the width of a cell then. Points of small tolerances are in the smallest cells;
// in each octave of larger ones, cells are twice as wide.
struct Code_frame {
  std::int32_t low[3];
  int shift;
  double cells_per_step = 0; // the smallest ones; 0: no surfels
  int octaves = 0;           // widths of cells, but one
  int first_level = 0;       // of the smallest octant at the low corner that has the codes of all points

  CGAL_TANDEM_HD bool has_surfels() const { return cells_per_step > 0; }

  // level: of the tolerance of the point.
  CGAL_TANDEM_HD std::uint64_t code(const Grid_point& p, std::uint8_t level = 0) const
  {
    if(has_surfels())
      return surfel_code(hilbert_code(2 * cell(p.x, 0), 2 * cell(p.y, 1), 2 * cell(p.z, 2)), face_of(p.normal), level);
    return hilbert_code(std::uint32_t(p.x - low[0]) >> shift, std::uint32_t(p.y - low[1]) >> shift,
                        std::uint32_t(p.z - low[2]) >> shift);
  }

  // The place of a point in the order within one finest octant, which matters where far outliers make it large. shift
  // is at most 8, so the code has at most 24 bits.
  CGAL_TANDEM_HD std::uint64_t code_inside(const Grid_point& p) const
  {
    const std::uint32_t mask = (1u << shift) - 1;
    return hilbert_code(std::uint32_t(p.x - low[0]) & mask, std::uint32_t(p.y - low[1]) & mask,
                        std::uint32_t(p.z - low[2]) & mask);
  }

  // Whether two points are in one octant, `up` levels above the finest octants, or the smallest cells of surfels.
  CGAL_TANDEM_HD bool share_octant(const Grid_point& p, const Grid_point& q, int up) const
  {
    return ((place(p.x, 0) ^ place(q.x, 0)) | (place(p.y, 1) ^ place(q.y, 1)) | (place(p.z, 2) ^ place(q.z, 2))) >>
             up ==
           0;
  }

  // Its coordinate in cells of surfels, or in finest octants.
  CGAL_TANDEM_HD std::uint32_t place(std::int32_t x, int axis) const
  {
    return has_surfels() ? cell(x, axis) : std::uint32_t(x - low[axis]) >> shift;
  }

private:
  // From the code of the smallest cell around a point: that of its own cell, and its face as the octant below. Digits
  // of 6 below that are the mark of larger cells.
  CGAL_TANDEM_HD std::uint64_t surfel_code(std::uint64_t code, std::uint32_t face, std::uint8_t level) const
  {
    const int octave = octave_of(level) < octaves ? octave_of(level) : octaves;
    const int bits = 3 * (octaves - octave);
    const std::uint64_t below = std::uint64_t(1) << bits;
    return (code & ~(8 * below - 1)) | std::uint64_t(face) << bits | (below - 1) / 7 * 6;
  }

  CGAL_TANDEM_HD std::uint32_t cell(std::int32_t x, int axis) const
  {
    return std::uint32_t(double(std::uint32_t(x - low[axis])) * cells_per_step);
  }
};

// The smallest frame around all points between two corners. There are no surfels where there would be more than 2^20 of
// the smallest cells along an axis.
inline Code_frame make_code_frame(const Grid_point& low, const Grid_point& high, const Surfel_cells& surfels = {})
{
  Code_frame frame = {{low.x, low.y, low.z}, 0};
  const std::uint32_t extent =
    (std::max)({std::uint32_t(high.x - low.x), std::uint32_t(high.y - low.y), std::uint32_t(high.z - low.z)});
  while((extent >> frame.shift) >> curve_bits)
    ++frame.shift;
  const double width_steps = surfels.smallest_width_steps();
  if(width_steps > 0 && double(extent) / width_steps < double((1 << (curve_bits - 1)) - 1)) {
    frame.cells_per_step = 1 / width_steps;
    frame.octaves = surfels.octaves;
    frame.shift = (std::max)(std::ilogb(width_steps), 0);
  }
  std::uint32_t last = frame.place(high.x, 0) | frame.place(high.y, 1) | frame.place(high.z, 2);
  if(frame.has_surfels()) // codes of the largest cells differ in all digits below theirs
    last = last << 1 | ((2u << frame.octaves) - 1);
  while(frame.first_level < curve_bits && last >> (curve_bits - 1 - frame.first_level) == 0)
    ++frame.first_level;
  return frame;
}

// The smallest frame around a box, and that around the given points.
inline Code_frame make_code_frame(const Box& box)
{
  if(box.low[0] > box.high[0])
    return {{0, 0, 0}, 0};
  return make_code_frame({box.low[0], box.low[1], box.low[2], 0}, {box.high[0], box.high[1], box.high[2], 0});
}

inline Code_frame make_code_frame(const Grid_point* point, std::size_t n)
{
  Box box;
  for(std::size_t i = 0; i < n; ++i)
    box.add(point[i]);
  return make_code_frame(box);
}

// Writes the code of each point as its key of the sort.
template <class Table>
struct Write_codes {
  const Grid_point* point;
  const std::uint8_t* level; // null: all are 0
  Code_frame frame;
  Table order;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    order.set(i, frame.code(point[i], level != nullptr ? level[i] : 0), std::uint32_t(i));
  }
};

// Points before the sort.
struct Unsorted_points {
  const Grid_point* point;
  std::size_t size;
  const std::uint8_t* level = nullptr; // of their tolerances; null: all are 0
};

// Whether the key at position i of the sorted table equals one beside it. Sorts of back ends need not be stable, so the
// order of equal keys is undefined up to here.
template <class Table>
struct Is_tied {
  Table order;
  std::uint32_t size;

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const
  {
    return (i > 0 && order.key(i - 1) == order.key(i)) || (i + 1 < size && order.key(i + 1) == order.key(i));
  }
};

// A point that shares its code with another one.
struct Tied_point {
  std::uint64_t code, code_inside;
  Grid_point point;
  std::uint32_t index;
  std::uint32_t gap = 0; // instead of padding: copies between host and device have no undefined bytes
};

// Copies the point at place[i] of the sorted table to item i, for the sort of ties on the host.
template <class Table>
struct Gather_tied {
  Table order;
  const Grid_point* point; // in the order before the sort
  Code_frame frame;
  const std::uint32_t* place; // positions of the ties, ascending
  Tied_point* tied;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t index = order.index(place[i]);
    tied[i] = {order.key(place[i]), frame.code_inside(point[index]), point[index], index};
  }
};

// Writes item i back to place[i]. Codes at these places are the same as before; only indices change.
template <class Table>
struct Scatter_tied {
  Table order;
  const std::uint32_t* place;
  const Tied_point* tied;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { order.set(place[i], tied[i].code, tied[i].index); }
};

// What orders points of equal code: position within the octant, then all that is known of them on the grid.
inline auto key_within_code(const Tied_point& t)
{
  return std::tie(t.code_inside, t.point.x, t.point.y, t.point.z, t.point.normal);
}

// Whether two points are the same on the grid, with their normals.
inline bool are_equal_on_grid(const Tied_point& a, const Tied_point& b)
{
  return a.code == b.code && key_within_code(a) == key_within_code(b);
}

// Sorts each maximal stretch of consecutive items that are alike, one stretch on one thread.
template <class Backend, class Alike, class Less>
void sort_stretches(Backend& backend, std::vector<Tied_point>& tied, Alike are_alike, Less less)
{
  std::vector<std::size_t> start;
  for(std::size_t i = 0; i < tied.size(); ++i)
    if(i == 0 || !are_alike(tied[i - 1], tied[i]))
      start.push_back(i);
  start.push_back(tied.size());
  const auto at = [&](std::size_t s) { return tied.begin() + std::ptrdiff_t(start[s]); };
  backend.for_each_on_host(start.size() - 1, [&](std::size_t s) { std::sort(at(s), at(s + 1), less); });
}

// Orders points that are the same on the grid. precedes(i, j) is a total order of their indices, which depends on
// these only for exact duplicates. It is called on the host, and after prepare(), which copies values from a device.
// Neither is called where no two points are the same.
template <class Precedes = std::less<std::uint32_t>, class Prepare = Nothing>
struct Tie_order {
  Precedes precedes = Precedes();
  Prepare prepare = Prepare();
};

template <class Precedes, class Prepare>
Tie_order<Precedes, Prepare> make_tie_order(Precedes precedes, Prepare prepare)
{
  return {precedes, prepare};
}

// Sorts the points of each code by (code inside, coordinates, normal), then those that are still equal by `ties`.
template <class Backend, class Ties>
void sort_tied(Backend& backend, std::vector<Tied_point>& tied, const Ties& ties)
{
  const auto have_one_code = [](const Tied_point& a, const Tied_point& b) { return a.code == b.code; };
  sort_stretches(backend, tied, have_one_code,
                 [](const Tied_point& a, const Tied_point& b) { return key_within_code(a) < key_within_code(b); });
  if(std::adjacent_find(tied.begin(), tied.end(), are_equal_on_grid) == tied.end())
    return;
  ties.prepare();
  sort_stretches(backend, tied, are_equal_on_grid,
                 [&](const Tied_point& a, const Tied_point& b) { return ties.precedes(a.index, b.index); });
}

// The indices of points, sorted by code. The back end sorts by the code only. The few ties go to the host and back.
// With a total order of ties the result does not depend on the order of the points.
template <class Backend, class Ties = Tie_order<>>
typename Backend::Sort_table sort_along_curve(Backend& backend, const Unsorted_points& points, const Code_frame& frame,
                                              const Ties& ties = Ties())
{
  using Table = typename Backend::Sort_table::View;
  const std::size_t n = points.size;
  typename Backend::Sort_table order(n);
  backend.for_each(n, Write_codes<Table>{points.point, points.level, frame, order.view()});
  backend.sort(order);
  if(frame.has_surfels())
    return order; // the points of a surfel need no order
  const auto place = backend.compact(n, Is_tied<Table>{order.view(), std::uint32_t(n)});
  if(place.size() == 0)
    return order;
  Buffer_of<Backend, Tied_point> buffer(place.size());
  backend.for_each(place.size(), Gather_tied<Table>{order.view(), points.point, frame, place.data(), buffer.data()});
  std::vector<Tied_point> tied = to_vector(backend, buffer);
  sort_tied(backend, tied, ties);
  const auto sorted = to_buffer(backend, tied);
  backend.for_each(place.size(), Scatter_tied<Table>{order.view(), place.data(), sorted.data()});
  return order;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CLOUD_SORT_ALONG_CURVE_H
