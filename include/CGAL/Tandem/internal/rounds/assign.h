// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each point goes to the adjacent shape where it is worth most: see score/Score.h. Planes are fixed meanwhile. Changes
// labels of points, and moments and boxes of shapes. See the manual, "Assignment".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_ASSIGN_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_ASSIGN_H

#include <CGAL/Tandem/internal/base/pairs.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/require.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// What an assignment reads of a shape.
struct Assigned_shape {
  Plane plane;
  std::int64_t bonus;        // of one more point
  std::int64_t plane_number; // of the relations, -1: none
};

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

// The next label of each point: the one that is worth most, of its own and those of its neighbors that it fits. A free
// point joins any shape that it fits; a point that does not fit its shape leaves it in any case. Of the other points
// each pass considers one half, so that neighbors do not swap their shapes for ever. Shapes of one plane exchange no
// points, since the plane does not tell them apart. Labels are only read, so the order of points does not matter.
struct Assign_point {
  Cloud_view cloud;
  const std::uint32_t* label;
  const Assigned_shape* shape;
  std::uint32_t* chosen; // by point
  Score score;
  Tolerance tolerance;
  std::uint32_t pass;

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    const std::uint32_t i = std::uint32_t(at), s = label[i];
    const bool is_at_home = s < first_mark && fits(shape[s].plane, cloud.point[i], tolerance);
    chosen[i] = is_at_home ? s : s < first_mark ? free_label : s;
    if((is_at_home && !is_considered(i)) || !has_choice(i, s))
      return;
    chosen[i] = best_of(i, chosen[i], is_at_home ? worth(i, s, 0) : 0);
  }

private:
  CGAL_TANDEM_HD bool has_choice(std::uint32_t i, std::uint32_t s) const
  {
    const std::uint32_t* row = cloud.row(i);
    bool result = false;
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j)
      result = result || (label[row[j]] < first_mark && label[row[j]] != s);
    return result;
  }

  // One half of the points in even passes, the other one in odd passes.
  CGAL_TANDEM_HD bool is_considered(std::uint32_t i) const
  {
    return (hash_of_pair(i + cloud.first) >> 63) == (pass & 1u);
  }

  // Of the own label, which is worth that, and those of neighbors. Ties go to the smaller one.
  CGAL_TANDEM_HD std::uint32_t best_of(std::uint32_t i, std::uint32_t own, std::int64_t worth_of_own) const
  {
    const std::uint32_t* row = cloud.row(i);
    std::uint32_t best = own;
    std::int64_t most = worth_of_own;
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t t = label[row[j]];
      if(t >= first_mark || t == own || !is_first(row, j) || are_of_one_plane(own, t) ||
         !fits(shape[t].plane, cloud.point[i], tolerance))
        continue;
      const std::int64_t w = worth(i, t, j);
      if(best >= first_mark || w > most || (w == most && t < best)) {
        most = w;
        best = t;
      }
    }
    return best;
  }

  // Whether no neighbor before the j-th has its label.
  CGAL_TANDEM_HD bool is_first(const std::uint32_t* row, int j) const
  {
    for(int before = 0; before < j; ++before)
      if(label[row[before]] == label[row[j]])
        return false;
    return true;
  }

  CGAL_TANDEM_HD bool are_of_one_plane(std::uint32_t s, std::uint32_t t) const
  {
    return s < first_mark && shape[s].plane_number >= 0 && shape[s].plane_number == shape[t].plane_number;
  }

  // Of point i in shape s, which no neighbor before the j-th has.
  CGAL_TANDEM_HD std::int64_t worth(std::uint32_t i, std::uint32_t s, int j) const
  {
    const std::uint32_t* row = cloud.row(i);
    std::int64_t links = 0;
    for(; j < cloud.k && row[j] != no_index; ++j)
      links += label[row[j]] == s;
    const Score_item item = {1, tolerance.distance};
    return Score::weight(item, signed_distance(shape[s].plane, cloud.point[i])) - score.links(links) + shape[s].bonus;
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
    const Cell_sums changes = {cloud.point[cell.first], change};
    table.clear(block);
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = cell.first + at;
      const std::uint32_t old = labels.label[i], s = chosen[i];
      if(old == s)
        return;
      labels.label[i] = s;
      if(old < first_mark)
        table.template add<Backend>(block, old, cloud.point[i], -1, changes);
      if(s < first_mark)
        table.template add<Backend>(block, s, cloud.point[i], 1, changes);
    });
    table.template flush<Backend>(block, changes);
  }
};

// Points take the chosen labels, by position. Moments follow; boxes may be too large, because a lost point does not
// shrink them. Shapes may become empty. Returns whether any label has changed.
template <class Backend>
bool take_chosen(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const std::uint32_t* chosen)
{
  Backend& backend = points.backend;
  const Labels_view labels = points.change_labels(false);
  points.lose_interior();
  backend.template for_each_cell<Moment_table>(
    points.number_of_cells(), Apply_chosen<Backend>{points.cloud.view(), points.cells.data(), chosen, labels,
                                                    start_deltas(backend, shapes, shapes.size)});
  points.refresh_labels();
  sum_deltas(backend, points.ranks, shapes);
  const bool is_any = count_deltas(backend, shapes) > 0;
  add_deltas(backend, shapes);
  return is_any;
}

// So many passes, or until no label changes in two of them, which consider all points. Planes are those of the table that is rounded for the tests of points.
template <class Backend>
void assign(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
            int passes = tuning::moves::assignment_passes)
{
  Backend& backend = points.backend;
  typename Backend::template Buffer<std::uint32_t> chosen(points.cloud.size());
  typename Backend::template Buffer<Assigned_shape> assigned(shapes.size);
  int idle = 0; // passes since a label has changed
  for(int pass = 0; pass < passes && idle < 2; ++pass) {
    require(points, shapes, tables::moments);
    for_each_shape(backend, shapes,
                   Set_assigned{shapes.counted(), shapes.plane.data(), options.score, assigned.data()});
    backend.for_each(chosen.size(), Assign_point{points.cloud.view(), points.label(), assigned.data(), chosen.data(),
                                                 options.score, options.growth.tolerance, std::uint32_t(pass)});
    idle = take_chosen(points, shapes, chosen.data()) ? 0 : idle + 1;
  }
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_ASSIGN_H
