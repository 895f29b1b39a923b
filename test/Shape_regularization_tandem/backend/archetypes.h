// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The three concepts that the engine is written on: what a back end supplies, what a body may use, and what connects the
// processes that share a cloud. Each is listed here with its smallest model, the archetype, which has every operation of
// the list and nothing else. A test compiles the engine with them, so no stage uses more than the concepts promise. They
// compute nothing: never() and `false &&` compile what is passed to them, and do not run it.
//
// A *back end* owns memory and runs functors and bodies; it has no notion of planes. A functor is called with an item.
// A *body* is a function template on a *block*: all lanes that work on one octree cell. Code outside of a call of the
// block is uniform: all lanes do the same. Only the functors within are per item, and their items may run in any order
// and at the same time. So no result depends on the number of lanes, threads or devices.
//
// backend/Sequential_backend.h, Serial_block.h and Ranks.h are the models to read first.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_ARCHETYPES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_ARCHETYPES_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/backend/Stage_overrides.h>
#include <CGAL/Tandem/internal/base/Moments.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL::Tandem::internal {

namespace archetypes {

template <class F>
void never(F)
{}

// Block, for lanes that share the scratch of a cell:
//   lookahead                              items worth trying before it is known whether they are needed, at most 32
//   for_each(n, f)                         f(i) for i in [0, n); then all lanes see all writes
//   for_each_neighbor(n, k, row, f)        f(s, q) for each source s and each entry q of row(s)
//   find_first(first, n, f)                the smallest i in [first, n) with f(i), or n
//   find(first, n, maximum, f, take)       take(rank, i) for the first i with f(i); returns how many
//   single(f)                              f() once
//   accumulate<Sum>(n, f, add)             f(i, sum) with a sum for each lane, then add(sum) once for each
//   load, fetch_min, add, append, exchange_if, count_pair, add_moments, add_box
//                                          on what all lanes share, at the same time
//
// Arguments and results have exactly the types that the concept lists; there is no default constructor and no copy.
struct Block {
  static constexpr std::uint32_t lookahead = 1;

  Block() = delete; // only the back end makes blocks
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  template <class F>
  void for_each(std::uint32_t, F f)
  {
    never([&] { f(0u); });
  }
  template <class Row, class F>
  void for_each_neighbor(std::uint32_t, int, Row row, F f)
  {
    never([&] { f(0u, *row(0u)); });
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
  void single(F f)
  {
    never([&] { f(); });
  }
  template <class Sum, class F, class Add>
  void accumulate(std::uint32_t, F f, Add add)
  {
    Sum sum;
    never([&] { f(0u, sum); });
    never([&] { add(sum); });
  }
  std::uint32_t load(const std::uint32_t&) { return 0; }
  std::uint32_t fetch_min(std::uint32_t&, std::uint32_t) { return 0; }
  template <class T>
  void add(T&, T)
  {}
  std::uint32_t append(std::uint32_t&) { return 0; }
  std::uint32_t exchange_if(std::uint32_t&, std::uint32_t, std::uint32_t) { return 0; }
  template <class T>
  bool count_pair(std::uint64_t&, T&, std::uint64_t)
  {
    return false;
  }
  void add_moments(Cell_moments&, const Cell_moments&) {}
  void add_box(Box&, const Box&) {}
};

// Buffer<T>, an array of plain items where the functors run. It can be made with a size or empty, and be moved:
//   reset(n)         n items, of no value
//   release()        no items
//   data(), size()
//
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

// Sort_table, keys of 64 bits with the index that each belongs to:
//   size(), view()   and of the view, in functors: key(i), index(i), set(i, key, index)
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

// Backend, memory:
//   Buffer<T>, Sort_table             see above
//   make_buffer<T>(n, f)              a buffer of f(i), i in [0, n), evaluated on the host
//   to_host(source, n, target)        waits for the items
//   wait()                            for all work that was started
//
// Backend, execution:
//   name()
//   concurrency()                                about how many bodies run at the same time
//   for_each(n, f, grain)                        f(i) for i in [0, n), in any order; so many are worth a thread
//   for_each_cell<Scratch>(cells, body)          body(block, scratch, c) for c in [0, cells), in any order
//   sort(table, bits)                            ascending by key; keys have so many bits, 63 if that is not given
//   sort_ranges(key, range, ranges, n, largest)  in each range, ascending; together they are [0, n)
//   compact(n, is_kept, size)                    the i with is_kept(i), ascending; is_kept may be called twice;
//                                                size: their exact number, if the caller knows it
//   collect<T>(n, f)                             a buffer of f.take(i) of the i with f.has(i), ascending;
//                                                all has() precede any take()
//   collect_on_host<T>(n, f, grain)              the same as a vector; so many are worth a thread
//   sum<N>(n, f)                                 N sums, for the host, to which f(i, sums) adds for i in [0, n)
//   run_rounds(maximum, n, rounds)               rounds.run(step, round, lane, lanes) for all lanes, step by step;
//                                                ends before the last step of a round with rounds.is_last(round)
//   for_each_on_host(n, f, few)                  f(i) on the host; fewer items than `few` are left to one thread
//
// Backend, for functors that run at the same time; integers only:
//   atomic_add(target, value), atomic_min(target, value)   return the old target
//   atomic_max(target, value)
//   atomic_load(target), atomic_store(target, value)
//   atomic_exchange_if(target, expected, value)            returns the old target
//
// A back end whose functors run on the host, as those that read the caller's range. It inherits the memory from
// Host_memory and has in addition
//   for_each_piece(n, grain, f)       f(first, last) for the pieces of [0, n) that begin at the multiples of grain
//
// The archetype is none of these: the engine runs on back ends without for_each_piece().
struct Backend : Plain_atomics {
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
    never([&] { f(std::size_t(0)); });
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
  Buffer<std::uint32_t> compact(std::size_t, F f, std::size_t = 0)
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
  template <class T, class F>
  std::vector<T> collect_on_host(std::size_t n, F f, std::size_t = 0)
  {
    collect<T>(n, f);
    return {};
  }
  template <int N, class F>
  std::array<std::int64_t, N> sum(std::size_t, F f)
  {
    std::array<std::int64_t, N> sums = {};
    never([&] { f(std::size_t(0), sums.data()); });
    return sums;
  }
  template <class T, class F>
  Buffer<T> make_buffer(std::size_t, F f)
  {
    never([&] { static_cast<void>(T(f(std::size_t(0)))); });
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
    never([&] { f(std::size_t(0)); });
  }
};

// The same in one of many processes.
struct Rank_backend : Backend {};

} // namespace archetypes

// Ranks, the processes that have parts of one cloud; without a word of the method. All ranks call the same operations in
// the same order, but for own_items(), ghosts() and number(), which send nothing. Made from a back end:
//   are_many                   whether there are others: what is for them only is compiled then
//   own_items()                    the items that all ranks have and of which this one does the work, an Own_items
//   together(f)                f(); where it throws, all ranks throw the same exception, instead of waiting for each other
//   total(n), total(list)      the sum of the numbers of all ranks, or of each of a list, on the host
//   sum(table, n)              the same for the integers of a table where the functors run
//   gather(items, first)       the items of all ranks on the host, one rank after the other; `first`, if it is not null,
//                              gets where those of each rank begin, and the end
//   connect(cloud, rings)      finds the ghosts: rows of a Sorted_cloud become those among the points of all ranks, and
//                              so many steps from neighbor to neighbor lead to points of other ranks, which are added. All
//                              but those of the last step have rows
//   ghosts(rings)              how many
//   connect_again(cloud, added)  the same after rows have changed. Their entries are places as before, and, beyond
//                              the ghosts, those of the points with the added numbers
//   number(place)              of a point or ghost, the same on all ranks: rank << 32 | its place on its own rank
//   place_of(number)           of the point or ghost with this number; no_index if it is neither
//   refresh(table, rings)      entries of ghosts become those of the points
//   refresh(table, sent)       the same of the inner ghosts and for integers: what has not changed is not sent again.
//                              `sent` is a buffer for this table, empty at first
//   to_owners(items)           item.index, a ghost, becomes the place of the point on its own rank, where the item goes
//
// As if all others had nothing; but the engine is compiled for many.
template <>
class Ranks<archetypes::Rank_backend> : public Ranks<archetypes::Backend> {
public:
  static constexpr bool are_many = true;

  Ranks() = delete;
  using Ranks<archetypes::Backend>::Ranks;

  // Of these types only.
  std::size_t total(std::size_t own) const { return own; }
  std::vector<std::uint64_t> total(std::vector<std::uint64_t> own) const { return own; }
  void sum(std::uint32_t*, std::size_t) const {}
  void sum(std::int64_t*, std::size_t) const {}
  void sum(std::uint64_t*, std::size_t) const {}
  template <class Cloud>
  void connect(Cloud&, int)
  {}
  template <class Cloud>
  void connect_again(Cloud&, const std::vector<std::uint64_t>&)
  {}
  std::uint32_t place_of(std::uint64_t) const { return no_index; }
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

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_ARCHETYPES_H
