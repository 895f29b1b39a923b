// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The smallest models of Backend, Block and Ranks, with every operation of concepts.h and nothing else. A test compiles the
// engine with them, so no stage uses more than the concepts promise. They compute nothing: `if(false)` compiles what is
// passed to them, and does not run it.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_ARCHETYPES_H
#define CGAL_TANDEM_INTERNAL_BACKEND_ARCHETYPES_H

#include <CGAL/Tandem/internal/backend/Stage_overrides.h>
#include <CGAL/Tandem/internal/backend/concepts.h>

namespace CGAL {
namespace Tandem {
namespace internal {

namespace archetypes {

// Arguments and results have exactly the types that the concept lists; there is no default constructor and no copy.
struct Block {
  static constexpr std::uint32_t lookahead = 1;

  Block() = delete; // only the back end makes blocks
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  template <class F>
  void for_each(std::uint32_t, F f)
  {
    if(false)
      f(0u);
  }
  template <class Row, class F>
  void for_each_neighbor(std::uint32_t, int, Row row, F f)
  {
    if(false)
      f(0u, *row(0u));
  }
  template <class F>
  std::uint32_t find_first(std::uint32_t, std::uint32_t, F f)
  {
    return std::uint32_t(false && f(0u));
  }
  template <class F, class Take>
  std::uint32_t find(std::uint32_t, std::uint32_t, std::uint32_t, F f, Take take)
  {
    if(false && f(0u))
      take(0u, 0u);
    return 0;
  }
  template <class F>
  std::uint32_t min(std::uint32_t, F f)
  {
    return false ? f(0u) : 0;
  }
  template <class F>
  void single(F f)
  {
    if(false)
      f();
  }
  template <class Sum, class F, class Add>
  void accumulate(std::uint32_t, F f, Add add)
  {
    Sum sum;
    if(false)
      f(0u, sum);
    if(false)
      add(sum);
  }
  std::uint32_t load(const std::uint32_t&) { return 0; }
  std::uint32_t fetch_min(std::uint32_t&, std::uint32_t) { return 0; }
  void add(std::uint32_t&, std::uint32_t) {}
  std::uint32_t append(std::uint32_t&) { return 0; }
  std::uint32_t exchange_if(std::uint32_t&, std::uint32_t, std::uint32_t) { return 0; }
  bool count_pair(std::uint64_t&, std::uint32_t&, std::uint64_t) { return false; }
  void add_moments(Cell_moments&, const Cell_moments&) {}
  void add_box(Box&, const Box&) {}
};

// Can be moved, not copied, like memory of a device.
template <class T>
struct Buffer {
  Buffer() = default;
  explicit Buffer(std::size_t) {}
  Buffer(Buffer&&) = default;
  Buffer& operator=(Buffer&&) = default;

  void reset(std::size_t) {}
  void release() {}
  T* data() { return nullptr; }
  const T* data() const { return nullptr; }
  std::size_t size() const { return 0; }
};

struct Sort_table {
  struct View {
    std::uint64_t key(std::size_t) const { return 0; }
    std::uint32_t index(std::size_t) const { return 0; }
    void set(std::size_t, std::uint64_t, std::uint32_t) const {}
  };

  explicit Sort_table(std::size_t) {}
  Sort_table(Sort_table&&) = default;

  View view() const { return View(); }
  std::size_t size() const { return 0; }
};

// Without for_each_piece(): the engine runs on back ends that have none.
struct Backend {
  template <class T>
  using Buffer = archetypes::Buffer<T>;
  using Sort_table = archetypes::Sort_table;

  static const char* name() { return "archetype"; }
  std::size_t concurrency() const { return 1; }

  template <class T>
  void to_host(const T*, std::size_t, T*)
  {}
  void wait() {}

  template <class F>
  void for_each(std::size_t, F f, std::size_t = 0)
  {
    if(false)
      f(std::size_t(0));
  }

  template <class Scratch, class Body>
  void for_each_cell(std::size_t, Body body)
  {
    const auto run = [&](Block& block, Scratch& scratch) { body(block, scratch, 0u); };
    static_cast<void>(run);
  }

  void sort(Sort_table&, int = 63) {}
  void sort_ranges(std::uint64_t*, const Range*, std::size_t, std::size_t, std::size_t) {}
  template <class F>
  Buffer<std::uint32_t> compact(std::size_t, F f)
  {
    return Buffer<std::uint32_t>(std::size_t(false && f(0u)));
  }
  template <class T, class F>
  Buffer<T> collect(std::size_t, F f)
  {
    if(false && f.has(0u))
      f.take(0u);
    return {};
  }
  template <int N, class F>
  std::array<std::int64_t, N> sum(std::size_t, F f)
  {
    std::array<std::int64_t, N> sums = {};
    if(false)
      f(std::size_t(0), sums.data());
    return sums;
  }
  template <class T, class F>
  Buffer<T> make_buffer(std::size_t, F f)
  {
    if(false)
      static_cast<void>(T(f(std::size_t(0))));
    return {};
  }
  template <class Rounds>
  void run_rounds(std::size_t, std::size_t, const Rounds& rounds)
  {
    if(false && !rounds.is_last(std::size_t(0)))
      rounds.run(Rounds::steps, std::size_t(0), std::size_t(0), Rounds::few(0));
  }
  template <class F>
  void for_each_on_host(std::size_t, F f, std::size_t = 256)
  {
    if(false)
      f(std::size_t(0));
  }
  template <class T>
  static T atomic_add(T& target, T)
  {
    return target;
  }
  template <class T>
  static T atomic_min(T& target, T)
  {
    return target;
  }
  template <class T>
  static void atomic_max(T&, T)
  {}
  template <class T>
  static T atomic_load(const T& target)
  {
    return target;
  }
  template <class T>
  static T atomic_exchange_if(T& target, T, T)
  {
    return target;
  }
};

// The same in one of many processes.
struct Rank_backend : Backend {};

} // namespace archetypes

// As if all others had nothing; but the engine is compiled for many.
template <>
class Ranks<archetypes::Rank_backend> {
public:
  static constexpr bool are_many = true;

  Ranks() = delete;
  explicit Ranks(archetypes::Rank_backend&) {}

  Own_share share() const { return {}; }
  template <class F>
  auto together(F f) const
  {
    return f();
  }
  std::size_t total(std::size_t own) const { return own; }
  std::vector<std::uint64_t> total(std::vector<std::uint64_t> own) const { return own; }
  void sum(std::uint32_t*, std::size_t) const {}
  void sum(std::int64_t*, std::size_t) const {}
  void sum(std::uint64_t*, std::size_t) const {}
  template <class T>
  std::vector<T> gather(const std::vector<T>& own, std::vector<std::size_t>* = nullptr) const
  {
    return own;
  }
  template <class Cloud>
  void connect(Cloud&, int)
  {}
  std::size_t ghosts(Rings) const { return 0; }
  std::uint64_t number(std::uint32_t) const { return 0; }
  template <class T>
  void refresh(T*, Rings) const
  {}
  template <class T>
  void refresh(T*, archetypes::Buffer<T>&) const
  {}
  template <class T>
  std::vector<T> to_owners(std::vector<T> items) const
  {
    for(T& item : items)
      item.index = 0;
    return items;
  }
};

// What every back end has to replace whose functors do not write memory of the host.
template <>
struct Stage_overrides<archetypes::Backend> : No_stage_overrides {
  static constexpr bool finds_neighbors = true, groups_points = true;

  static void find_neighbors(archetypes::Backend&, const Grid_point*, std::uint32_t, int, std::uint32_t*) {}

  template <class Result>
  static void group_points(archetypes::Backend&, archetypes::Buffer<std::int32_t>&&, std::size_t, Result&)
  {}
};

template <>
struct Stage_overrides<archetypes::Rank_backend> : Stage_overrides<archetypes::Backend> {};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_ARCHETYPES_H
