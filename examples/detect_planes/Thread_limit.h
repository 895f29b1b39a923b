// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_THREAD_LIMIT_H
#define DETECT_PLANES_THREAD_LIMIT_H

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#endif

#include <algorithm>
#include <cstddef>
#include <optional>

namespace program {

// While it lives, oneTBB has at most so many threads; 0: one for each processor.
class Thread_limit {
public:
#ifdef CGAL_LINKED_WITH_TBB
  explicit Thread_limit(int most) : number(tbb::this_task_arena::max_concurrency())
  {
    if(most <= 0)
      return;
    control.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(most));
    number = (std::min)(number, most);
  }

  int threads() const { return number; }

private:
  std::optional<tbb::global_control> control;
  int number;
#else
  explicit Thread_limit(int) {}
  int threads() const { return 1; }
#endif
};

} // namespace program

#endif // DETECT_PLANES_THREAD_LIMIT_H
