// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The three concepts that the engine is written on: what a back end supplies, what a body may use, and what connects the
// processes that share a cloud. Everything that the engine calls is listed here, and archetypes.h has it and nothing else.
//
// A *back end* owns memory and runs functors and bodies; it has no notion of planes. A functor is called with an item.
// A *body* is a function template on a *block*: all lanes that work on one octree cell. Code outside of a call of the
// block is uniform: all lanes do the same. Only the functors within are per item, and their items may run in any order
// and at the same time. So no result depends on the number of lanes, threads or devices.
//
// Sequential_backend.h, Serial_block.h and Ranks.h are the models to read first.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_CONCEPTS_H
#define CGAL_TANDEM_INTERNAL_BACKEND_CONCEPTS_H

#include <CGAL/Tandem/internal/backend/Host_memory.h>
#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/base/Box.h>
#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

// --- Arguments of the operations that concepts.h lists, for its detectors: the least that a functor has.

namespace archetypes {

struct Item_functor {
  void operator()(std::size_t) const {}
};

struct Piece_functor {
  void operator()(std::size_t, std::size_t) const {}
};

struct Scratch {};

struct Cell_body {
  template <class Block>
  void operator()(Block&, Scratch&, std::uint32_t) const
  {}
};

struct Predicate {
  bool operator()(std::uint32_t) const { return false; }
};

struct Taker {
  bool has(std::uint32_t) const { return false; }
  std::int64_t take(std::uint32_t) const { return 0; }
};

struct Found {
  void operator()(std::uint32_t, std::uint32_t) const {}
};

struct Value {
  std::uint32_t operator()(std::uint32_t) const { return 0; }
};

struct Summand {
  void operator()(std::uint32_t, int&) const {}
};

struct Sum {
  void operator()(int&) const {}
};

struct Summed {
  void operator()(std::size_t, std::int64_t*) const {}
};

struct Maker {
  int operator()(std::size_t) const { return 0; }
};

struct Rounds {
  static constexpr int steps = 1;
  static constexpr std::size_t few(int) { return 1; }
  void run(int, std::size_t, std::size_t, std::size_t) const {}
  bool is_last(std::size_t) const { return true; }
};

struct Neighbor_functor {
  void operator()(std::uint32_t, std::uint32_t) const {}
};

struct Row {
  const std::uint32_t* operator()(std::uint32_t) const { return nullptr; }
};

struct Result {
  int operator()() const { return 0; }
};

struct Sent {
  std::uint64_t index;
};

} // namespace archetypes

// Block, for lanes that share the scratch of a cell:
//   lookahead                              items worth trying before it is known whether they are needed, at most 32
//   for_each(n, f)                         f(i) for i in [0, n); then all lanes see all writes
//   for_each_neighbor(n, k, row, f)        f(s, q) for each source s and each entry q of row(s), which may be null
//   find_first(first, n, f)                the smallest i in [first, n) with f(i), or n
//   find(first, n, maximum, f, take)       take(rank, i) for the first i with f(i); returns how many
//   min(n, f)                              the smallest f(i), or no_index
//   single(f)                              f() once
//   accumulate<Sum>(n, f, add)             f(i, sum) with a sum for each lane, then add(sum) once for each
//   load, fetch_min, add, append, exchange_if, count_pair, add_moments, add_box
//                                          on what all lanes share, at the same time
template <class Block, class = void>
struct Is_block : std::false_type {};

template <class Block>
struct Is_block<
  Block,
  std::void_t<
    decltype(std::uint32_t(Block::lookahead)), decltype(std::declval<Block&>().for_each(0u, archetypes::Predicate())),
    decltype(std::declval<Block&>().for_each_neighbor(0u, 0, archetypes::Row(), archetypes::Neighbor_functor())),
    decltype(std::uint32_t(std::declval<Block&>().find_first(0u, 0u, archetypes::Predicate()))),
    decltype(std::uint32_t(std::declval<Block&>().find(0u, 0u, 0u, archetypes::Predicate(), archetypes::Found()))),
    decltype(std::uint32_t(std::declval<Block&>().min(0u, archetypes::Value()))),
    decltype(std::declval<Block&>().single(Nothing())),
    decltype(std::uint32_t(std::declval<Block&>().load(std::declval<const std::uint32_t&>()))),
    decltype(std::uint32_t(std::declval<Block&>().fetch_min(std::declval<std::uint32_t&>(), 0u))),
    decltype(std::declval<Block&>().add(std::declval<std::uint32_t&>(), 0u)),
    decltype(std::uint32_t(std::declval<Block&>().append(std::declval<std::uint32_t&>()))),
    decltype(std::uint32_t(std::declval<Block&>().exchange_if(std::declval<std::uint32_t&>(), 0u, 0u))),
    decltype(bool(std::declval<Block&>().count_pair(std::declval<std::uint64_t&>(), std::declval<std::uint32_t&>(),
                                                    std::uint64_t(0)))),
    decltype(std::declval<Block&>().template accumulate<int>(0u, archetypes::Summand(), archetypes::Sum())),
    decltype(std::declval<Block&>().add_moments(std::declval<Cell_moments&>(), std::declval<const Cell_moments&>())),
    decltype(std::declval<Block&>().add_box(std::declval<Box&>(), std::declval<const Box&>()))>> : std::true_type {};

// Buffer<T>, an array of plain items where the functors run. It can be made with a size or empty, and be moved:
//   reset(n)         n items, of no value
//   release()        no items
//   data(), size()
template <class Buffer, class = void>
struct Is_buffer : std::false_type {};

template <class Buffer>
struct Is_buffer<Buffer, std::void_t<decltype(Buffer()), decltype(Buffer(std::size_t(0))),
                                     decltype(std::declval<Buffer&>() = std::declval<Buffer&&>()),
                                     decltype(std::declval<Buffer&>().reset(std::size_t(0))),
                                     decltype(std::declval<Buffer&>().release()),
                                     decltype(static_cast<std::uint32_t*>(std::declval<Buffer&>().data())),
                                     decltype(static_cast<const std::uint32_t*>(std::declval<const Buffer&>().data())),
                                     decltype(std::size_t(std::declval<const Buffer&>().size()))>> : std::true_type {};

// Sort_table, keys of 64 bits with the index that each belongs to:
//   size(), view()   and of the view, in functors: key(i), index(i), set(i, key, index)
template <class Table, class = void>
struct Is_sort_table : std::false_type {};

template <class Table>
struct Is_sort_table<
  Table, std::void_t<decltype(Table(std::size_t(0))), decltype(std::size_t(std::declval<const Table&>().size())),
                     decltype(typename Table::View(std::declval<const Table&>().view())),
                     decltype(std::uint64_t(std::declval<const typename Table::View&>().key(std::size_t(0)))),
                     decltype(std::uint32_t(std::declval<const typename Table::View&>().index(std::size_t(0)))),
                     decltype(std::declval<const typename Table::View&>().set(std::size_t(0), std::uint64_t(0), 0u))>>
  : std::true_type {};

// Backend, memory:
//   Buffer<T>, Sort_table             see above
//   make_buffer<T>(n, f)              a buffer of f(i), i in [0, n), evaluated on the host
//   to_host(source, n, target)        waits for the items
//   wait()                            for all work that was started
template <class Backend, class = void>
struct Has_memory : std::false_type {};

template <class Backend>
struct Has_memory<
  Backend,
  std::void_t<typename std::enable_if<Is_buffer<typename Backend::template Buffer<std::uint32_t>>::value>::type,
              typename std::enable_if<Is_sort_table<typename Backend::Sort_table>::value>::type,
              decltype(typename Backend::template Buffer<int>(
                std::declval<Backend&>().template make_buffer<int>(std::size_t(0), archetypes::Maker()))),
              decltype(std::declval<Backend&>().to_host(std::declval<const int*>(), std::size_t(0),
                                                        std::declval<int*>())),
              decltype(std::declval<Backend&>().wait())>> : std::true_type {};

// Backend, execution:
//   name()
//   concurrency()                                about how many bodies run at the same time
//   for_each(n, f, grain)                        f(i) for i in [0, n), in any order; so many are worth a thread
//   for_each_cell<Scratch>(cells, body)          body(block, scratch, c) for c in [0, cells), in any order
//   sort(table, bits)                            ascending by key; keys have so many bits, 63 if that is not given
//   sort_ranges(key, range, ranges, n, largest)  in each range, ascending; together they are [0, n)
//   compact(n, is_kept)                          the i with is_kept(i), ascending; is_kept may be called twice
//   collect<T>(n, f)                             a buffer of f.take(i) of the i with f.has(i), ascending;
//                                                all has() precede any take()
//   sum<N>(n, f)                                 N sums, for the host, to which f(i, sums) adds for i in [0, n)
//   run_rounds(maximum, n, rounds)               rounds.run(step, round, lane, lanes) for all lanes, step by step;
//                                                ends before the last step of a round with rounds.is_last(round)
//   for_each_on_host(n, f, few)                  f(i) on the host; fewer items than `few` are left to one thread
template <class Backend, class = void>
struct Has_execution : std::false_type {};

template <class Backend>
struct Has_execution<
  Backend,
  std::void_t<
    decltype(static_cast<const char*>(Backend::name())),
    decltype(std::size_t(std::declval<const Backend&>().concurrency())),
    decltype(std::declval<Backend&>().for_each(std::size_t(0), archetypes::Item_functor())),
    decltype(std::declval<Backend&>().for_each(std::size_t(0), archetypes::Item_functor(), std::size_t(0))),
    decltype(std::declval<Backend&>().template for_each_cell<archetypes::Scratch>(std::size_t(0),
                                                                                  archetypes::Cell_body())),
    decltype(std::declval<Backend&>().sort(std::declval<typename Backend::Sort_table&>())),
    decltype(std::declval<Backend&>().sort(std::declval<typename Backend::Sort_table&>(), 32)),
    decltype(std::declval<Backend&>().sort_ranges(std::declval<std::uint64_t*>(), std::declval<const Range*>(),
                                                  std::size_t(0), std::size_t(0), std::size_t(0))),
    decltype(typename Backend::template Buffer<std::uint32_t>(
      std::declval<Backend&>().compact(std::size_t(0), archetypes::Predicate()))),
    decltype(typename Backend::template Buffer<std::int64_t>(
      std::declval<Backend&>().template collect<std::int64_t>(std::size_t(0), archetypes::Taker()))),
    decltype(std::array<std::int64_t, 2>(
      std::declval<Backend&>().template sum<2>(std::size_t(0), archetypes::Summed()))),
    decltype(std::declval<Backend&>().run_rounds(std::size_t(0), std::size_t(0), archetypes::Rounds())),
    decltype(std::declval<Backend&>().for_each_on_host(std::size_t(0), archetypes::Item_functor(), std::size_t(0))),
    decltype(std::declval<Backend&>().for_each_on_host(std::size_t(0), archetypes::Item_functor()))>> : std::true_type {
};

// Backend, for functors that run at the same time; integers only:
//   atomic_add(target, value), atomic_min(target, value)   return the old target
//   atomic_max(target, value)
//   atomic_load(target)
//   atomic_exchange_if(target, expected, value)            returns the old target
template <class Backend, class = void>
struct Has_atomics : std::false_type {};

template <class Backend>
struct Has_atomics<
  Backend, std::void_t<decltype(std::uint32_t(Backend::atomic_add(std::declval<std::uint32_t&>(), 0u))),
                       decltype(std::int64_t(Backend::atomic_add(std::declval<std::int64_t&>(), std::int64_t(0)))),
                       decltype(std::uint64_t(Backend::atomic_add(std::declval<std::uint64_t&>(), std::uint64_t(0)))),
                       decltype(std::uint32_t(Backend::atomic_min(std::declval<std::uint32_t&>(), 0u))),
                       decltype(std::int32_t(Backend::atomic_min(std::declval<std::int32_t&>(), std::int32_t(0)))),
                       decltype(std::uint64_t(Backend::atomic_min(std::declval<std::uint64_t&>(), std::uint64_t(0)))),
                       decltype(Backend::atomic_max(std::declval<std::int32_t&>(), std::int32_t(0))),
                       decltype(std::uint32_t(Backend::atomic_load(std::declval<const std::uint32_t&>()))),
                       decltype(std::uint32_t(Backend::atomic_exchange_if(std::declval<std::uint32_t&>(), 0u, 0u))),
                       decltype(std::uint64_t(Backend::atomic_exchange_if(
                         std::declval<std::uint64_t&>(), std::uint64_t(0), std::uint64_t(0))))>> : std::true_type {};

template <class Backend>
struct Is_backend : std::integral_constant<bool, Has_memory<Backend>::value && Has_execution<Backend>::value &&
                                                   Has_atomics<Backend>::value> {};

// A back end whose functors run on the host, as those that read the caller's range. It inherits the memory from
// Host_memory and has in addition
//   for_each_piece(n, grain, f)       f(first, last) for the pieces of [0, n) that begin at the multiples of grain
template <class Backend, class = void>
struct Is_host_backend : std::false_type {};

template <class Backend>
struct Is_host_backend<Backend, std::void_t<decltype(std::declval<Backend&>().for_each_piece(
                                  std::size_t(0), std::size_t(0), archetypes::Piece_functor()))>>
  : std::integral_constant<bool, Is_backend<Backend>::value && std::is_base_of<Host_memory, Backend>::value> {};

// Ranks, the processes that have parts of one cloud; without a word of the method. All ranks call the same operations in
// the same order, but for share(), ghosts() and number(), which send nothing. Made from a back end:
//   are_many                   whether there are others: what is for them only is compiled then
//   share()                    the items that all ranks have and of which this one does the work, an Own_share
//   together(f)                f(); where it throws, all ranks throw the same exception, instead of waiting for each other
//   total(n), total(list)      the sum of the numbers of all ranks, or of each of a list, on the host
//   sum(table, n)              the same for the integers of a table where the functors run
//   gather(items, first)       the items of all ranks on the host, one rank after the other; `first`, if it is not null,
//                              gets where those of each rank begin, and the end
//   connect(cloud, rings)      finds the ghosts: rows of a Sorted_cloud become those among the points of all ranks, and
//                              so many steps from neighbor to neighbor lead to points of other ranks, which are added. All
//                              but those of the last step have rows
//   ghosts(rings)              how many
//   number(place)              of a point or ghost, the same on all ranks: rank << 32 | its place on its own rank
//   refresh(table, rings)      entries of ghosts become those of the points
//   refresh(table, sent)       the same of the inner ghosts and for integers: what has not changed is not sent again.
//                              `sent` is a buffer for this table, empty at first
//   to_owners(items)           item.index, a ghost, becomes the place of the point on its own rank, where the item goes
template <class Ranks, class Backend, class = void>
struct Is_ranks : std::false_type {};

template <class Ranks, class Backend>
struct Is_ranks<
  Ranks, Backend,
  std::void_t<
    decltype(Ranks(std::declval<Backend&>())), decltype(bool(Ranks::are_many)),
    decltype(Own_share(std::declval<const Ranks&>().share())),
    decltype(int(std::declval<const Ranks&>().together(archetypes::Result()))),
    decltype(std::size_t(std::declval<const Ranks&>().total(std::size_t(0)))),
    decltype(std::vector<std::uint64_t>(std::declval<const Ranks&>().total(std::vector<std::uint64_t>()))),
    decltype(std::declval<const Ranks&>().sum(std::declval<std::uint32_t*>(), std::size_t(0))),
    decltype(std::declval<const Ranks&>().sum(std::declval<std::int64_t*>(), std::size_t(0))),
    decltype(std::declval<const Ranks&>().sum(std::declval<std::uint64_t*>(), std::size_t(0))),
    decltype(std::vector<int>(std::declval<const Ranks&>().gather(std::vector<int>()))),
    decltype(std::declval<const Ranks&>().gather(std::vector<int>(), std::declval<std::vector<std::size_t>*>())),
    decltype(std::declval<Ranks&>().connect(std::declval<archetypes::Scratch&>(), 1)),
    decltype(std::size_t(std::declval<const Ranks&>().ghosts(Rings::inner))),
    decltype(std::uint64_t(std::declval<const Ranks&>().number(0u))),
    decltype(std::declval<const Ranks&>().refresh(std::declval<double*>(), Rings::all)),
    decltype(std::declval<const Ranks&>().refresh(std::declval<std::uint32_t*>(),
                                                  std::declval<typename Backend::template Buffer<std::uint32_t>&>())),
    decltype(std::vector<archetypes::Sent>(std::declval<const Ranks&>().to_owners(std::vector<archetypes::Sent>())))>>
  : std::true_type {};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_CONCEPTS_H
