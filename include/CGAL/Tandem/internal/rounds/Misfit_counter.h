// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the points say to a plane: how many would no longer fit.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_MISFIT_COUNTER_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_MISFIT_COUNTER_H

#include <CGAL/Tandem/internal/memory/Unset_vector.h>
#include <CGAL/Tandem/internal/regularity/cluster_directions.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Which points of a shape are asked: those whose position has no bit of the mask,
// so all, every second one, every fourth one ...
constexpr std::uint32_t no_sample = 0xffffffffu;

// Copies the points that may be asked, those of a cell to one place.
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

struct Misfit_query {
  Plane before, after;
};

// Counts the samples that fit the first plane of their shape but not the second.
template <class Backend>
struct Count_misfits {
  Cells_view cells;
  const Sample* sample;
  const Range* ranges;           // of samples, by cell
  const std::uint32_t* query_of; // by shape, no_index if it is not asked
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

// Of a shape with more points than this only a sample is asked whether a plane is
// tolerable. (Whether a point stays is asked of each one.)
constexpr std::int64_t sample_size = 512;

inline std::uint32_t sample_mask(const Shape& shape)
{
  std::uint32_t mask = 0;
  while(shape.moments.count / (2 * (std::int64_t(mask) + 1)) >= sample_size)
    mask = 2 * mask + 1;
  return mask;
}

// Asks the points: which share of each listed shape (once in the list) fits its local plane, but not
// the candidate. Planes that hardly move need no answer from the points, and what
// was asked last, about hardly other planes, is answered from memory.
template <class Backend>
class Misfit_counter {
public:
  // ids: the shapes that may be asked for. Points keep their labels until the last question.
  Misfit_counter(Tandem_state<Backend>& t, const Ids& ids)
    : t_(t), mask_(t.shapes.size(), no_sample), query_of_(t.shapes.size(), no_index), range_(t.number_of_cells)
  {
    if(ids.empty())
      return;
    if(t.sample.size() == 0)
      t.sample.reset(t.cloud.size);
    t.backend.for_each_on_host(ids.size(), [&](std::size_t i) { mask_[ids[i]] = sample_mask(t.shapes[ids[i]]); });
    std::vector<std::uint32_t> size(1, 0);
    const auto mask = t.backend.read_access(mask_);
    const auto counter = t.backend.read_write_access(size);
    t.backend.template for_each_cell<Count_scratch>(
      t.number_of_cells, Collect_samples<Backend>{t.cloud, t.cells_view(), t.label.data(), mask.data(), t.sample.data(),
                                                  counter.data(), range_.data()});
  }

  Unset_vector<double> operator()(const Ids& ids, const Regular_planes& candidates)
  {
    Unset_vector<double> shares(ids.size());
    Unset_vector<Misfit_query> query(ids.size());
    const std::int64_t selected = sum_on_host(t_.backend, ids.size(), [&](std::size_t i) {
      const Shape& shape = t_.shapes[ids[i]];
      shares[i] = 0;
      if(is_still(shape, shape.local, candidates[i]) || remembers(shape, candidates[i], shares[i]))
        return 0;
      query_of_[ids[i]] = std::uint32_t(i);
      query[i] = {rounded(shape.local), rounded(candidates[i])};
      return 1;
    });
    if(selected == 0)
      return shares;
    const std::vector<std::uint32_t> misfits = count(query);
    t_.backend.for_each_on_host(ids.size(), [&](std::size_t i) {
      if(std::exchange(query_of_[ids[i]], no_index) == no_index)
        return;
      Shape& shape = t_.shapes[ids[i]];
      shares[i] = double(misfits[i]) * (double(mask_[ids[i]]) + 1) / double(shape.moments.count);
      shape.last_misfits = {shape.local, candidates[i], shape.moments.count, shares[i]};
    });
    return shares;
  }

private:
  std::vector<std::uint32_t> count(const Unset_vector<Misfit_query>& query)
  {
    std::vector<std::uint32_t> misfits(query.size(), 0);
    const auto index = t_.backend.read_access(query_of_);
    const auto queries = t_.backend.read_access(query);
    auto counts = t_.backend.read_write_access(misfits);
    t_.backend.template for_each_cell<Count_scratch>(
      t_.number_of_cells, Count_misfits<Backend>{t_.cells_view(), t_.sample.data(), range_.data(), index.data(),
                                                 queries.data(), counts.data(), t_.options.growth.tolerance});
    counts.copy_back();
    return misfits;
  }

  bool is_still(const Shape& shape, const Regular_plane& a, const Regular_plane& b) const
  {
    const bool is_same = a.normal == b.normal && a.offset == b.offset;
    return is_same || bound_motion(shape.box, a, b) <= negligible_motion * t_.options.maximum_distance;
  }

  bool remembers(const Shape& shape, const Regular_plane& candidate, double& share) const
  {
    const Misfit_record& record = shape.last_misfits;
    const std::int64_t change = shape.moments.count - record.points;
    if((change < 0 ? -change : change) * 32 > record.points || !is_still(shape, candidate, record.candidate) ||
       !is_still(shape, shape.local, record.local))
      return false;
    share = record.misfit_share;
    return true;
  }

  Tandem_state<Backend>& t_;
  std::vector<std::uint32_t> mask_;                // by shape
  std::vector<std::uint32_t> query_of_;            // by shape, no_index between questions
  typename Backend::template Buffer<Range> range_; // of the samples of each cell
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_MISFIT_COUNTER_H
