// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sequential model of Backend: one thread of the host, no synchronization. The one to read first, since its
// comments, and those of Host_operations, define each operation for all back ends.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_SEQUENTIAL_BACKEND_H
#define CGAL_TANDEM_INTERNAL_BACKEND_SEQUENTIAL_BACKEND_H

#include <CGAL/Tandem/internal/backend/Host_memory.h>
#include <CGAL/Tandem/internal/backend/Serial_block.h>

#include <boost/sort/pdqsort/pdqsort.hpp>

#include <algorithm>
#include <memory>

namespace CGAL::Tandem::internal {

// Atomic where only one thread runs.
struct Plain_atomics {
  // target += value, from functors that run at the same time; returns the old target. Integers only: sums of floats
  // would depend on the order.
  template <class T>
  static T atomic_add(T& target, T value)
  {
    const T old = target;
    target = T(target + value);
    return old;
  }

  // target = min(target, value); returns the old target. The final target does not depend on the order of the calls.
  template <class T>
  static T atomic_min(T& target, T value)
  {
    const T old = target;
    if(value < old)
      target = value;
    return old;
  }

  // target = max(target, value).
  template <class T>
  static void atomic_max(T& target, T value)
  {
    if(target < value)
      target = value;
  }

  // The target, which other functors may change at the same time.
  template <class T>
  static T atomic_load(const T& target)
  {
    return target;
  }

  // target = value, while others may load it or store the same.
  template <class T>
  static void atomic_store(T& target, T value)
  {
    target = value;
  }

  // If target == expected, target = value; returns the old target.
  template <class T>
  static T atomic_exchange_if(T& target, T expected, T value)
  {
    const T old = target;
    if(old == expected)
      target = value;
    return old;
  }
};

class Sequential_backend : public Host_operations<Sequential_backend>, public Plain_atomics {
public:
  static const char* name() { return "sequential"; }

  // About how many bodies run at the same time.
  std::size_t concurrency() const { return 1; }

  // f(i) for i in [0, n), in any order. About `grain` items are worth a thread.
  template <class F>
  void for_each(std::size_t n, F f, std::size_t = 4096)
  {
    for(std::size_t i = 0; i < n; ++i)
      f(i);
  }

  // The same on the host, where f uses what only the host has. Fewer items than `few` are not worth a second thread.
  template <class F>
  void for_each_on_host(std::size_t n, F f, std::size_t = 256)
  {
    for_each(n, f);
  }

  // f(first, last) for the pieces of [0, n) that begin at the multiples of `grain`.
  template <class F>
  void for_each_piece(std::size_t n, std::size_t grain, F f)
  {
    for(std::size_t first = 0; first < n; first += grain)
      f(first, (std::min)(first + grain, n));
  }

  // body(block, scratch, c) for c in [0, cells), in any order. A Scratch serves one body at a time and has no defined
  // contents at its start.
  template <class Scratch, class Body>
  void for_each_cell(std::size_t cells, Body body)
  {
    auto scratch = std::make_unique<Scratch>();
    Serial_block block;
    for(std::size_t c = 0; c < cells; ++c)
      body(block, *scratch, std::uint32_t(c));
  }

  // Ascending by key; the order of equal keys is not defined, so callers use unique keys or break ties themselves.
  // Where keys have less than 63 bits, their number saves a device time.
  void sort(Sort_table& table, int = 63) { sort_by_bits(table.begin(), table.end()); }

  // By one lane: see Host_operations.
  template <class Rounds>
  void run_rounds(std::size_t maximum_rounds, std::size_t, const Rounds& rounds)
  {
    Host_operations::run_rounds(maximum_rounds, 1, rounds);
  }

  // In each of the ranges, ascending. Together they are [0, size), the last but one argument; none has more items than
  // the last one.
  void sort_ranges(std::uint64_t* key, const Range* range, std::size_t ranges, std::size_t, std::size_t)
  {
    for(std::size_t c = 0; c < ranges; ++c)
      boost::sort::pdqsort_branchless(key + range[c].first, key + range[c].last);
  }
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BACKEND_SEQUENTIAL_BACKEND_H
