// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

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
// What works on the tables of the host beside a device.
using Host_side = Tbb_backend;

// Calls work(). The threads of the caller's task arena that are free wait for its loops meanwhile, and do nothing
// else: for a second detection at the same time there are those that come free later.
template <class F>
void with_host_team(F work)
{
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
    tbb::task_group group_;
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
