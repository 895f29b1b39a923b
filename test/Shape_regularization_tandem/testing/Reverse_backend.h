// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small back end of its own, added as CONTRIBUTING.md describes it: one thread runs all loops backwards.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_REVERSE_BACKEND_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_REVERSE_BACKEND_H

#include <CGAL/Shape_regularization_tandem/internal/Execution_of.h>
#include <CGAL/Tandem/internal/backend/Host_memory.h>
#include <CGAL/Tandem/internal/backend/Serial_block.h>

#include <algorithm>
#include <memory>

namespace CGAL {
namespace Tandem {

struct Reverse_tag {};

namespace internal {

class Reverse_backend : public Host_operations<Reverse_backend> {
public:
  static const char* name() { return "reverse"; }
  std::size_t concurrency() const { return 1; }

  // What all of these have done: operations on items, the items, and loops over cells.
  inline static std::size_t loops = 0, items = 0, cell_loops = 0;

  template <class F>
  void for_each(std::size_t n, F f, std::size_t = 0)
  {
    count(n);
    while(n > 0)
      f(--n);
  }

  template <class F>
  void for_each_piece(std::size_t n, std::size_t grain, F f)
  {
    count(n);
    for(std::size_t p = (n + grain - 1) / grain; p > 0; --p)
      f((p - 1) * grain, (std::min)(p * grain, n));
  }

  template <class F>
  void for_each_on_host(std::size_t n, F f, std::size_t = 0)
  {
    for_each(n, f);
  }

  template <class Scratch, class Body>
  void for_each_cell(std::size_t cells, Body body)
  {
    cell_loops += cells > 0;
    const auto scratch = std::make_unique<Scratch>();
    for(std::size_t c = cells; c > 0; --c) {
      Serial_block block;
      body(block, *scratch, std::uint32_t(c - 1));
    }
  }

  void sort(Sort_table& table, int = 63)
  {
    count(table.size());
    using Entry = Sort_table::Entry;
    std::sort(table.begin(), table.end(), [](const Entry& a, const Entry& b) { return a.key < b.key; });
  }

  void sort_ranges(std::uint64_t* key, const Range* range, std::size_t ranges, std::size_t size, std::size_t)
  {
    count(size);
    for(std::size_t c = ranges; c > 0; --c)
      std::sort(key + range[c - 1].first, key + range[c - 1].last);
  }

  template <class T>
  static T atomic_add(T& target, T value)
  {
    const T old = target;
    target = T(old + value);
    return old;
  }

  template <class T>
  static T atomic_min(T& target, T value)
  {
    const T old = target;
    target = (std::min)(old, value);
    return old;
  }

  template <class T>
  static void atomic_max(T& target, T value)
  {
    target = (std::max)(target, value);
  }

  template <class T>
  static T atomic_load(const T& target)
  {
    return target;
  }

  template <class T>
  static T atomic_exchange_if(T& target, T expected, T value)
  {
    const T old = target;
    target = old == expected ? value : old;
    return old;
  }

private:
  static void count(std::size_t n)
  {
    loops += n > 0;
    items += n;
  }
};

template <>
struct Execution_of<Reverse_tag> : Execution_on<Reverse_backend> {};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_REVERSE_BACKEND_H
