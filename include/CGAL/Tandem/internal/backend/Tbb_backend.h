// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parallel model of Backend: the same bodies as the sequential one, many at a time. It runs in the caller's task
// arena, so a tbb::global_control or an arena of the caller limits its threads. Operations are defined in
// Sequential_backend.h.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_TBB_BACKEND_H
#define CGAL_TANDEM_INTERNAL_BACKEND_TBB_BACKEND_H

#include <CGAL/Tandem/internal/backend/Host_memory.h>
#include <CGAL/Tandem/internal/backend/Serial_block.h>

#include <boost/sort/pdqsort/pdqsort.hpp>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <memory>

namespace CGAL::Tandem::internal {

// A reference to a functor of one index. The tasks of oneTBB are instantiated for this type only, since they take much
// longer to compile than a call takes to run.
class Index_functor {
public:
  template <class F>
  explicit Index_functor(const F& f)
    : functor_(&f), call_([](const void* f, std::size_t i) { (*static_cast<const F*>(f))(i); })
  {}

  void operator()(std::size_t i) const { call_(functor_, i); }

private:
  const void* functor_;
  void (*call_)(const void*, std::size_t);
};

class Tbb_backend : public Host_operations<Tbb_backend>, public Shared_atomics {
public:
  static const char* name() { return "parallel"; }

  std::size_t concurrency() const { return std::size_t(tbb::this_task_arena::max_concurrency()); }

  // Pieces are large enough that taking one costs little beside its items.
  template <class F>
  void for_each(std::size_t n, F f, std::size_t grain = 1024)
  {
    for_each_piece(n, grain, [&](std::size_t first, std::size_t last) {
      for(std::size_t i = first; i < last; ++i)
        f(i);
    });
  }

  // Items take longer here, since most are shapes, so pieces are smaller. Fewer than `few` items are one piece, hence
  // one thread.
  template <class F>
  void for_each_on_host(std::size_t n, F f, std::size_t few = 256)
  {
    const std::size_t grain = n < few ? few : (std::max)(n / 64, few / 16 + 1);
    for_each_piece(n, grain, [&](std::size_t first, std::size_t last) {
      for(std::size_t i = first; i < last; ++i)
        f(i);
    });
  }

  template <class F>
  void for_each_piece(std::size_t n, std::size_t grain, F f)
  {
    const auto run_piece = [&](std::size_t piece) { f(piece * grain, (std::min)((piece + 1) * grain, n)); };
    run((n + grain - 1) / grain, Index_functor(run_piece));
  }

  // A scratch for each thread: cells of one thread use it one after the other.
  template <class Scratch, class Body>
  void for_each_cell(std::size_t cells, Body body)
  {
    tbb::enumerable_thread_specific<std::shared_ptr<void>> scratches;
    const auto run_cell = [&](std::size_t c) {
      std::shared_ptr<void>& scratch = scratches.local();
      if(scratch == nullptr)
        scratch = std::make_shared<Scratch>();
      Serial_block block;
      body(block, *static_cast<Scratch*>(scratch.get()), std::uint32_t(c));
    };
    run(cells, Index_functor(run_cell));
  }

  void sort(Sort_table& table, int = 63)
  {
    using Entry = Sort_table::Entry;
    const auto sort_all = [&](std::size_t) { // in the context of this task
      tbb::parallel_sort(table.begin(), table.end(), [](const Entry& a, const Entry& b) { return a.key < b.key; });
    };
    isolated(1, Index_functor(sort_all));
  }

  void sort_ranges(std::uint64_t* key, const Range* range, std::size_t ranges, std::size_t, std::size_t)
  {
    const auto sort_range = [&](std::size_t c) {
      boost::sort::pdqsort_branchless(key + range[c].first, key + range[c].last);
    };
    run(ranges, Index_functor(sort_range));
  }

private:
  static void run(std::size_t n, const Index_functor& f)
  {
    if(n == 0)
      return;
    if(n == 1)
      f(0);
    else
      isolated(n, f);
  }

  // f(i) for i in [0, n). A thread that waits for the others must not take other work of the caller, which could call
  // this package again. Nor may a caller who cancels his tasks cancel these: their results are used in any case. All
  // threads round as the caller's thread does.
  static void isolated(std::size_t n, const Index_functor& f)
  {
    tbb::this_task_arena::isolate([&] {
      tbb::task_group_context context(tbb::task_group_context::isolated,
                                      tbb::task_group_context::default_traits | tbb::task_group_context::fp_settings);
      tbb::parallel_for(std::size_t(0), n, f, context);
    });
  }
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BACKEND_TBB_BACKEND_H
