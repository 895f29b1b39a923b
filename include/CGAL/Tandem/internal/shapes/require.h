// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What follows from the labels, and is made again where labels have changed since: lists of cells, moments and boxes of
// shapes, their fits, interior bits. A stage says at its beginning what it reads; tables that are out of date cannot be
// read.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_REQUIRE_H
#define CGAL_TANDEM_INTERNAL_SHAPES_REQUIRE_H

#include <CGAL/Tandem/internal/shapes/cell_shapes.h>
#include <CGAL/Tandem/internal/shapes/shape_deltas.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// For each cell: the moments and boxes of the shapes of its points. Successive points often have the same label, so
// each lane sums a run of them before it looks up a slot.
template <class Backend>
struct Sum_moments {
  Cloud_view cloud;
  Cells_view cells;
  const std::uint32_t* label;
  Shared_moments* sum;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Moment_table& table, std::uint32_t c) const
  {
    const Range cell = cells[c];
    if(cell.size() == 0)
      return;
    const Grid_point& base = cloud.point[cell.first];
    const Cell_sums sums = {base, sum};
    const auto add = [&](const Shape_run& run) { table.template add<Backend>(block, run, sums); };
    table.clear(block);
    block.template accumulate<Shape_run>(
      cell.size(),
      [&](std::uint32_t at, Shape_run& run) {
        const std::uint32_t i = cell.first + at;
        if(label[i] >= first_mark)
          return;
        if(label[i] != run.shape) {
          add(run);
          run = Shape_run();
          run.shape = label[i];
        }
        run.add(cloud.point[i], base, 1);
      },
      add);
    table.template flush<Backend>(block, sums);
  }
};

struct Set_sums {
  Shape* shape;
  Shared_moments* sum;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    shape[id].moments = Moments();
    if(is_any(sum[id]))
      shape[id].box = Box();
    Add_deltas{shape, sum}(id);
  }
};

// Sums moments and boxes of all shapes again from the labels. Only here do boxes shrink.
template <class Backend>
void count_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes)
{
  Backend& backend = points.backend;
  Shared_moments* const sums = start_deltas(backend, shapes, shapes.size);
  backend.template for_each_cell<Moment_table>(
    points.number_of_parts(), Sum_moments<Backend>{points.cloud.view(), points.parts(), points.label(), sums});
  points.ranks.sum(sums, shapes.size);
  for_each_shape(backend, shapes, Set_sums{shapes.change_moments(), sums});
  shapes.set_counted();
}

struct Refit_shape {
  Shape* shape;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    if(shape[id].is_live())
      fit_if_changed(shape[id]);
  }
};

// The fits of shapes, as ranks share them.
struct Dirty_shapes {
  Shape* shape;

  CGAL_TANDEM_HD bool has(std::size_t id) const { return shape[id].is_live() && !shape[id].history.is_fitted(); }
  CGAL_TANDEM_HD Fitted_moments& operator[](std::size_t id) const { return shape[id]; }
  CGAL_TANDEM_HD void set_made(std::size_t id) const { shape[id].history.set_fitted(true); }
};

// Fits the shapes whose points have changed.
template <class Backend>
void fit_shapes(const Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes)
{
  points.ranks.share_fits(shapes.size, Dirty_shapes{shapes.counted()});
  for_each_shape(points.backend, shapes, Refit_shape{shapes.counted()});
  shapes.set_fitted();
}

// An interior point is skipped, since all of its neighbors have had its label. Neighbors may have lost it since.
struct Clear_interior {
  std::uint8_t* state;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { state[i] &= std::uint8_t(~interior_bit); }
};

// The states of the points, with interior bits of this phase.
template <class Backend>
std::uint8_t* states_of(Labeled_cloud<Backend>& points, Phase phase)
{
  if(points.begin_phase(phase))
    points.backend.for_each(points.cloud.size(), Clear_interior{points.state()});
  return points.state();
}

// What a stage reads, as bits.
namespace tables {
constexpr unsigned lists = 1, moments = 2, fits = 4;
}

// Makes of these what is out of date. Fits are of moments.
template <class Backend>
void require(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, unsigned needed)
{
  if((needed & (tables::moments | tables::fits)) && !shapes.has_moments())
    count_shapes(points, shapes);
  if((needed & tables::fits) && !shapes.has_fits())
    fit_shapes(points, shapes);
  if((needed & tables::lists) && !points.has_lists())
    list_shapes(points);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_REQUIRE_H
