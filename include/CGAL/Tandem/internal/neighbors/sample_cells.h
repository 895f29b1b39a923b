// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sample of a cloud to measure its noise: whole cells of the octree, so that neighbors are in it as well. It does not
// depend on the order of the points. Few points that are far from all others are left out, since they would make the
// grid of the others too coarse.

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_SAMPLE_CELLS_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_SAMPLE_CELLS_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/base/tuning/cloud.h>
#include <CGAL/Tandem/internal/cloud/choose_grid.h>
#include <CGAL/Tandem/internal/cloud/cells.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// Whether a point is in a box.
inline bool is_inside(const Coordinate_box& box, const Vector& p)
{
  return box.low[0] <= p.x && p.x <= box.high[0] && box.low[1] <= p.y && p.y <= box.high[1] && box.low[2] <= p.z &&
         p.z <= box.high[2];
}

inline bool is_inside(const Coordinate_box& box, const Coordinate_box& part)
{
  return is_inside(box, Vector{part.low[0], part.low[1], part.low[2]}) &&
         is_inside(box, Vector{part.high[0], part.high[1], part.high[2]});
}

// Counts of the points in so many slices of a box, along each axis.
constexpr int box_slices = 256;
using Slice_counts = std::array<std::uint64_t, 3 * std::size_t(box_slices)>;

// Adds the points [first, last) that are inside the box, by slice.
inline void count_slices(const Import& in, const Coordinate_box& box, Range points, Slice_counts& count)
{
  for(std::uint32_t i = points.first; i < points.last; ++i) {
    const Vector p = in.position(i);
    if(!is_inside(box, p))
      continue;
    const double v[3] = {p.x, p.y, p.z};
    for(int c = 0; c < 3; ++c) {
      const double width = box.high[c] - box.low[c];
      const int slice = width > 0 ? int(box_slices * ((v[c] - box.low[c]) / width)) : 0;
      ++count[std::size_t(c) * box_slices + std::size_t((std::min)(slice, box_slices - 1))];
    }
  }
}

// The points of all ranks inside the box, by slice.
template <class Backend>
std::vector<std::uint64_t> count_slices(Backend& backend, const Import& in, const Coordinate_box& box)
{
  constexpr std::size_t grain = 1 << 17;
  std::vector<Slice_counts> of_piece((in.size() + grain - 1) / grain, Slice_counts());
  backend.for_each_piece(in.size(), grain, [&](std::size_t first, std::size_t last) {
    count_slices(in, box, {std::uint32_t(first), std::uint32_t(last)}, of_piece[first / grain]);
  });
  std::vector<std::uint64_t> count(Slice_counts().size(), 0);
  for(const Slice_counts& piece : of_piece)
    for(std::size_t i = 0; i < count.size(); ++i)
      count[i] += piece[i];
  return Ranks<Backend>(backend).total(std::move(count));
}

// The part of a box that has all points but few at each end of an axis, widened at each end by its own width.
inline Coordinate_box without_ends(const Coordinate_box& box, const std::vector<std::uint64_t>& count)
{
  Coordinate_box inner = box;
  for(int c = 0; c < 3; ++c) {
    const std::uint64_t* const slice = count.data() + c * box_slices;
    std::uint64_t all = 0;
    for(int s = 0; s < box_slices; ++s)
      all += slice[s];
    const auto few = std::uint64_t(tuning::estimation::far_points.of(std::int64_t(all)));
    int first = 0, last = box_slices - 1;
    for(std::uint64_t passed = slice[first]; passed <= few && first < last; passed += slice[first])
      ++first;
    for(std::uint64_t passed = slice[last]; passed <= few && last > first; passed += slice[last])
      --last;
    const double width = (box.high[c] - box.low[c]) / box_slices;
    inner.low[c] = (std::max)(box.low[c], box.low[c] + width * (2 * first - last - 1));
    inner.high[c] = (std::min)(box.high[c], box.low[c] + width * (2 * last - first + 2));
  }
  return inner;
}

// The box of the points without those that no grid can hold, if they are few.
template <class Backend>
Coordinate_box box_within_grids(Backend& backend, const Import& in)
{
  const double largest = std::ldexp(largest_length, 24);
  Coordinate_box box = in.box;
  for(int c = 0; c < 3; ++c) {
    box.low[c] = (std::max)(box.low[c], -largest);
    box.high[c] = (std::min)(box.high[c], largest);
  }
  if(is_inside(box, in.box))
    return in.box;
  const std::vector<std::uint64_t> count = count_slices(backend, in, box);
  const std::uint64_t inside = std::accumulate(count.begin(), count.begin() + box_slices, std::uint64_t(0));
  const auto outside = std::int64_t(in.total.points) - std::int64_t(inside);
  return tuning::grid::far_ratio.is_exceeded(outside, std::int64_t(in.total.points)) ? in.box : box;
}

// The box of the points without few that are far from all others: as long as all but those fit into a box that is much
// smaller, it is that one. Boxes of other clouds stay as they are.
template <class Backend>
Coordinate_box box_of_most(Backend& backend, const Import& in)
{
  using namespace tuning::estimation;
  in.download_values();
  Coordinate_box box = box_within_grids(backend, in);
  while(box.extent() > smallest_length && box.extent() < HUGE_VAL) {
    const Coordinate_box inner = without_ends(box, count_slices(backend, in, box));
    if(!(inner.extent() < far_extent * box.extent()))
      break;
    box = inner;
  }
  return box;
}

// The points in a box, on a grid, with their normals.
template <class Backend>
Host_buffer<Grid_point> points_in_box(Backend& backend, const Import& in, const Grid& grid, const Coordinate_box& box)
{
  in.download_values();
  const auto place = [&](std::size_t i) {
    const std::uint32_t normal = in.has_normals ? encode_normal(in.normal(i)) : no_normal;
    return to_grid(grid, 1 / grid.step, in.position(i), normal);
  };
  if(is_inside(box, in.box)) {
    Host_buffer<Grid_point> point(in.size());
    backend.for_each(in.size(), [&](std::size_t i) { point[i] = place(i); });
    return point;
  }
  const auto kept = backend.compact(in.size(), [&](std::uint32_t i) { return is_inside(box, in.position(i)); });
  Host_buffer<Grid_point> point(kept.size());
  backend.for_each(kept.size(), [&](std::size_t i) { point[i] = place(kept.data()[i]); });
  return point;
}

// A leaf of the octree of which a cell is in a sample.
struct Sampled_leaf {
  std::uint64_t first_cell, points;
};

// Points in the order of the curve.
struct Cell_sample {
  std::vector<Grid_point> point; // no two at one place
  double points_per_point = 1;   // of those that were sampled: copies count once
};

// A sample of about tuning::estimation::sampled_points points of all ranks. Whole cells are taken at a constant
// stride.
template <class Backend>
Cell_sample sample_cells(Backend& backend, const Host_buffer<Grid_point>& point)
{
  using namespace tuning::estimation;
  const Ranks<Backend> ranks(backend);
  Box box;
  for(const Grid_point& p : point)
    box.add(p);
  for(const Box& part : ranks.gather(std::vector<Box>{box}))
    box.add(part);
  const Code_frame frame = make_code_frame(box);
  auto order = sort_along_curve(backend, {point.data(), point.size()}, frame);
  const std::vector<Octant> leaves = find_leaves(backend, order, frame, sampled_cell_size);
  const std::uint64_t stride = (ranks.total(point.size()) + sampled_points - 1) / sampled_points;
  std::vector<Sampled_leaf> chosen;
  std::vector<Grid_point> own;
  std::uint64_t cell = 0;
  for(const Octant& leaf : leaves) {
    const std::uint64_t end = cell + leaf.number_of_cells(sampled_cell_size);
    if((cell + stride - 1) / stride * stride < end) {
      chosen.push_back({cell, leaf.total});
      for(std::uint32_t i = leaf.own.first; i < leaf.own.last; ++i)
        own.push_back(point[order.view().index(i)]);
    }
    cell = end;
  }
  // A leaf of several cells is cut when all of its points are here.
  const std::vector<Grid_point> all = ranks.gather(std::move(own));
  if constexpr(Ranks<Backend>::are_many)
    order = sort_along_curve(backend, {all.data(), all.size()}, frame);
  Cell_sample sample;
  std::size_t first = 0;
  for(const Sampled_leaf& leaf : chosen) {
    for(std::uint64_t i = 0; i < leaf.points; ++i)
      if((leaf.first_cell + i / sampled_cell_size) % stride == 0)
        sample.point.push_back(all[Ranks<Backend>::are_many ? order.view().index(first + i) : first + i]);
    first += leaf.points;
  }
  const auto are_copies = [](const Grid_point& a, const Grid_point& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  };
  const std::size_t sampled = sample.point.size();
  sample.point.erase(std::unique(sample.point.begin(), sample.point.end(), are_copies), sample.point.end());
  if(sampled > 0)
    sample.points_per_point = double(sampled) / double(sample.point.size());
  return sample;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_SAMPLE_CELLS_H
