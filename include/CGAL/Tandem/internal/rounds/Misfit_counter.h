// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Counts how many points of a shape would no longer fit, if a plane replaced the local one. Decides nothing. Changes
// last_misfits of shapes. See the manual, "Verification and Rollback".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_MISFIT_COUNTER_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_MISFIT_COUNTER_H

#include <CGAL/Tandem/internal/shapes/Count_scratch.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>
#include <CGAL/Tandem/internal/shapes/Tested_shape.h>

#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// A point that is tested against planes of its shape. A copy, so that repeated tests read consecutive memory.
struct Sample {
  Grid_point point;
  std::uint32_t place; // of its shape among the tested ones
};

// Memory for the samples, which counters take one after the other.
template <class Backend>
struct Sample_memory {
  // Few of the points of a large cloud are samples, so they are counted before memory is taken. For a smaller one,
  // memory for all points takes less time.
  std::size_t large_cloud = std::size_t(1) << 24;
  typename Backend::template Buffer<Sample> sample = {};
};

// Copies the points that may be counted, those of a cell to one range. Ranges and points come in any order, which does
// not change the counts. Each cell is passed twice: its points have to be counted before its range is known. Without
// memory for the samples they are only counted.
template <class Backend>
struct Collect_samples {
  Cloud_view cloud;
  Cells_view cells;
  const std::uint32_t* label;
  const std::uint32_t* place_of; // by shape: its place among the tested ones, or no_index
  const std::uint32_t* mask;     // by place
  Sample* sample;                // or null
  std::uint32_t* size;           // of all
  Range* range;                  // by part of a cell: where its samples are, in any order

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Count_scratch& scratch, std::uint32_t c) const
  {
    block.single([&] { range[c] = {0, 0}; });
    if(!cells.may_have(block, c, [&](std::uint32_t s) { return place_of[s] != no_index; }))
      return;
    const Range cell = cells[c];
    std::uint32_t& count = scratch.count[0];
    block.single([&] { count = 0; });
    block.for_each(cell.size(), [&](std::uint32_t at) {
      if(selected_place(cell.first + at) != no_index)
        block.append(count);
    });
    std::uint32_t& place = scratch.count[1];
    block.single([&] {
      place = Backend::atomic_add(*size, count);
      range[c] = {place, place + count};
    });
    if(sample == nullptr)
      return;
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = cell.first + at, p = selected_place(i);
      if(p != no_index)
        sample[block.append(place)] = {cloud.point[i], p};
    });
  }

private:
  // That of the shape of a point, if it is in the sample.
  CGAL_TANDEM_HD std::uint32_t selected_place(std::uint32_t i) const
  {
    const std::uint32_t p = label[i] < first_mark ? place_of[label[i]] : no_index;
    return p != no_index && ((i + cloud.first) & mask[p]) == 0 ? p : no_index;
  }
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
  const Range* ranges;           // of samples, by part of a cell
  const std::uint32_t* place_of; // by shape
  const std::uint32_t* query_of; // by place, no_index if the shape has none
  const Misfit_query* query;
  std::uint32_t* count; // by query
  Tolerance tolerance;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Count_scratch& scratch, std::uint32_t c) const
  {
    const Range range = ranges[c];
    if(range.size() == 0 || !cells.may_have(block, c, [&](std::uint32_t s) { return has_query(s); }))
      return;
    scratch.clear(block);
    block.for_each(range.size(), [&](std::uint32_t at) {
      const Grid_point& p = sample[range.first + at].point;
      const std::uint32_t q = query_of[sample[range.first + at].place];
      if(q != no_index && !fits(query[q].after, p, tolerance) && fits(query[q].before, p, tolerance))
        scratch.template add<Backend>(block, q, count);
    });
    scratch.template flush<Backend>(block, count);
  }

private:
  CGAL_TANDEM_HD bool has_query(std::uint32_t s) const
  {
    return place_of[s] != no_index && query_of[place_of[s]] != no_index;
  }
};

struct Choose_mask {
  const Shape* shape;
  const std::uint32_t* id;
  std::uint32_t* mask;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { mask[i] = sample_mask(shape[id[i]].moments.count); }
};

// A query for each of the shapes whose share of misfits is not known. All but the shape are by place.
struct Start_query {
  const Shape* shape;
  const std::uint32_t* id;
  const Regular_plane* candidate;
  double maximum_distance;
  double* share;
  Misfit_query* query;
  std::uint32_t* query_of;
  std::uint32_t* count;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const Shape& s = shape[id[i]];
    const bool is_known = tested(s).knows_share(candidate[i], maximum_distance, share[i]);
    query_of[i] = is_known ? no_index : std::uint32_t(i);
    count[i] = 0;
    if(!is_known)
      query[i] = {rounded(s.local), rounded(candidate[i])};
  }
};

struct Finish_query {
  Shape* shape;
  const std::uint32_t* id;
  const Regular_plane* candidate;
  const std::uint32_t* query_of;
  const std::uint32_t* count;
  double* share;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(query_of[i] == no_index)
      return;
    Tested_shape s = tested(shape[id[i]]);
    share[i] = s.take_count(candidate[i], count[i]);
    shape[id[i]].history.last_misfits = s.last;
  }
};

// Samples are collected once, since the same shapes are tested several times in a step.
template <class Backend>
class Misfit_counter {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

public:
  // ids: the shapes that may be tested; their places in this list are those below. Points keep their labels until the
  // last test, and lists have to hold for them.
  Misfit_counter(Labeled_cloud<Backend>& points, const Shape_table<Backend>& shapes, const Options& options,
                 const Buffer<std::uint32_t>& ids, Sample_memory<Backend>& memory)
    : points_(points), options_(options), memory_(memory), tested_(ids.size())
  {
    if(tested_ > 0)
      collect_samples(shapes, ids);
  }

  // The misfits of each query. query_of: by place, no_index for shapes that are not tested.
  std::vector<std::uint32_t> count(const std::vector<std::uint32_t>& query_of, const std::vector<Misfit_query>& query)
  {
    Backend& backend = points_.backend;
    // The counts, which begin at zero, travel with the numbers of the queries.
    auto numbers = backend.template make_buffer<std::uint32_t>(
      tested_ + query.size(), [&](std::size_t i) { return i < tested_ ? query_of[i] : 0; });
    const auto queries = to_buffer(backend, query);
    std::uint32_t* const misfits = numbers.data() + tested_;
    count_samples(numbers.data(), queries.data(), query.size(), misfits);
    return to_vector(backend, misfits, query.size());
  }

  // By place: the share of the points of each shape that fits its local plane, but not the candidate.
  Buffer<double> shares(Shape_table<Backend>& shapes, const Buffer<std::uint32_t>& ids,
                        const Buffer<Regular_plane>& candidates)
  {
    Backend& backend = points_.backend;
    Buffer<double> share(tested_);
    Buffer<Misfit_query> query(tested_);
    Buffer<std::uint32_t> query_of(tested_), misfits(tested_);
    backend.for_each(tested_,
                     Start_query{shapes.fitted(), ids.data(), candidates.data(), options_.maximum_distance,
                                 share.data(), query.data(), query_of.data(), misfits.data()},
                     shapes_per_thread);
    count_samples(query_of.data(), query.data(), tested_, misfits.data());
    backend.for_each(
      tested_,
      Finish_query{shapes.fitted(), ids.data(), candidates.data(), query_of.data(), misfits.data(), share.data()},
      shapes_per_thread);
    return share;
  }

private:
  void collect_samples(const Shape_table<Backend>& shapes, const Buffer<std::uint32_t>& ids)
  {
    Backend& backend = points_.backend;
    range_.reset(points_.number_of_parts());
    place_of_ = places_of(backend, shapes.size, ids);
    Buffer<std::uint32_t> mask(tested_);
    backend.for_each(tested_, Choose_mask{shapes.counted(), ids.data(), mask.data()});
    auto size = filled_buffer(backend, 1, std::uint32_t(0));
    Collect_samples<Backend> collect = {
      points_.cloud.view(), points_.listed_parts(), points_.label(), place_of_.data(), mask.data(), nullptr,
      size.data(),          range_.data()};
    std::size_t maximum = points_.cloud.size();
    if(maximum > memory_.large_cloud) {
      backend.template for_each_cell<Count_scratch>(points_.number_of_parts(), collect);
      maximum = to_vector(backend, size)[0];
      backend.for_each(1, Fill<std::uint32_t>{size.data(), 0});
    }
    if(memory_.sample.size() < maximum)
      memory_.sample.reset(maximum);
    collect.sample = memory_.sample.data();
    backend.template for_each_cell<Count_scratch>(points_.number_of_parts(), collect);
  }

  void count_samples(const std::uint32_t* query_of, const Misfit_query* query, std::size_t queries,
                     std::uint32_t* misfits)
  {
    points_.backend.template for_each_cell<Count_scratch>(
      points_.number_of_parts(),
      Count_misfits<Backend>{points_.listed_parts(), memory_.sample.data(), range_.data(), place_of_.data(), query_of,
                             query, misfits, options_.growth.tolerance});
    points_.ranks.sum(misfits, queries);
  }

  Labeled_cloud<Backend>& points_;
  const Options& options_;
  Sample_memory<Backend>& memory_;
  std::size_t tested_;
  Buffer<std::uint32_t> place_of_; // by id
  Buffer<Range> range_;            // of the samples of each part of a cell
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_MISFIT_COUNTER_H
