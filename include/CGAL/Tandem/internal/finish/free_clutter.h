// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which shapes are clutter: planes through a volume of points, such as a tree, which most points around are not near.
// The price of links cannot remove them, since their points have links to each other. Changes labels, states and
// shapes. See the manual, "Clutter".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_FREE_CLUTTER_H
#define CGAL_TANDEM_INTERNAL_FINISH_FREE_CLUTTER_H

#include <CGAL/Tandem/internal/base/tuning/score.h>
#include <CGAL/Tandem/internal/score/Score.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

namespace CGAL::Tandem::internal {

// The balance of one shape.
struct Balance_run {
  std::uint32_t shape = no_index;
  std::int64_t balance = 0;
};

// For each cell, sums the balance of the shapes of its surfels: k times the weight of each point, minus what the
// neighbors beyond epsilon of the plane count as free points. Free points count 1. Points of other shapes count by how
// far they are from their own planes, so that parallel planes through one tree do not support each other: 1 on average
// in a volume, and about 0 on a face. Integer sums, so the order does not matter.
template <class Backend>
struct Sum_balances {
  Cloud_view cloud;
  Cells_view cells;
  const std::uint32_t* label;
  const Plane* plane;    // by shape
  std::int64_t* balance; // by shape
  Tolerance tolerance;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, No_scratch&, std::uint32_t c) const
  {
    const Range cell = cells[c];
    const auto add = [&](const Balance_run& run) {
      if(run.shape != no_index)
        Backend::atomic_add(balance[run.shape], run.balance);
    };
    block.template accumulate<Balance_run>(
      cell.size(),
      [&](std::uint32_t at, Balance_run& run) {
        const std::uint32_t i = cell.first + at, s = label[i];
        if(s >= first_mark)
          return;
        if(s != run.shape) {
          add(run);
          run = {s, 0};
        }
        run.balance += std::int64_t(cloud.surfels.points(i).size()) * balance_of(i, s);
      },
      add);
  }

private:
  CGAL_TANDEM_HD std::int64_t balance_of(std::uint32_t i, std::uint32_t s) const
  {
    const std::int64_t distance = cloud.tolerance_of(i, tolerance).distance;
    constexpr tuning::Ratio free_link = tuning::score::free_link;
    std::int64_t result = cloud.k * weight(i, s);
    const std::uint32_t* row = cloud.row(i);
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j)
      if(label[row[j]] != s && !is_near(plane[s], cloud.point[row[j]], distance))
        result -= free_link.of(free_weight(row[j]));
    return result;
  }

  CGAL_TANDEM_HD std::int64_t weight(std::uint32_t i, std::uint32_t s) const
  {
    return Score::weight(cloud.tolerance_of(i, tolerance), signed_distance(plane[s], cloud.point[i]));
  }

  CGAL_TANDEM_HD std::int64_t free_weight(std::uint32_t q) const
  {
    if(label[q] >= first_mark)
      return Score::unit;
    return tuning::score::own_distance * (Score::unit - weight(q, label[q]));
  }
};

struct Is_clutter {
  const std::int64_t* balance;

  CGAL_TANDEM_HD bool operator()(const Shape&, std::size_t id) const { return balance[id] < 0; }
};

// Dissolves the shapes that are clutter, all at once; their surfels are free again. Planes have to be rounded in the
// table.
template <class Backend>
void free_clutter(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Tolerance& tolerance)
{
  Backend& backend = points.backend;
  auto balance = filled_buffer(backend, shapes.size, std::int64_t(0));
  backend.template for_each_cell<No_scratch>(points.number_of_parts(),
                                             Sum_balances<Backend>{points.cloud.view(), points.parts(), points.label(),
                                                                   shapes.plane.data(), balance.data(), tolerance});
  points.ranks.sum(balance.data(), balance.size());
  drop_shapes(points, shapes, Is_clutter{balance.data()});
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_FINISH_FREE_CLUTTER_H
