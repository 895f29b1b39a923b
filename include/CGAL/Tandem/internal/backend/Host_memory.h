// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The memory of back ends whose functors run on the host. Also the operations that such back ends share.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_HOST_MEMORY_H
#define CGAL_TANDEM_INTERNAL_BACKEND_HOST_MEMORY_H

#include <CGAL/Tandem/internal/memory/Host_buffer.h>

#include <boost/sort/spreadsort/integer_sort.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <numeric>
#include <vector>

namespace CGAL::Tandem::internal {

class Host_memory {
public:
  template <class T>
  using Buffer = Host_buffer<T>;
  using Sort_table = Host_sort_table;

  // Waits for all work that was started. Here nothing is pending.
  void wait() {}

  // n items from a buffer to the host.
  template <class T>
  void to_host(const T* source, std::size_t n, T* target)
  {
    if(n > 0)
      std::memcpy(target, source, n * sizeof(T));
  }
};

// Atomic where several threads of the host run; Plain_atomics says what each operation does. Relaxed order suffices:
// functors of a loop do not synchronize, and the end of the loop does.
struct Shared_atomics {
  template <class T>
  static T atomic_add(T& target, T value)
  {
    return __atomic_fetch_add(&target, value, __ATOMIC_RELAXED);
  }

  template <class T>
  static T atomic_min(T& target, T value)
  {
    T old = __atomic_load_n(&target, __ATOMIC_RELAXED);
    while(value < old && !__atomic_compare_exchange_n(&target, &old, value, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
    }
    return old;
  }

  template <class T>
  static void atomic_max(T& target, T value)
  {
    T old = __atomic_load_n(&target, __ATOMIC_RELAXED);
    while(old < value && !__atomic_compare_exchange_n(&target, &old, value, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
    }
  }

  template <class T>
  static T atomic_load(const T& target)
  {
    return __atomic_load_n(&target, __ATOMIC_RELAXED);
  }

  template <class T>
  static void atomic_store(T& target, T value)
  {
    __atomic_store_n(&target, value, __ATOMIC_RELAXED);
  }

  template <class T>
  static T atomic_exchange_if(T& target, T expected, T value)
  {
    __atomic_compare_exchange_n(&target, &expected, value, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
    return expected;
  }
};

// The operations that are made of others in the same way on every back end of the host, which has in addition
//   for_each_piece(n, grain, f)       f(first, last) for the pieces of [0, n) that begin at the multiples of grain
template <class Backend>
class Host_operations : public Host_memory {
public:
  static constexpr std::size_t unknown_size = ~std::size_t(0); // of a compaction

  // A buffer of f(i) for i in [0, n), where f is evaluated on the host, once for each.
  template <class T, class F>
  auto make_buffer(std::size_t n, F f)
  {
    typename Backend::template Buffer<T> items(n);
    self().for_each_on_host(n, [&](std::size_t i) { items[i] = f(i); });
    return items;
  }

  // The i in [0, n) with is_kept(i), ascending. is_kept may be evaluated twice for an item. A caller who knows exactly how
  // many are kept says so, as a device does not wait then. Each piece is kept at its beginning, then moved to its place.
  template <class F>
  auto compact(std::size_t n, F is_kept, [[maybe_unused]] std::size_t size = unknown_size)
  {
    constexpr std::size_t grain = 2048;
    std::vector<std::size_t> place((n + grain - 1) / grain + 1, 0);
    Buffer<std::uint32_t> kept(n);
    self().for_each_piece(n, grain, [&](std::size_t first, std::size_t last) {
      std::size_t to = first;
      for(std::size_t i = first; i < last; ++i) {
        kept[to] = std::uint32_t(i); // overwritten unless it is kept
        to += is_kept(std::uint32_t(i));
      }
      place[first / grain + 1] = to - first;
    });
    std::partial_sum(place.begin(), place.end(), place.begin());
    assert(size == unknown_size || size == place.back());
    typename Backend::template Buffer<std::uint32_t> result(place.back());
    self().for_each_piece(n, grain, [&](std::size_t first, std::size_t) {
      const std::size_t to = place[first / grain];
      std::copy_n(kept.begin() + first, place[first / grain + 1] - to, result.begin() + to);
    });
    return result;
  }

  // f.take(i) of the i in [0, n) with f.has(i), ascending. All has() come before any take(), which may change what
  // has() reads. About `grain` items are worth a thread.
  template <class T, class F>
  auto collect(std::size_t n, F f, std::size_t grain = 1024)
  {
    const auto found = compact(n, [&](std::uint32_t i) { return f.has(i); });
    typename Backend::template Buffer<T> items(found.size());
    self().for_each_piece(found.size(), grain, [&](std::size_t first, std::size_t last) {
      for(std::size_t k = first; k < last; ++k)
        items[k] = f.take(found[k]);
    });
    return items;
  }

  // The same for the host.
  template <class T, class F>
  std::vector<T> collect_on_host(std::size_t n, F f, std::size_t grain = 1024)
  {
    const auto items = collect<T>(n, f, grain);
    return std::vector<T>(items.begin(), items.end());
  }

  // N sums, for the host, of what f(i, sums) adds for i in [0, n). Each piece has sums of its own.
  template <int N, class F>
  std::array<std::int64_t, N> sum(std::size_t n, F f)
  {
    constexpr std::size_t grain = 1024;
    std::vector<std::array<std::int64_t, N>> of_piece((n + grain - 1) / grain);
    self().for_each_piece(n, grain, [&](std::size_t first, std::size_t last) {
      std::array<std::int64_t, N> sums = {};
      for(std::size_t i = first; i < last; ++i)
        f(i, sums.data());
      of_piece[first / grain] = sums;
    });
    std::array<std::int64_t, N> total = {};
    for(const auto& sums : of_piece)
      for(std::size_t k = 0; k < sums.size(); ++k)
        total[k] += sums[k];
    return total;
  }

  // Rounds of steps. rounds.run(step, round, lane, lanes) for all lanes, before any does the next step; a step shares
  // its items among the lanes. Their number is about that of the items, or any smaller one. Before the last step of a
  // round the loop ends, if rounds.is_last(round), and it ends after so many rounds. rounds.few(step): fewer items of
  // a step are not worth a second thread, so one thread has all lanes then.
  template <class Rounds>
  void run_rounds(std::size_t maximum_rounds, std::size_t items, const Rounds& rounds)
  {
    constexpr std::size_t maximum_lanes = 4096; // more cost more than they balance
    const std::size_t lanes = (std::max)((std::min)(items, maximum_lanes), std::size_t(1));
    for(std::size_t round = 0; round < maximum_rounds; ++round)
      for(int step = 0; step < Rounds::steps; ++step) {
        if(step + 1 == Rounds::steps && rounds.is_last(round))
          return;
        const std::size_t grain = items < Rounds::few(step) ? lanes : (lanes + 63) / 64;
        self().for_each_piece(lanes, grain, [&](std::size_t first, std::size_t last) {
          for(std::size_t lane = first; lane < last; ++lane)
            rounds.run(step, round, lane, lanes);
        });
      }
  }

protected:
  // By key, ascending, by one thread.
  static void sort_by_bits(Sort_table::Entry* first, Sort_table::Entry* last)
  {
    using Entry = Sort_table::Entry;
    boost::sort::spreadsort::integer_sort(
      first, last, [](const Entry& e, unsigned shift) { return e.key >> shift; },
      [](const Entry& a, const Entry& b) { return a.key < b.key; });
  }

private:
  Backend& self() { return static_cast<Backend&>(*this); }
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BACKEND_HOST_MEMORY_H
