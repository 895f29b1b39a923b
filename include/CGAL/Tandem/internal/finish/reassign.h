// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A pass over assigned points while planes are fixed: points move to larger shapes that they fit. Changes labels and
// interior bits of points, and moments and boxes of shapes, nothing else. See the manual, "Reassignment".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_REASSIGN_H
#define CGAL_TANDEM_INTERNAL_FINISH_REASSIGN_H

#include <CGAL/Tandem/internal/base/tuning/finish.h>
#include <CGAL/Tandem/internal/shapes/require.h>

#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// For each point of a shape that may lose points: the largest shape among those of its neighbors that it fits, if it is
// of one surface with the nearest one, so that adjacent layers stay apart. Ties go to the smaller id. Labels are only
// read, so the order of points does not matter. If `marks_interior`, a point whose neighbors all have its label becomes
// interior.
struct Choose_largest {
  Cloud_view cloud;
  const std::uint32_t* label;
  std::uint8_t* state;
  const Plane* plane; // these three by shape
  const std::int64_t* size;
  const std::uint8_t* may_lose;
  std::uint32_t* chosen; // by point: its next label
  Tolerance tolerance;
  bool marks_interior;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t s = label[i];
    chosen[i] = s;
    if(s >= first_mark || (state[i] & interior_bit) || !(may_lose[s] || marks_interior))
      return;
    // Most points have neighbors of their own shape only, or also free ones: they have no choice.
    const std::uint32_t* row = cloud.row(std::uint32_t(i));
    bool all_same = true, has_choice = false;
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t t = label[row[j]];
      all_same = all_same && t == s;
      has_choice = has_choice || (t < first_mark && t != s);
    }
    if(marks_interior && all_same)
      state[i] |= interior_bit;
    if(has_choice && may_lose[s])
      chosen[i] = choose(i, s);
  }

private:
  // For a point of shape s. A neighbor with the label of the one before would not change the choice.
  CGAL_TANDEM_HD std::uint32_t choose(std::size_t i, std::uint32_t s) const
  {
    const std::uint32_t* row = cloud.row(std::uint32_t(i));
    const std::uint32_t nearest = nearest_shape(i, s);
    std::uint32_t best = are_one_surface(s, nearest, i) ? s : nearest, last = s;
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t t = label[row[j]];
      if(t >= first_mark || t == last)
        continue;
      last = t;
      if(is_before(t, best) && may_take(t, i) && are_one_surface(t, nearest, i))
        best = t;
    }
    return best;
  }

  // The order by falling size, then by id.
  CGAL_TANDEM_HD bool is_before(std::uint32_t t, std::uint32_t s) const
  {
    return size[t] > size[s] || (size[t] == size[s] && t < s);
  }

  CGAL_TANDEM_HD bool may_take(std::uint32_t t, std::size_t i) const
  {
    return fits(plane[t], cloud.point[i], tolerance);
  }

  // To the plane of shape s, in 2^-28 grid steps.
  CGAL_TANDEM_HD std::int64_t distance(std::uint32_t s, std::size_t i) const
  {
    const std::int64_t e = signed_distance(plane[s], cloud.point[i]);
    return e < 0 ? -e : e;
  }

  // Of the own shape s and those that may take the point; of equally near ones the smallest id.
  CGAL_TANDEM_HD std::uint32_t nearest_shape(std::size_t i, std::uint32_t s) const
  {
    const std::uint32_t* row = cloud.row(std::uint32_t(i));
    std::uint32_t nearest = s, last = s;
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t t = label[row[j]];
      if(t >= first_mark || t == nearest || t == last)
        continue;
      last = t;
      if(!may_take(t, i))
        continue;
      const std::int64_t d = distance(t, i), least = distance(nearest, i);
      if(d < least || (d == least && t < nearest))
        nearest = t;
    }
    return nearest;
  }

  // Whether a shape is about as near as the nearest one, or their planes are close to each other at the point.
  // Otherwise they are layers there.
  CGAL_TANDEM_HD bool are_one_surface(std::uint32_t t, std::uint32_t nearest, std::size_t i) const
  {
    constexpr tuning::Share layers = tuning::end_game::layer_distance;
    if(distance(t, i) <= distance(nearest, i) + tolerance.distance / tuning::end_game::distance_per_farther_plane)
      return true;
    const Plane &a = plane[t], &b = plane[nearest];
    const std::int64_t cosine = normal_product(a, {b.nx, b.ny, b.nz});
    const std::int64_t e = signed_distance(a, cloud.point[i]), f = signed_distance(b, cloud.point[i]);
    const std::int64_t apart = cosine < 0 ? e + f : e - f;
    return !layers.is_exceeded(apart < 0 ? -apart : apart, tolerance.distance);
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
      labels.state[i] &= std::uint8_t(~interior_bit);
      table.template add<Backend>(block, old, cloud.point[i], -1, changes);
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
  backend.template for_each_cell<Moment_table>(
    points.number_of_cells(), Apply_chosen<Backend>{points.cloud.view(), points.cells.data(), chosen, labels,
                                                    start_deltas(backend, shapes, shapes.size)});
  points.refresh_labels();
  sum_deltas(points.backend, points.ranks, shapes);
  const bool is_any = count_deltas(backend, shapes) > 0;
  add_deltas(backend, shapes);
  return is_any;
}

// What a round knows of the shapes, by id: their sizes, and which ones may lose points. Points become interior where
// that is marked.
struct Reassignment {
  const std::int64_t* size;
  const std::uint8_t* may_lose;
  Phase phase;
  bool marks_interior;
};

// One round, computed from the labels of the round before (Jacobi): see take_chosen().
template <class Backend>
bool reassign(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Tolerance& tolerance,
              const Reassignment& r)
{
  Backend& backend = points.backend;
  const std::size_t n = points.cloud.size();
  typename Backend::template Buffer<std::uint32_t> chosen(n);
  backend.for_each(n,
                   Choose_largest{points.cloud.view(), points.label(), states_of(points, r.phase), shapes.plane.data(),
                                  r.size, r.may_lose, chosen.data(), tolerance, r.marks_interior});
  return take_chosen(points, shapes, chosen.data());
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_REASSIGN_H
