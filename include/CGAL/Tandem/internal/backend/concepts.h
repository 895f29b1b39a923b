// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Detectors of the two concepts of the engine, so that a back end that lacks
// something is refused where it enters. Their models with the meaning of each
// operation: Sequential_backend.h and Serial_block.h.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_CONCEPTS_H
#define CGAL_TANDEM_INTERNAL_BACKEND_CONCEPTS_H

#include <CGAL/Tandem/internal/backend/Host_memory.h>
#include <CGAL/Tandem/internal/base/Box.h>
#include <CGAL/Tandem/internal/base/Moments.h>

#include <functional>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace archetypes {

struct Item_functor {
  void operator()(std::size_t) const {}
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

struct Neighbor_functor {
  void operator()(std::uint32_t, std::uint32_t) const {}
};

struct Row {
  const std::uint32_t* operator()(std::uint32_t) const { return nullptr; }
};

} // namespace archetypes

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

template <class Backend, class = void>
struct Is_backend : std::false_type {};

template <class Backend>
struct Is_backend<
  Backend,
  std::void_t<
    typename Backend::template Buffer<std::uint32_t>, decltype(static_cast<const char*>(Backend::name())),
    decltype(bool(Backend::keeps_pages)), decltype(std::declval<Backend&>().wait()),
    decltype(std::declval<Backend&>().for_each(std::size_t(0), archetypes::Item_functor())),
    decltype(std::declval<Backend&>().template for_each_cell<archetypes::Scratch>(std::size_t(0),
                                                                                  archetypes::Cell_body())),
    typename Backend::Sort_table::View,
    decltype(std::declval<Backend&>().sort(std::declval<typename Backend::Sort_table&>())),
    decltype(std::size_t(std::declval<Backend&>().compact(std::size_t(0), archetypes::Predicate()).size())),
    decltype(std::size_t(
      std::declval<Backend&>().template collect<std::int64_t>(std::size_t(0), archetypes::Taker()).size())),
    decltype(std::declval<Backend&>().for_each_on_host(std::size_t(0), archetypes::Item_functor(), std::size_t(0))),
    decltype(std::declval<Backend&>().sort_on_host(std::declval<int*>(), std::declval<int*>(), std::less<int>())),
    decltype(std::declval<Backend&>().read_access(std::declval<const std::vector<int>&>()).data()),
    decltype(std::declval<Backend&>().read_write_access(std::declval<std::vector<int>&>()).copy_back()),
    decltype(std::declval<Backend&>().write_access(std::declval<std::vector<int>&>()).copy_back()),
    decltype(std::declval<Backend&>().to_host(std::declval<const int*>(), std::size_t(0), std::declval<int*>())),
    decltype(std::declval<Backend&>().from_host(std::declval<const int*>(), std::size_t(0), std::declval<int*>())),
    decltype(std::declval<Backend&>().sort_ranges(std::declval<std::uint64_t*>(), std::declval<const Range*>(),
                                                  std::size_t(0), std::size_t(0), std::size_t(0))),
    decltype(std::uint32_t(Backend::atomic_add(std::declval<std::uint32_t&>(), 0u))),
    decltype(std::uint64_t(Backend::atomic_min(std::declval<std::uint64_t&>(), std::uint64_t(0)))),
    decltype(Backend::atomic_max(std::declval<std::int32_t&>(), std::int32_t(0))),
    decltype(std::uint32_t(Backend::atomic_load(std::declval<const std::uint32_t&>()))),
    decltype(std::uint32_t(Backend::atomic_exchange_if(std::declval<std::uint32_t&>(), 0u, 0u)))>> : std::true_type {};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_CONCEPTS_H
