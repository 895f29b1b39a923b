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
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

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

  template <class Scratch, class Body>
  void for_each_cell(std::size_t cells, Body body)
  {
    constexpr std::size_t largest_on_stack = 65536;
    const auto run_cell = [&](std::size_t c) {
      Serial_block block;
      if constexpr(sizeof(Scratch) <= largest_on_stack) {
        Scratch scratch;
        body(block, scratch, std::uint32_t(c));
      } else {
        const std::unique_ptr<Scratch> scratch(new Scratch);
        body(block, *scratch, std::uint32_t(c));
      }
    };
    run(cells, Index_functor(run_cell));
  }

  // By a sample of the keys, entries are brought to parts of about the same size, which are sorted at the same time.
  void sort(Sort_table& table, int = 63)
  {
    constexpr std::size_t pieces = 64, part_size = 1024, sample_size = 32;
    const std::size_t n = table.size();
    std::size_t parts = 1;
    while(parts < pieces && 2 * parts * part_size <= n)
      parts *= 2;
    if(parts < 4 || concurrency() == 1)
      return sort_by_bits(table.begin(), table.end());
    std::vector<std::uint64_t> sample(sample_size * parts);
    for(std::size_t i = 0; i < sample.size(); ++i)
      sample[i] = table.begin()[i * n / sample.size()].key;
    std::sort(sample.begin(), sample.end());
    std::array<std::uint64_t, pieces> bound; // the last key of each part
    for(std::size_t p = 0; p < parts; ++p)
      bound[p] = sample[(p + 1) * sample_size - 1];
    Buffer<std::uint8_t> part(n);
    const auto set_part = [&](std::size_t i) {
      std::size_t p = 0; // no branches, which could not be predicted
      for(std::size_t step = parts / 2; step > 0; step /= 2)
        p += bound[p + step - 1] < table.begin()[i].key ? step : 0;
      part[i] = std::uint8_t(p);
    };
    std::vector<std::array<std::size_t, pieces>> place(pieces); // of the next entry, by piece and part
    const std::size_t grain = (n + pieces - 1) / pieces;
    for_each_piece(n, grain, [&](std::size_t first, std::size_t last) {
      for(std::size_t i = first; i < last; ++i) {
        set_part(i);
        ++place[first / grain][part[i]];
      }
    });
    std::vector<std::size_t> first_of = {0};
    for(std::size_t p = 0; p < parts; ++p) {
      std::size_t sum = first_of.back();
      for(auto& of_piece : place)
        sum += std::exchange(of_piece[p], sum);
      first_of.push_back(sum);
    }
    Sort_table sorted(n);
    for_each_piece(n, grain, [&](std::size_t first, std::size_t last) {
      for(std::size_t i = first; i < last; ++i)
        sorted.begin()[place[first / grain][part[i]]++] = table.begin()[i];
    });
    for_each_piece(parts, 1, [&](std::size_t p, std::size_t) {
      sort_by_bits(sorted.begin() + first_of[p], sorted.begin() + first_of[p + 1]);
    });
    table = std::move(sorted);
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
