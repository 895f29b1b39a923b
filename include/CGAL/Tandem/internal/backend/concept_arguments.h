// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Arguments of the operations that concepts.h lists, for its detectors: the least that a functor has.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_CONCEPT_ARGUMENTS_H
#define CGAL_TANDEM_INTERNAL_BACKEND_CONCEPT_ARGUMENTS_H

#include <CGAL/Tandem/internal/base/types.h>

#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {

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

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_CONCEPT_ARGUMENTS_H
