// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Before the first round: order, neighbors, normals, cells, seeds, and the
// parameters in the units of the grid.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_PREPARE_H
#define CGAL_TANDEM_INTERNAL_ENGINE_PREPARE_H

#include <CGAL/Shape_regularization_tandem/Statistics.h>
#include <CGAL/Tandem/internal/shapes/Tandem_state.h>
#include <CGAL/Tandem/internal/base/angles.h>
#include <CGAL/Tandem/internal/cloud/cells.h>
#include <CGAL/Tandem/internal/shapes/cell_shapes.h>
#include <CGAL/Tandem/internal/neighbors/estimate_normals.h>
#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/neighbors/find_neighbors.h>

#include <chrono>

namespace CGAL {
namespace Tandem {
namespace internal {

// Adds the seconds it lives to a stage.
class Stage_timer {
public:
  explicit Stage_timer(double& stage) : stage_(stage) {}
  Stage_timer(const Stage_timer&) = delete;
  Stage_timer& operator=(const Stage_timer&) = delete;
  ~Stage_timer() { stop(); }

  void stop()
  {
    if(is_running_)
      stage_ += std::chrono::duration<double>(Clock::now() - start_).count();
    is_running_ = false;
  }

private:
  using Clock = std::chrono::steady_clock;
  double& stage_;
  Clock::time_point start_ = Clock::now();
  bool is_running_ = true;
};

inline Tolerance make_tolerance(double distance, double cosine)
{
  return {std::int64_t(llrint(distance * normal_scale)), std::int64_t(llrint(cosine * cosine * 4294967296.0))};
}

// The largest error of an integer distance, in steps: rounding a point to the grid
// costs up to .87, rounding a plane's normal to 2^-28 up to 1.3 at the border of
// the grid, the offset of the plane in the caller's coordinates the rest.
inline double distance_margin(const Grid& grid)
{
  const double size = std::fabs(grid.origin.x) + std::fabs(grid.origin.y) + std::fabs(grid.origin.z);
  return std::fma(size / grid.step, 1e-14, 4.0);
}

// Packed normals are within .004 degrees.
constexpr double packing_margin_deg = 0.006;

inline Options make_options(const Import& in, const Parameters& p)
{
  Options o;
  const double step = in.grid.step;
  const double cosine = cosine_deg(p.maximum_angle);
  o.cell_size = p.cell_size;
  o.maximum_distance = p.maximum_distance / step;
  o.squared_cosine = cosine * cosine;
  o.minimum_region_size = std::int64_t(p.minimum_region_size);
  o.minimum_regular_size = (std::min)(o.minimum_region_size, std::int64_t(10));
  // While shapes are young, most of them tilt by more than what they would be related to.
  o.minimum_related_size = (std::max)(o.minimum_regular_size, o.minimum_region_size * 7 / 20);
  o.minimum_fragment_size = (std::max)(std::int64_t(6), o.minimum_region_size * 3 / 20);
  o.growth.tolerance = make_tolerance(o.maximum_distance, cosine);
  o.tight = make_tolerance(o.maximum_distance / 4, cosine_deg(p.maximum_angle / 2));
  o.growth.seeds_in_flight = young_seeds_in_flight;
  o.growth.seed_tries = 64;
  o.growth.core_size =
    std::uint32_t((std::min)(p.k_neighbors / 2 + 1, p.cell_size / 8)); // at most an eighth of a full cell
  o.regularity = {p.angle_tolerance,
                  p.maximum_offset / step,
                  o.maximum_distance,
                  p.regularize_parallelism,
                  p.regularize_orthogonality,
                  p.regularize_coplanarity,
                  false};
  const double certain_angle = (std::max)(p.maximum_angle - packing_margin_deg, 0.);
  o.certain = make_tolerance(o.maximum_distance - distance_margin(in.grid), cosine_deg(certain_angle));
  o.exact = {p.maximum_distance, std::fma(1.0, cosine, rounded_normal_margin)};
  o.regularity_period = int((std::min)(p.regularity_period, std::size_t(1) << 30));
  return o;
}

struct No_scratch {};

// Whether the points of a cell have a neighbor in another one.
struct Mark_border {
  Cloud_view cloud;
  const Range* cells;
  std::uint8_t* is_border;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, No_scratch&, std::uint32_t c) const
  {
    const Range cell = cells[c];
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t* row = cloud.row(cell.first + at);
      bool has_other = false;
      for(int j = 0; j < cloud.k && row[j] != no_index; ++j)
        has_other |= row[j] < cell.first || row[j] >= cell.last;
      is_border[cell.first + at] = has_other;
    });
  }
};

struct Is_marked {
  const std::uint8_t* mark;

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const { return mark[i] != 0; }
};

// The entries of `border` that lie in each cell.
struct Find_cell_borders {
  const Range* cells;
  const std::uint32_t* border;
  std::uint32_t size;
  Range* cell_border;

  CGAL_TANDEM_HD void operator()(std::size_t c) const
  {
    cell_border[c] = {first_from(cells[c].first), first_from(cells[c].last)};
  }

private:
  CGAL_TANDEM_HD std::uint32_t first_from(std::uint32_t point) const
  {
    return partition_point(0, size, [&](std::uint32_t b) { return border[b] < point; });
  }
};

// The points that have a neighbor in another cell, cell by cell.
template <class Backend>
void find_border(Tandem_state<Backend>& t)
{
  const std::uint32_t cells = std::uint32_t(t.number_of_cells);
  typename Backend::template Buffer<std::uint8_t> mark(t.cloud.size);
  t.backend.template for_each_cell<No_scratch>(cells, Mark_border{t.cloud, t.cells.data(), mark.data()});
  t.border = t.backend.compact(t.cloud.size, Is_marked{mark.data()});
  t.cell_border.reset(cells);
  t.backend.for_each(
    cells, Find_cell_borders{t.cells.data(), t.border.data(), std::uint32_t(t.border.size()), t.cell_border.data()});
  t.proposal.reset(t.border.size());
}

// The points on the grid, for the functors; a back end may have an overload of its own.
template <class Backend>
typename Backend::template Buffer<Grid_point> import_points(Backend& backend, Import& in)
{
  typename Backend::template Buffer<Grid_point> point(in.size());
  backend.for_each(in.size(), place_on_grid(in, point.data()));
  return point;
}

// Tells the back end the cells that most loops will be over; it may have an overload of its own.
template <class Backend>
void expect_cells(Backend&, const std::vector<Range>&)
{}

template <class Table>
struct Gather_sorted {
  Table sorted;
  const Grid_point* source;
  std::uint32_t* order;
  Grid_point* point;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    order[i] = sorted.index(i);
    point[i] = source[order[i]];
  }
};

struct Free_all {
  Labels_view labels;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    labels.label[i] = free_label;
    labels.state[i] = 0;
  }
};

// The tables of the size of the cloud, when they are largest: in the estimation of
// normals, else in the end game. With the caller's coordinates and normals.
inline std::size_t bytes_per_point(int k, const Import& in)
{
  const std::size_t cloud = sizeof(Grid_point) + std::size_t(k + 1) * sizeof(std::uint32_t);
  const std::size_t labels = 2 * sizeof(std::uint32_t) + 1; // and seeds, states
  const std::size_t end_game = sizeof(std::uint64_t) + 5 * sizeof(std::uint32_t);
  constexpr std::size_t neighborhoods = 100; // of estimate_normals()
  return in.value_bytes() + cloud + (in.has_normals ? labels + end_game : neighborhoods);
}

template <class Backend>
void sort_points(Tandem_state<Backend>& t, Import& in, std::size_t cell_size,
                 typename Backend::template Buffer<std::uint32_t>& order,
                 typename Backend::template Buffer<Grid_point>& points)
{
  const std::size_t n = in.size();
  const auto imported = import_points(t.backend, in);
  const Code_frame frame = make_code_frame(in.low, in.high);
  const auto sorted = sort_along_curve(
    t.backend, imported.data(), n, frame, [&](std::uint32_t i, std::uint32_t j) { return in.precedes(i, j); },
    [&] { in.drop_upload(); });
  const std::vector<Range> cells = split_cells(t.backend, sorted, frame, cell_size);
  t.number_of_cells = cells.size();
  t.cells.reset(cells.size());
  t.backend.from_host(cells.data(), cells.size(), t.cells.data());
  expect_cells(t.backend, cells);
  order.reset(n);
  points.reset(n);
  using Table = typename Backend::Sort_table::View;
  t.backend.for_each(n, Gather_sorted<Table>{sorted.view(), imported.data(), order.data(), points.data()});
}

template <class Backend>
void prepare(Tandem_state<Backend>& t, Import& in, const Parameters& parameters,
             typename Backend::template Buffer<std::uint32_t>& order,
             typename Backend::template Buffer<Grid_point>& points,
             typename Backend::template Buffer<std::uint32_t>& neighbors, Stage_times& times)
{
  const std::size_t n = in.size();
  const int k = int(parameters.k_neighbors);
  t.options = make_options(in, parameters);
  t.cloud = {nullptr, nullptr, std::uint32_t(n), k};
  if(n == 0)
    return;
  Stage_timer sort(times.sort);
  sort_points(t, in, parameters.cell_size, order, points);
  t.backend.wait();
  sort.stop();

  Stage_timer search(times.neighbors);
  neighbors.reset(n * std::size_t(k));
  find_neighbors(t.backend, points.data(), std::uint32_t(n), k, neighbors.data());
  in.drop_upload(); // the values come back while a device searches
  t.cloud = {points.data(), neighbors.data(), std::uint32_t(n), k};
  t.backend.wait();
  search.stop();

  if(!in.has_normals) {
    Stage_timer normals(times.normals);
    estimate_normals(t.backend, t.cloud, points.data(), t.options.maximum_distance);
    t.backend.wait();
  }

  Stage_timer growth(times.growth);
  find_border(t);
  t.seeds = order_seeds(t.backend, t.cloud, t.cells.data(), t.number_of_cells,
                        {t.options.growth.tolerance, t.options.tight, t.options.cell_size});
  t.seed_cursor.assign(t.number_of_cells, 0);
  t.cell_shapes.reset(t.number_of_cells);
  t.backend.for_each(t.number_of_cells, Clear_lists{t.cell_shapes.data()});
  t.label.reset(n);
  t.state.reset(n);
  t.backend.for_each(n, Free_all{t.labels()});
  t.peak_bytes = n * bytes_per_point(k, in) + 8 * t.border.size();
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ENGINE_PREPARE_H
