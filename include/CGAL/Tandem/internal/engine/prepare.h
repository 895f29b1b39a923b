// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Before the first round: order, cells, neighbors, normals, and seeds. Fills the whole state. See the manual, "Grid and
// Units" and "Normals".

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_PREPARE_H
#define CGAL_TANDEM_INTERNAL_ENGINE_PREPARE_H

#include <CGAL/Tandem/Statistics.h>
#include <CGAL/Tandem/internal/base/Progress.h>
#include <CGAL/Tandem/internal/engine/connect_cloud.h>
#include <CGAL/Tandem/internal/engine/make_stage_parameters.h>
#include <CGAL/Tandem/internal/engine/memory_use.h>
#include <CGAL/Tandem/internal/growth/grow_shapes.h>
#include <CGAL/Tandem/internal/neighbors/estimate_normals.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>
#include <CGAL/Tandem/internal/shapes/Stage_parameters.h>
#include <CGAL/Tandem/internal/shapes/Seeds.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>
#include <CGAL/Tandem/internal/shapes/update_tables.h>

#include <chrono>

namespace CGAL::Tandem::internal {

// --- What the rounds change. Only prepare() takes all of it; the other stages take the parts that they read and write, so
// that their signatures show what they may change.

// These parameters are constant after prepare(), but for the seeds in flight. Between rounds, labels are ids of live shapes, or
// the surfel is free. Moments are those of the points with that label.
template <class Backend>
struct Tandem_state {
  explicit Tandem_state(Backend& backend) : points(backend) {}

  Stage_parameters options;
  Labeled_cloud<Backend> points;
  Seeds<Backend> seeds;
  Shape_table<Backend> shapes;
  int round = 0;              // rounds that are complete
  std::size_t peak_bytes = 0; // of the tables of the size of the cloud
};

// --- Times of the stages, for the statistics. No result depends on them.

// Adds the seconds from its construction to stop() or its end to a stage. The caller waits for a device before, or its
// work counts for the next stage.
class Stage_timer {
public:
  explicit Stage_timer(double& stage) : stage_(stage) {}
  Stage_timer(const Stage_timer&) = delete;
  Stage_timer& operator=(const Stage_timer&) = delete;
  ~Stage_timer() { stop(); }

  // Adds the seconds so far to the stage. A second call has no effect.
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

// Makes surfels free, and clears their states.
struct Free_all {
  Labels_view labels;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    labels.label[i] = free_label;
    labels.state[i] = 0;
  }
};

// Starts without shapes: afterwards no surfel has one, and the lists of the cells are empty.
template <class Backend>
void clear_labels(Labeled_cloud<Backend>& points)
{
  points.start_labels();
  points.backend.for_each(points.cloud.size_with_ghosts(), Free_all{points.change_labels(false)});
  points.backend.for_each(points.number_of_cells(), Clear_lists{points.make_lists()});
}

// Prepares all tables of a detection. The order is given by what each stage needs: neighbors the sorted points, normals
// the neighbors, seeds the normals. The first three end with wait(), so that times are separate. An empty cloud has
// options only. Returns whether there is anything to grow from: not in an empty cloud, nor if the callback has
// cancelled before the seeds.
template <class Backend>
bool prepare(Tandem_state<Backend>& t, Import& in, const Parameters& parameters, Stage_times& times, Progress& progress)
{
  Labeled_cloud<Backend>& points = t.points;
  Backend& backend = points.backend;
  t.options = make_stage_parameters(in, parameters);
  points.cloud.k = int(parameters.k_neighbors);
  if(points.ranks.total(in.size()) == 0)
    return false;
  Stage_timer sort(times.sort);
  sort_points(backend, in, parameters.cell_size, points.cloud, points.cells);
  backend.wait();
  sort.stop();
  if(!progress.show(Detection_stage::neighbors, 0))
    return false;

  Stage_timer search(times.neighbors);
  connect_cloud(points, in, t.options.maximum_distance_steps);
  backend.wait();
  search.stop();

  if(!in.has_normals) {
    if(!progress.show(Detection_stage::normals, 0))
      return false;
    Stage_timer normals(times.normals);
    estimate_normals(backend, points.cloud.view(), points.cloud.point.data(), t.options.maximum_distance_steps,
                     points.ranks);
    backend.wait();
  }

  if(!progress.show(Detection_stage::seeds, 0))
    return false;
  Stage_timer growth(times.growth);
  find_border(points);
  t.seeds = order_seeds(points, t.options.growth.tolerance, parameters.cell_size);
  clear_labels(points);
  t.peak_bytes = host_bytes(points.cloud, in) + sizeof(std::uint32_t) * points.border.surfel.size();
  progress.show_rounds(0);
  return true;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ENGINE_PREPARE_H
