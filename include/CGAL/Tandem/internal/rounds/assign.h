// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each point goes to the adjacent shape where it is worth most: see score/Score.h. Planes are fixed meanwhile. Changes
// labels of points, and moments and boxes of shapes. See the manual, "Assignment".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_ASSIGN_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_ASSIGN_H

#include <CGAL/Tandem/internal/base/pairs.h>
#include <CGAL/Tandem/internal/cloud/Block_rows.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/require.h>

#include <utility>

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

// The first labels: a point that does not fit its shape leaves it.
struct Leave_misfits {
  Cloud_view cloud;
  const std::uint32_t* label;
  const Assigned_shape* shape;
  std::uint32_t* chosen; // by point
  Tolerance tolerance;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t s = label[i];
    chosen[i] = s < first_mark && !cloud.fits(shape[s].plane, i, tolerance) ? free_label : s;
  }
};

// Points whose label has changed in a pass, a bit each, by block.
using Changed_points = std::uint64_t;
static_assert(Block_row::points == 64, "a block has a bit for each point");

// Those of the two passes before: each pass considers one half of the points.
struct Recent_changes {
  const Changed_points *last, *before; // by block

  CGAL_TANDEM_HD Changed_points of_block(std::uint32_t b) const { return last[b] | before[b]; }
  CGAL_TANDEM_HD bool has(std::uint32_t i) const
  {
    return of_block(i / Block_row::points) >> (i % Block_row::points) & 1;
  }
};

// Which blocks a pass has to visit: those that have a neighbor in a block with a recent change. No point has changed in
// this pass yet.
struct Mark_visited {
  const Block_row* row;
  Recent_changes recent;
  std::uint8_t* is_visited;
  Changed_points* changed;

  CGAL_TANDEM_HD void operator()(std::size_t b) const
  {
    bool result = row[b].size > Block_row::capacity;
    for(std::uint32_t i = 0; !result && i < row[b].size; ++i)
      result = recent.of_block(row[b].block[i]) != 0;
    is_visited[b] = result;
    changed[b] = 0;
  }
};

// The next label of each point: the one that is worth most, of its own and those of its neighbors that it fits. A free
// point joins any shape that it fits. Of the other points each pass considers one half, so that neighbors do not swap
// their shapes for ever. Shapes of one plane exchange no points, since the plane does not tell them apart. Labels are
// only read, so the order of points does not matter. Where no label around has changed lately the choice is that of
// before. A block that is not visited has the same labels in both tables.
template <class Backend>
struct Assign_point {
  Cloud_view cloud;
  const std::uint32_t* label;
  const Assigned_shape* shape;
  const std::uint8_t* is_visited; // by block
  Recent_changes recent;
  Changed_points* changed; // by block
  std::uint32_t* chosen;   // by point
  Score score;
  Tolerance tolerance;
  std::uint32_t pass, own; // points of this rank

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    if(!is_visited[at / Block_row::points])
      return;
    const std::uint32_t i = std::uint32_t(at), s = label[i];
    chosen[i] = (s >= first_mark || is_considered(i)) && is_concerned(i) ? best_of(i, s) : s;
    if(chosen[i] != s)
      Backend::atomic_add(changed[i / Block_row::points], Changed_points(1) << (i % Block_row::points));
  }

private:
  // One half of the points in even passes, the other one in odd passes.
  CGAL_TANDEM_HD bool is_considered(std::uint32_t i) const
  {
    return (hash_of_pair(i + cloud.first) >> 63) == (pass & 1u);
  }

  // Whether it or a neighbor has changed its label lately, as ghosts may have.
  CGAL_TANDEM_HD bool is_concerned(std::uint32_t i) const
  {
    const std::uint32_t* row = cloud.row(i);
    bool result = recent.has(i);
    for(int j = 0; j < cloud.k && row[j] != no_index && !result; ++j)
      result = row[j] >= own || recent.has(row[j]);
    return result;
  }

  // Of the own label and those of neighbors. Ties go to the smaller one.
  CGAL_TANDEM_HD std::uint32_t best_of(std::uint32_t i, std::uint32_t own) const
  {
    std::uint32_t other[64]; // labels of neighbors in other shapes: k is at most 64
    std::int64_t links = 0;  // to the own one
    int n = 0;
    const std::uint32_t* row = cloud.row(i);
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t t = label[row[j]];
      links += t == own;
      if(t < first_mark && t != own)
        other[n++] = t;
    }
    std::uint32_t best = own;
    std::int64_t most = n > 0 && own < first_mark ? worth(i, own, links) : 0;
    while(n > 0) {
      const std::uint32_t t = other[n - 1];
      const int count = n;
      n = 0;
      for(int j = 0; j < count; ++j) // the next label, and those that are left
        if(other[j] != t)
          other[n++] = other[j];
      if(are_of_one_plane(own, t))
        continue;
      const std::int64_t w = worth(i, t, count - n);
      if((best >= first_mark || w > most || (w == most && t < best)) && cloud.fits(shape[t].plane, i, tolerance)) {
        most = w;
        best = t;
      }
    }
    return best;
  }

  CGAL_TANDEM_HD bool are_of_one_plane(std::uint32_t s, std::uint32_t t) const
  {
    return s < first_mark && shape[s].plane_number >= 0 && shape[s].plane_number == shape[t].plane_number;
  }

  // Of point i in shape s, with so many links to it.
  CGAL_TANDEM_HD std::int64_t worth(std::uint32_t i, std::uint32_t s, std::int64_t links) const
  {
    const Score_item item = {1, cloud.tolerance_of(i, tolerance).distance};
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

// Assignments of one cloud.
template <class Backend>
class Assignment {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

public:
  explicit Assignment(Labeled_cloud<Backend>& points)
    : points_(points), backend_(points.backend), block_(make_block_rows(points.backend, points.cloud))
  {}

  // Planes are those of the table that is rounded for the tests of points. What a shape gains by one point more follows
  // from its size at the beginning.
  void operator()(Shape_table<Backend>& shapes, const Options& options) const
  {
    require(points_, shapes, tables::moments);
    Buffer<Assigned_shape> assigned(shapes.size);
    for_each_shape(backend_, shapes,
                   Set_assigned{shapes.counted(), shapes.plane.data(), options.score, assigned.data()});
    Buffer<std::uint32_t> now(points_.cloud.size_with_ghosts()), next(now.size());
    backend_.for_each(now.size(), Leave_misfits{points_.cloud.view(), points_.label(), assigned.data(), now.data(),
                                                options.growth.tolerance});
    const auto all = ~Changed_points(0);
    auto last = filled_buffer(backend_, block_.size(), all), before = filled_buffer(backend_, block_.size(), all);
    Buffer<Changed_points> changed(block_.size());
    Buffer<std::uint8_t> is_visited(block_.size());
    for(std::uint32_t pass = 0; pass < tuning::moves::assignment_passes; ++pass) {
      const Recent_changes recent = {last.data(), before.data()};
      backend_.for_each(block_.size(), Mark_visited{block_.data(), recent, is_visited.data(), changed.data()});
      backend_.for_each(points_.cloud.size(),
                        Assign_point<Backend>{points_.cloud.view(), now.data(), assigned.data(), is_visited.data(),
                                              recent, changed.data(), next.data(), options.score,
                                              options.growth.tolerance, pass, std::uint32_t(points_.cloud.size())});
      points_.ranks.refresh(next.data(), Rings::inner);
      std::swap(now, next);
      std::swap(before, changed);
      std::swap(last, before);
    }
    take_chosen(points_, shapes, now.data());
  }

private:
  Labeled_cloud<Backend>& points_;
  Backend& backend_;
  Buffer<Block_row> block_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_ASSIGN_H
