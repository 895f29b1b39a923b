// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small back end of its own, added by a tag from outside of the package: all loops run backwards, on std::threads.
// ThreadSanitizer sees all of it, while the library of TBB is not instrumented, and it deals out small pieces, so that
// a body meets its neighbors more often. It counts its loops.
//
// It is the example to read for whoever adds a back end:
// - Write a model of Backend. backend/archetypes.h of the tests lists its operations, and Sequential_backend.h is the
//   model to read first. A back end whose functors run on the host inherits Host_operations and adds for_each_piece().
// - Write a model of Block, or take Serial_block if bodies run with one lane.
// - Specialize Stage_overrides for stages that it executes in a way of its own, as cuda/stages/Cuda_stages.cuh. A back
//   end without host memory has to replace two of them.
// - Give it a tag and a specialization of Execution_of that inherits Execution_on, as below. A back end without host
//   memory names one of the host there, which reads the caller's range. A library of its own declares a function that
//   makes it, as cuda/interface/cuda_api.h, so that users need no other compiler.
// - Compare its hashes with those of Sequential_tag, as test_thread_backend.cpp, and add it to on_body_backends() in
//   testing/body_fixture.h.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_THREAD_BACKEND_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_THREAD_BACKEND_H

#include <CGAL/Shape_regularization_tandem/internal/Execution_of.h>
#include <CGAL/Tandem/internal/backend/Host_memory.h>
#include <CGAL/Tandem/internal/backend/Serial_block.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace CGAL::Tandem {

struct Thread_tag {};

namespace internal {

class Thread_backend : public Host_operations<Thread_backend>, public Shared_atomics {
public:
  explicit Thread_backend(unsigned threads = default_threads) : threads_(threads) {}

  inline static unsigned default_threads = 1;

  // What all of these have done: operations on items, the items, and loops over cells.
  inline static std::size_t loops = 0, items = 0, cell_loops = 0;

  static const char* name() { return "threads"; }

  // More than there are cells, so that these are parted.
  std::size_t concurrency() const { return threads_ == 1 ? 1 : 60; }

  // Pieces are far smaller than they should be, so that threads meet.
  template <class F>
  void for_each(std::size_t n, F f, std::size_t grain = 4096)
  {
    for_each_piece(n, grain / 16 + 1, [&](std::size_t first, std::size_t last) {
      while(last > first)
        f(--last);
    });
  }

  template <class F>
  void for_each_on_host(std::size_t n, F f, std::size_t = 256)
  {
    for_each(n, f, 16);
  }

  template <class F>
  void for_each_piece(std::size_t n, std::size_t grain, F f)
  {
    count(n);
    run((n + grain - 1) / grain,
        [&](std::size_t piece, unsigned) { f(piece * grain, (std::min)((piece + 1) * grain, n)); });
  }

  template <class Scratch, class Body>
  void for_each_cell(std::size_t cells, Body body)
  {
    cell_loops += cells > 0;
    std::vector<std::unique_ptr<Scratch>> scratch(threads_);
    run(cells, [&](std::size_t c, unsigned thread) {
      if(scratch[thread] == nullptr)
        scratch[thread] = std::make_unique<Scratch>();
      Serial_block block;
      body(block, *scratch[thread], std::uint32_t(c));
    });
  }

  // Equal keys come in an order of their own, as they may.
  void sort(Sort_table& table, int = 63)
  {
    count(table.size());
    using Entry = Sort_table::Entry;
    std::reverse(table.begin(), table.end());
    std::sort(table.begin(), table.end(), [](const Entry& a, const Entry& b) { return a.key < b.key; });
  }

  void sort_ranges(std::uint64_t* key, const Range* range, std::size_t ranges, std::size_t size, std::size_t)
  {
    count(size);
    run(ranges, [&](std::size_t c, unsigned) { std::sort(key + range[c].first, key + range[c].last); });
  }

private:
  // f(i, thread) for all below n, the last ones first.
  template <class F>
  void run(std::size_t n, F f)
  {
    std::atomic<std::size_t> taken(0);
    const auto work = [&](unsigned thread) {
      for(std::size_t i; (i = taken++) < n;)
        f(n - 1 - i, thread);
    };
    std::vector<std::thread> others;
    for(unsigned t = 1; t < threads_ && t < n; ++t)
      others.emplace_back(work, t);
    work(0);
    for(std::thread& t : others)
      t.join();
  }

  static void count(std::size_t n)
  {
    loops += n > 0;
    items += n;
  }

  unsigned threads_;
};

template <>
struct Execution_of<Thread_tag> : Execution_on<Thread_backend> {};

} // namespace internal
} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_THREAD_BACKEND_H
