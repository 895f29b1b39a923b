// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Counts how many points of a shape would no longer fit, if a plane replaced the local one. Decides nothing. Changes
// the samples of the cloud and last_misfits of the shapes. See the manual, "Verification and Rollback".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_MISFIT_COUNTER_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_MISFIT_COUNTER_H

#include <CGAL/Tandem/internal/memory/Unset_vector.h>
#include <CGAL/Tandem/internal/regularity/cluster_directions.h>
#include <CGAL/Tandem/internal/shapes/Count_scratch.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Which points of a shape are counted: those whose position has no bit of its mask, so all, every second one, every
// fourth one ... Positions follow the curve, so a sample is spread over the shape. This mask means: none.
constexpr std::uint32_t no_sample = 0xffffffffu;

// Copies the points that may be counted, those of a cell to one range. Ranges and points come in any order, which does
// not change the counts. Each cell is passed twice: its points have to be counted before its range is known.
template <class Backend>
struct Collect_samples {
  Cloud_view cloud;
  Cells_view cells;
  const std::uint32_t* label;
  const std::uint32_t* mask; // by shape
  Sample* sample;
  std::uint32_t* size; // of all
  Range* range;        // by cell: where its samples are, in any order

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Count_scratch& scratch, std::uint32_t c) const
  {
    block.single([&] { range[c] = {0, 0}; });
    if(!cells.shapes[c].may_have(block, [&](std::uint32_t s) { return mask[s] != no_sample; }))
      return;
    const Range cell = cells[c];
    std::uint32_t& count = scratch.count[0];
    block.single([&] { count = 0; });
    block.for_each(cell.size(), [&](std::uint32_t at) {
      if(is_selected(cell.first + at))
        block.append(count);
    });
    std::uint32_t& place = scratch.count[1];
    block.single([&] {
      place = Backend::atomic_add(*size, count);
      range[c] = {place, place + count};
    });
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = cell.first + at;
      if(is_selected(i))
        sample[block.append(place)] = {cloud.point[i], label[i]};
    });
  }

private:
  CGAL_TANDEM_HD bool is_selected(std::uint32_t i) const { return label[i] < first_mark && (i & mask[label[i]]) == 0; }
};

// The local plane of a shape, and the candidate.
struct Misfit_query {
  Plane before, after;
};

// Counts the samples that fit the first plane of their shape but not the second. Points that fit neither are not due to
// the candidate.
template <class Backend>
struct Count_misfits {
  Cells_view cells;
  const Sample* sample;
  const Range* ranges;           // of samples, by cell
  const std::uint32_t* query_of; // by shape, no_index if it is not tested
  const Misfit_query* query;
  std::uint32_t* count; // by query
  Tolerance tolerance;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Count_scratch& scratch, std::uint32_t c) const
  {
    if(!cells.shapes[c].may_have(block, [&](std::uint32_t s) { return query_of[s] != no_index; }))
      return;
    const Range range = ranges[c];
    scratch.clear(block);
    block.for_each(range.size(), [&](std::uint32_t at) {
      const Grid_point& p = sample[range.first + at].point;
      const std::uint32_t q = query_of[sample[range.first + at].shape];
      if(q != no_index && !fits(query[q].after, p, tolerance) && fits(query[q].before, p, tolerance))
        scratch.template add<Backend>(block, q, count);
    });
    scratch.template flush<Backend>(block, count);
  }
};

// The largest mask that still selects about sample_size points; 0, which selects all, below twice as many.
inline std::uint32_t sample_mask(const Shape& shape)
{
  std::uint32_t mask = 0;
  while(shape.moments.count / (2 * (std::int64_t(mask) + 1)) >= tuning::verification::sample_size)
    mask = 2 * mask + 1;
  return mask;
}

// Planes that hardly move need no count, and the last count of nearly the same planes is used again. Samples are
// collected once, since the same shapes are tested several times in a step.
template <class Backend>
class Misfit_counter {
public:
  // ids: the shapes that may be tested. Points keep their labels until the last test.
  Misfit_counter(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options, const Ids& ids)
    : points_(points), shapes_(shapes), options_(options), mask_(shapes.size(), no_sample),
      query_of_(shapes.size(), no_index), range_(points.number_of_cells())
  {
    if(!ids.empty())
      collect_samples(ids);
  }

  // For each listed shape, the share of its points that fits its local plane, but not the candidate. No shape is listed
  // twice.
  Unset_vector<double> count(const Ids& ids, const Regular_planes& candidates)
  {
    Unset_vector<double> shares(ids.size());
    Unset_vector<Misfit_query> query(ids.size());
    const std::int64_t selected = sum_on_host(points_.backend, ids.size(), [&](std::size_t i) {
      const Shape& shape = shapes_[ids[i]];
      shares[i] = 0;
      if(is_still(shape, shape.local, candidates[i]) || reuse_last_count(shape, candidates[i], shares[i]))
        return 0;
      query_of_[ids[i]] = std::uint32_t(i);
      query[i] = {rounded(shape.local), rounded(candidates[i])};
      return 1;
    });
    if(selected == 0)
      return shares;
    const std::vector<std::uint32_t> misfits = count_samples(query);
    // By all threads: each one writes to the cache lines of its own shapes.
    points_.backend.for_each_on_host(ids.size(), [&](std::size_t i) {
      if(std::exchange(query_of_[ids[i]], no_index) == no_index)
        return;
      Shape& shape = shapes_[ids[i]];
      shares[i] = double(misfits[i]) * (double(mask_[ids[i]]) + 1) / double(shape.moments.count);
      shape.last_misfits = {shape.local, candidates[i], shape.moments.count, shares[i]};
    });
    return shares;
  }

private:
  // Memory for all points, as the number of samples is not known before.
  void collect_samples(const Ids& ids)
  {
    Backend& backend = points_.backend;
    if(points_.sample.size() == 0)
      points_.sample.reset(points_.cloud.size());
    backend.for_each_on_host(ids.size(), [&](std::size_t i) { mask_[ids[i]] = sample_mask(shapes_[ids[i]]); });
    std::vector<std::uint32_t> size(1, 0);
    const auto mask = backend.read_access(mask_);
    const auto counter = backend.read_write_access(size);
    backend.template for_each_cell<Count_scratch>(
      points_.number_of_cells(),
      Collect_samples<Backend>{points_.cloud.view(), points_.cells_view(), points_.label.data(), mask.data(),
                               points_.sample.data(), counter.data(), range_.data()});
  }

  // The misfits by query: one pass over the samples for all of them.
  std::vector<std::uint32_t> count_samples(const Unset_vector<Misfit_query>& query)
  {
    Backend& backend = points_.backend;
    std::vector<std::uint32_t> misfits(query.size(), 0);
    const auto index = backend.read_access(query_of_);
    const auto queries = backend.read_access(query);
    auto counts = backend.read_write_access(misfits);
    backend.template for_each_cell<Count_scratch>(points_.number_of_cells(),
                                                  Count_misfits<Backend>{points_.cells_view(), points_.sample.data(),
                                                                         range_.data(), index.data(), queries.data(),
                                                                         counts.data(), options_.growth.tolerance});
    counts.copy_back();
    return misfits;
  }

  // Whether the distances of all points to both planes are the same, up to a negligible part of epsilon.
  bool is_still(const Shape& shape, const Regular_plane& a, const Regular_plane& b) const
  {
    const bool is_same = a.normal == b.normal && a.offset == b.offset;
    return is_same || bound_motion(shape.box, a, b) <= tuning::motion::negligible * options_.maximum_distance;
  }

  // Whether the last count is of nearly the same points and planes.
  bool reuse_last_count(const Shape& shape, const Regular_plane& candidate, double& share) const
  {
    const Misfit_record& last = shape.last_misfits;
    const std::int64_t change = shape.moments.count - last.points;
    if((change < 0 ? -change : change) * tuning::verification::points_per_change > last.points ||
       !is_still(shape, candidate, last.candidate) || !is_still(shape, shape.local, last.local))
      return false;
    share = last.misfit_share;
    return true;
  }

  Labeled_cloud<Backend>& points_;
  Shape_table<Backend>& shapes_;
  const Options& options_;
  std::vector<std::uint32_t> mask_;                // by shape
  std::vector<std::uint32_t> query_of_;            // by shape, no_index between two counts
  typename Backend::template Buffer<Range> range_; // of the samples of each cell
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_MISFIT_COUNTER_H
