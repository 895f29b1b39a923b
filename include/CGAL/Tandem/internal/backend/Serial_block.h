// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The model of Block with a single lane, for back ends of the host. Its comments define each operation for all blocks;
// order and races are then those that a body has to allow.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_SERIAL_BLOCK_H
#define CGAL_TANDEM_INTERNAL_BACKEND_SERIAL_BLOCK_H

#include <CGAL/Tandem/internal/base/Moments.h>

namespace CGAL::Tandem::internal {

struct Serial_block {
  // So many items are worth trying before it is known whether they are needed. Results do not depend on it.
  static constexpr std::uint32_t lookahead = 1;

  // f(i) for i in [0, n). Afterwards all lanes see all writes.
  template <class F>
  void for_each(std::uint32_t n, F f)
  {
    for(std::uint32_t i = 0; i < n; ++i)
      f(i);
  }

  // f(s, q) for each source s in [0, n) and each entry q of its row of k neighbors, which is at row(s).
  template <class Row, class F>
  void for_each_neighbor(std::uint32_t n, int k, Row row, F f)
  {
    // Rows are visited in an order that the processor cannot predict, so they are fetched some sources ahead.
    constexpr std::uint32_t ahead = 4;
    for(std::uint32_t s = 0; s < n; ++s) {
      if(s + ahead < n)
        __builtin_prefetch(row(s + ahead));
      const std::uint32_t* neighbors = row(s);
      for(int j = 0; j < k; ++j)
        f(s, neighbors[j]);
    }
  }

  // The smallest i in [first, n) with f(i), or n. f has no side effects.
  template <class F>
  std::uint32_t find_first(std::uint32_t first, std::uint32_t n, F f)
  {
    for(std::uint32_t i = first; i < n; ++i)
      if(f(i))
        return i;
    return n;
  }

  // take(rank, i) for the first i in [first, n) with f(i), at most so many of them, by rising i; returns how many. f
  // has no side effects, and does not depend on what take() writes.
  template <class F, class Take>
  std::uint32_t find(std::uint32_t first, std::uint32_t n, std::uint32_t maximum, F f, Take take)
  {
    std::uint32_t size = 0;
    for(std::uint32_t i = first; i < n && size < maximum; ++i)
      if(f(i))
        take(size++, i);
    return size;
  }

  // f() once.
  template <class F>
  void single(F f)
  {
    f();
  }

  // A value that other lanes may change at the same time.
  std::uint32_t load(const std::uint32_t& target) { return target; }

  // target = min(target, value); returns the old target.
  std::uint32_t fetch_min(std::uint32_t& target, std::uint32_t value)
  {
    const std::uint32_t old = target;
    if(value < old)
      target = value;
    return old;
  }

  // target += value.
  template <class T>
  void add(T& target, T value)
  {
    target += value;
  }

  // A position of its own for each caller, from `size`, which counts them. The order of positions is arbitrary, so it
  // must not reach a result.
  std::uint32_t append(std::uint32_t& size) { return size++; }

  // If target == expected, target = value; returns the old target.
  std::uint32_t exchange_if(std::uint32_t& target, std::uint32_t expected, std::uint32_t value)
  {
    const std::uint32_t old = target;
    if(old == expected)
      target = value;
    return old;
  }

  // Counts `value` in a slot that belongs to the first value that came; a slot of value ~0 belongs to none. False if
  // the slot belongs to another value. Which value is first depends on the lanes, so both cases must lead to the same
  // result.
  template <class T>
  bool count_pair(std::uint64_t& slot, T& count, std::uint64_t value)
  {
    if(slot == ~std::uint64_t(0))
      slot = value;
    if(slot != value)
      return false;
    ++count;
    return true;
  }

  // As for_each(), where f(i, sum) adds to a Sum of its lane; then add(sum) once for each lane. Lanes differ in number,
  // so only sums of integers and bounds are the same for all blocks.
  template <class Sum, class F, class Add>
  void accumulate(std::uint32_t n, F f, Add add)
  {
    Sum sum;
    for_each(n, [&](std::uint32_t i) { f(i, sum); });
    add(sum);
  }

  // Sums and bounds that the lanes of this block share.
  void add_moments(Cell_moments& target, const Cell_moments& m) { target += m; }

  void add_box(Box& target, const Box& b) { target.add(b); }
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BACKEND_SERIAL_BLOCK_H
