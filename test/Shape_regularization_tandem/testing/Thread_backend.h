// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A model of Backend on std::thread. ThreadSanitizer sees all of it, while the
// library of TBB is not instrumented, and it deals out small pieces, so that a body
// meets its neighbors more often. It also shows that Backend is a concept.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_THREAD_BACKEND_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_THREAD_BACKEND_H

#include <CGAL/Tandem/internal/backend/Host_memory.h>
#include <CGAL/Tandem/internal/backend/Serial_block.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

class Thread_backend : public Host_operations<Thread_backend> {
public:
  explicit Thread_backend(unsigned threads = 3) : threads_(threads) {}

  static const char* name() { return "threads"; }

  // More than there are cells, so that these are parted.
  std::size_t concurrency() const { return 60; }

  // Pieces are far smaller than they should be, so that threads meet.
  template <class F>
  void for_each(std::size_t n, F f, std::size_t grain = 4096)
  {
    for_each_piece(n, grain / 16 + 1, [&](std::size_t first, std::size_t last) {
      for(std::size_t i = first; i < last; ++i)
        f(i);
    });
  }

  template <class F>
  void for_each_on_host(std::size_t n, F f, std::size_t = 256)
  {
    for_each_piece(n, 2, [&](std::size_t first, std::size_t last) { // so that threads meet
      for(std::size_t i = first; i < last; ++i)
        f(i);
    });
  }

  template <class F>
  void for_each_piece(std::size_t n, std::size_t grain, F f)
  {
    run((n + grain - 1) / grain, [&](std::atomic<std::size_t>& next, std::size_t pieces) {
      for(std::size_t piece; (piece = next++) < pieces;)
        f(piece * grain, (std::min)((piece + 1) * grain, n));
    });
  }

  template <class Scratch, class Body>
  void for_each_cell(std::size_t cells, Body body)
  {
    run(cells, [&](std::atomic<std::size_t>& next, std::size_t end) {
      auto scratch = std::make_unique<Scratch>();
      Serial_block block;
      for(std::size_t c; (c = next++) < end;)
        body(block, *scratch, std::uint32_t(c));
    });
  }

  // Equal keys come in an order of their own, as they may.
  void sort(Sort_table& table, int = 63)
  {
    using Entry = Sort_table::Entry;
    std::reverse(table.begin(), table.end());
    std::sort(table.begin(), table.end(), [](const Entry& a, const Entry& b) { return a.key < b.key; });
  }

  void sort_ranges(std::uint64_t* key, const Range* range, std::size_t ranges, std::size_t, std::size_t)
  {
    for_each_piece(ranges, 1,
                   [&](std::size_t c, std::size_t) { std::sort(key + range[c].first, key + range[c].last); });
  }

  template <class T>
  static T atomic_add(T& target, T value)
  {
    return __atomic_fetch_add(&target, value, __ATOMIC_RELAXED);
  }

  template <class T>
  static T atomic_min(T& target, T value)
  {
    T old = atomic_load(target);
    while(value < old &&
          !__atomic_compare_exchange_n(&target, &old, value, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
    }
    return old;
  }

  template <class T>
  static void atomic_max(T& target, T value)
  {
    T old = atomic_load(target);
    while(old < value &&
          !__atomic_compare_exchange_n(&target, &old, value, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
    }
  }

  template <class T>
  static T atomic_load(const T& target)
  {
    return __atomic_load_n(&target, __ATOMIC_RELAXED);
  }

  template <class T>
  static T atomic_exchange_if(T& target, T expected, T value)
  {
    __atomic_compare_exchange_n(&target, &expected, value, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
    return expected;
  }

private:
  // work(next, end) on each thread, which takes the items below end from next.
  template <class Work>
  void run(std::size_t end, Work work)
  {
    std::atomic<std::size_t> next(0);
    std::vector<std::thread> others;
    for(unsigned t = 1; t < threads_ && t < end; ++t)
      others.emplace_back([&] { work(next, end); });
    work(next, end);
    for(std::thread& t : others)
      t.join();
  }

  unsigned threads_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_THREAD_BACKEND_H
