// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each point goes to the adjacent shape where it is worth most: see score/Score.h. Planes are fixed meanwhile. Changes
// labels of points, and moments and boxes of shapes. See the manual, "Assignment".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_ASSIGN_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_ASSIGN_H

#include <CGAL/Tandem/internal/rounds/Assignment_passes.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/require.h>

#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Set_assigned {
  const Shape* shape;
  const Plane* plane;
  Score score;
  Assigned_shape* assigned;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    const std::int64_t n = shape[id].moments.count;
    assigned[id] = {plane[id], n > 0 ? score.point_bonus(n) : 0, shape[id].plane_number};
  }
};

// The first labels: a point that does not fit its shape leaves it. Notes which of them are others than those that the
// last assignment chose.
template <class Backend>
struct Start_assignment {
  Cloud_view cloud;
  const std::uint32_t* label;
  const Assigned_shape* shape;
  std::uint32_t *chosen, *next; // by point
  Block_points* changed;        // by block
  Tolerance tolerance;

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    const std::uint32_t i = std::uint32_t(at);
    std::uint32_t s = label[i];
    if(s < first_mark && !cloud.fits(shape[s].plane, i, tolerance))
      s = free_label;
    if(i < cloud.size && chosen[i] != s)
      Backend::atomic_add(changed[i / Block_row::points], bit_of(i));
    chosen[i] = next[i] = s;
  }
};

// For each cell: writes the chosen labels, and sums what each shape loses and what it gets. A point changes its cell's
// table only where its label changes. Integer sums, so the order does not matter.
template <class Backend>
struct Apply_chosen {
  Cloud_view cloud;
  const Range* cells;
  const std::uint32_t* chosen;
  Labels_view labels;
  Shared_moments* change; // by shape, lost points with sign -1

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Moment_table& table, std::uint32_t c) const
  {
    const Range cell = cells[c];
    const Cell_sums changes = {cloud.surfels, cloud.point[cell.first], change};
    table.clear(block);
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = cell.first + at;
      const std::uint32_t old = labels.label[i], s = chosen[i];
      if(old == s)
        return;
      labels.label[i] = s;
      if(old < first_mark)
        table.template add<Backend>(block, old, i, -1, changes);
      if(s < first_mark)
        table.template add<Backend>(block, s, i, 1, changes);
    });
    table.template flush<Backend>(block, changes);
  }
};

// Points take the chosen labels, by position. Moments follow; boxes may be too large, because a lost point does not
// shrink them. Shapes may become empty.
template <class Backend>
void take_chosen(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const std::uint32_t* chosen)
{
  Backend& backend = points.backend;
  const Labels_view labels = points.change_labels(false);
  points.lose_interior();
  backend.template for_each_cell<Moment_table>(
    points.number_of_cells(), Apply_chosen<Backend>{points.cloud.view(), points.cells.data(), chosen, labels,
                                                    start_deltas(backend, shapes, shapes.size)});
  points.refresh_labels();
  sum_deltas(backend, points.ranks, shapes);
  add_deltas(backend, shapes);
}

// Assignments of one cloud. Each remembers the labels that it has chosen, and which points had neighbors in other
// shapes. So the next one looks at those and at what has changed since, and chooses as if it looked at all points.
template <class Backend>
class Assignment {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

public:
  explicit Assignment(Labeled_cloud<Backend>& points)
    : points_(points), backend_(points.backend), block_(points.backend, points.cloud),
      chosen_(filled_buffer(backend_, points.cloud.size_with_ghosts(), no_index)),
      border_(filled_buffer(backend_, block_.row.size(), Block_points(0))),
      changes_(filled_buffer(backend_, 2 * block_.row.size(), ~Block_points(0)))
  {}

  // Planes are those of the table that is rounded for the tests of points. What a shape gains by one point more follows
  // from its size at the beginning.
  void operator()(Shape_table<Backend>& shapes, const Options& options)
  {
    require(points_, shapes, tables::moments);
    Buffer<Assigned_shape> assigned(shapes.size);
    for_each_shape(backend_, shapes,
                   Set_assigned{shapes.counted(), shapes.plane.data(), options.score, assigned.data()});
    const Cloud_view cloud = points_.cloud.view();
    const std::size_t blocks = block_.row.size();
    Buffer<std::uint32_t> next(chosen_.size());
    auto outside = filled_buffer(backend_, blocks, Block_points(0));
    auto has_changes = filled_buffer(backend_, tuning::moves::assignment_passes, std::uint32_t(0));
    Buffer<Block_points> recent(blocks);
    backend_.for_each(chosen_.size(), Start_assignment<Backend>{cloud, points_.label(), assigned.data(), chosen_.data(),
                                                                next.data(), outside.data(), options.growth.tolerance});
    const Assignment_passes<Backend> passes = {cloud,
                                               assigned.data(),
                                               blocks,
                                               block_.row.data(),
                                               block_.of_point.data(),
                                               outside.data(),
                                               recent.data(),
                                               {changes_.data(), changes_.data() + blocks},
                                               border_.data(),
                                               has_changes.data(),
                                               {chosen_.data(), next.data()},
                                               options.score,
                                               options.growth.tolerance};
    run(passes);
    take_chosen(points_, shapes, chosen_.data());
    points_.begin_phase(Phase::end);
    for_each_by_group(backend_, blocks, Set_interior<Backend>{passes, points_.state()});
  }

private:
  void run(const Assignment_passes<Backend>& passes)
  {
    constexpr std::size_t maximum = tuning::moves::assignment_passes;
    const std::size_t blocks = block_.row.size();
    if constexpr(!Ranks<Backend>::are_many)
      backend_.run_rounds(maximum, blocks, passes);
    else
      run_joint_rounds(backend_, maximum, blocks, passes, [&](int step, std::size_t pass) {
        if(step == Assignment_passes<Backend>::visit)
          points_.ranks.refresh(passes.label[(pass + 1) % 2], Rings::inner);
        return false;
      });
  }

  Labeled_cloud<Backend>& points_;
  Backend& backend_;
  Block_rows<Backend> block_;
  Buffer<std::uint32_t> chosen_; // by point
  Buffer<Block_points> border_;  // these two as in Assignment_passes
  Buffer<Block_points> changes_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_ASSIGN_H
