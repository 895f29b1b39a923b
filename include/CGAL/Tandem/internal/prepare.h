// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Before the first round: order, neighbors, normals, leaves, seeds, and the
// parameters in the units of the grid.

#ifndef CGAL_TANDEM_INTERNAL_PREPARE_H
#define CGAL_TANDEM_INTERNAL_PREPARE_H

#include <CGAL/Shape_regularization_tandem/Statistics.h>
#include <CGAL/Tandem/internal/Tandem_state.h>
#include <CGAL/Tandem/internal/angles.h>
#include <CGAL/Tandem/internal/cells.h>
#include <CGAL/Tandem/internal/estimate_normals.h>
#include <CGAL/Tandem/internal/import_cloud.h>
#include <CGAL/Tandem/internal/neighbors.h>

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
  o.maximum_distance = p.maximum_distance / step;
  o.squared_cosine = cosine * cosine;
  o.minimum_region_size = std::int64_t(p.minimum_region_size);
  o.minimum_regular_size = (std::min)(o.minimum_region_size, std::int64_t(10));
  o.minimum_fragment_size = (std::max)(std::int64_t(6), o.minimum_region_size * 3 / 20);
  o.growth.tolerance = make_tolerance(o.maximum_distance, cosine);
  o.tight = make_tolerance(o.maximum_distance / 4, cosine_deg(p.maximum_angle / 2));
  o.growth.seeds_in_flight = 8;
  o.growth.seed_tries = 64;
  o.growth.core_size = std::uint32_t(p.k_neighbors / 2 + 1);
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
  return o;
}

// The points that have a neighbor in another leaf, leaf by leaf.
template <class Backend>
void find_border(Tandem_state<Backend>& t)
{
  std::vector<std::vector<std::uint32_t>> found(t.cells.size());
  t.backend.for_each_piece(t.cells.size(), 1, [&](std::size_t c, std::size_t) {
    const Range cell = t.cells[c];
    for(std::uint32_t i = cell.first; i < cell.last; ++i) {
      const std::uint32_t* row = t.cloud.row(i);
      bool is_inside = true;
      for(int j = 0; j < t.cloud.k && row[j] != no_index; ++j)
        is_inside = is_inside && row[j] >= cell.first && row[j] < cell.last;
      if(!is_inside)
        found[c].push_back(i);
    }
  });
  t.cell_border.resize(t.cells.size());
  for(std::size_t c = 0; c < t.cells.size(); ++c) {
    t.cell_border[c].first = std::uint32_t(t.border.size());
    t.border.insert(t.border.end(), found[c].begin(), found[c].end());
    t.cell_border[c].last = std::uint32_t(t.border.size());
  }
  t.proposal.resize(t.border.size());
}

// The tables of the size of the cloud, when they are largest: in the estimation of
// normals, else in the end game. With the caller's coordinates and normals.
inline std::size_t bytes_per_point(int k, bool has_normals)
{
  const std::size_t caller = sizeof(Grid_point) + (has_normals ? 6 : 3) * sizeof(double);
  const std::size_t cloud = sizeof(Grid_point) + std::size_t(k + 1) * sizeof(std::uint32_t);
  const std::size_t labels = 2 * sizeof(std::uint32_t) + 1; // and seeds, states
  const std::size_t end_game = sizeof(std::uint64_t) + 5 * sizeof(std::uint32_t);
  constexpr std::size_t neighborhoods = 100; // of estimate_normals()
  return caller + cloud + (has_normals ? labels + end_game : neighborhoods);
}

template <class Backend>
void prepare(Tandem_state<Backend>& t, const Import& in, const Parameters& parameters,
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
  const Code_frame frame = make_code_frame(in.point.data(), n);
  auto sorted = sort_along_curve(t.backend, in.point.data(), n, frame,
                                 [&](std::uint32_t i, std::uint32_t j) { return in.precedes(i, j); });
  t.cells = split_leaves(sorted.data(), n, frame, parameters.cell_size);
  order.reset(n);
  points.reset(n);
  t.backend.for_each(n, [&](std::size_t i) {
    order[i] = sorted[i].index;
    points[i] = in.point[sorted[i].index];
  });
  sorted.release();
  sort.stop();

  Stage_timer search(times.neighbors);
  neighbors.reset(n * std::size_t(k));
  find_neighbors(t.backend, points.data(), std::uint32_t(n), k, neighbors.data());
  t.cloud = {points.data(), neighbors.data(), std::uint32_t(n), k};
  search.stop();

  if(!in.has_normals) {
    Stage_timer normals(times.normals);
    estimate_normals(t.backend, t.cloud, points.data(), t.options.maximum_distance);
  }

  Stage_timer growth(times.growth);
  find_border(t);
  t.seeds = order_seeds(t.backend, t.cloud, t.cells, t.options.growth.tolerance, t.options.tight);
  t.seed_cursor.assign(t.cells.size(), 0);
  t.label.reset(n);
  t.state.reset(n);
  t.backend.for_each(n, [&](std::size_t i) {
    t.label[i] = is_free;
    t.state[i] = 0;
  });
  t.peak_bytes = n * bytes_per_point(k, in.has_normals) + 8 * t.border.size();
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_PREPARE_H
