// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The back end that works on memory of the host beside a device. It has loops over tables of shapes, and copies of
// large tables. With oneTBB it has a team of threads that stay awake during a round.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_HOST_SIDE_H
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_HOST_SIDE_H

#ifdef CGAL_LINKED_WITH_TBB
#include <CGAL/Tandem/internal/backend/Tbb_backend.h>

#include <tbb/task_group.h>
#else
#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#endif

namespace CGAL {
namespace Tandem {
namespace internal {

#ifdef CGAL_LINKED_WITH_TBB
using Host_side = Tbb_backend;

// Calls work(). Meanwhile the free threads of the caller's task arena wait for its loops, and take no other tasks. For
// a second detection at the same time, the threads that become free later remain. Isolated, so that this thread takes
// no task of the caller when it waits for the members, and a caller who cancels his tasks keeps the members.
template <class F>
void with_host_team(F work)
{
  // Dissolves the team at the end, also if work() throws, and waits until all threads have left it.
  class Members {
  public:
    explicit Members(Host_team& team) : team_(team) {}

    ~Members()
    {
      team_.dissolve();
      group_.wait();
    }

    void call()
    {
      for(int i = 1; i < tbb::this_task_arena::max_concurrency(); ++i)
        group_.run([this] { team_.help(); });
    }

  private:
    Host_team& team_;
    tbb::task_group_context context_{tbb::task_group_context::isolated,
                                     tbb::task_group_context::concurrent_wait | tbb::task_group_context::fp_settings};
    tbb::task_group group_{context_};
  };
  tbb::this_task_arena::isolate([&] {
    Host_team team{std::size_t(tbb::this_task_arena::max_concurrency())};
    Members members(team);
    members.call();
    const Host_team::Leadership leadership(&team);
    work();
  });
}
#else
// Without oneTBB there is one thread, and no team.
using Host_side = Sequential_backend;

template <class F>
void with_host_team(F work)
{
  work();
}
#endif

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_HOST_SIDE_H
