// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Times of the stages, for the statistics. No result depends on them.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_STAGE_TIMER_H
#define CGAL_TANDEM_INTERNAL_ENGINE_STAGE_TIMER_H

#include <chrono>

namespace CGAL {
namespace Tandem {
namespace internal {

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

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ENGINE_STAGE_TIMER_H
