// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Block concept, and its model with a single lane: what the Sequential and
// the TBB back end run a body with.
//
// A body is a function template on a Block. Code outside of a block call is
// uniform: all lanes do the same. Only the functors are per item, and their
// items may run in any order and at the same time.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_SERIAL_BLOCK_H
#define CGAL_TANDEM_INTERNAL_BACKEND_SERIAL_BLOCK_H

#include <CGAL/Tandem/internal/types.h>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Serial_block {
  // f(i) for i in [0, n), then all lanes have seen all writes.
  template <class F>
  void for_each(std::uint32_t n, F f)
  {
    for(std::uint32_t i = 0; i < n; ++i)
      f(i);
  }

  // f(s, q) for each source s in [0, n) and each entry q of its row of k
  // neighbors; row(s) is the address of the row.
  template <class Row, class F>
  void for_each_neighbor(std::uint32_t n, int k, Row row, F f)
  {
    for(std::uint32_t s = 0; s < n; ++s) {
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

  // f() once.
  template <class F>
  void single(F f)
  {
    f();
  }

  // target = min(target, value); returns the old target.
  std::uint32_t fetch_min(std::uint32_t& target, std::uint32_t value)
  {
    const std::uint32_t old = target;
    if(value < old)
      target = value;
    return old;
  }

  // A position of its own for each caller. The order of positions is arbitrary.
  std::uint32_t append(std::uint32_t& size) { return size++; }

  // Sums that lanes of this block share. Integers only.
  template <class T, class U>
  void add(T& target, U value)
  {
    target += value;
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_SERIAL_BLOCK_H
