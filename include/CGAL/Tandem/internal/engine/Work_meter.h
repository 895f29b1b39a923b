// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the back end does in a stage, for the statistics. No result depends on it.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_WORK_METER_H
#define CGAL_TANDEM_INTERNAL_ENGINE_WORK_METER_H

#include <CGAL/Tandem/Statistics.h>
#include <CGAL/Tandem/internal/backend/Work_counter.h>

#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {

// Adds what the back end does from its construction to its end to a stage. All of it is started by the thread of this.
template <class Backend>
class Work_meter {
public:
  // points: how many items a pass over the points has at least.
  Work_meter(Backend& backend, std::size_t points, Work& stage) : backend_(backend), stage_(stage) { start(points); }
  Work_meter(const Work_meter&) = delete;
  Work_meter& operator=(const Work_meter&) = delete;
  ~Work_meter() { add(); }

  // In the same stage, with another number of points.
  void go_on(std::size_t points)
  {
    add();
    start(points);
  }

private:
  void start(std::size_t points)
  {
    points_ = points;
    backend_.counter().set_points(points);
    before_ = backend_.work();
  }

  // A rank without points has no passes.
  double passes(std::uint64_t items) const { return points_ > 0 ? double(items) / double(points_) : 0; }

  void add()
  {
    const Work_counts now = backend_.work();
    stage_.passes_over_points += passes(now.items_of_points - before_.items_of_points);
    stage_.passes_over_lists += passes(now.items_of_lists - before_.items_of_lists);
    stage_.loops_over_shapes += std::size_t(now.loops_over_shapes - before_.loops_over_shapes);
    stage_.launches += std::size_t(now.launches - before_.launches);
    stage_.waits += std::size_t(now.waits - before_.waits);
    stage_.bytes_copied += std::size_t(now.bytes_copied - before_.bytes_copied);
  }

  Backend& backend_;
  Work& stage_;
  std::size_t points_ = 0;
  Work_counts before_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ENGINE_WORK_METER_H
