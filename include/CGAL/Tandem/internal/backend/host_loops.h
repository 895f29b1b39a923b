// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sums and lists over tables of the host, by many threads. Pieces and their order depend on the number of items only,
// so results are the same for any number of threads.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_HOST_LOOPS_H
#define CGAL_TANDEM_INTERNAL_BACKEND_HOST_LOOPS_H

#include <CGAL/Tandem/internal/memory/Unset_vector.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace CGAL {
namespace Tandem {
namespace internal {

// A constant, not the number of threads: see above.
constexpr std::size_t pieces_on_host = 64;

// f(p, first, last) for the pieces [first, last) of [0, n), which are numbered from 0. Few items are left to one
// thread. Pieces may be empty.
template <class Backend, class F>
void for_each_piece_on_host(Backend& backend, std::size_t n, F f)
{
  constexpr std::size_t few = 256;
  backend.for_each_on_host(
    pieces_on_host, [&](std::size_t p) { f(p, n * p / pieces_on_host, n * (p + 1) / pieces_on_host); },
    n < few ? pieces_on_host + 1 : 1);
}

// The sum of value(i) for i in [0, n), evaluated once for each i, at the same time for many.
template <class Backend, class F>
std::int64_t sum_on_host(Backend& backend, std::size_t n, F value)
{
  std::array<std::int64_t, pieces_on_host> sums;
  for_each_piece_on_host(backend, n, [&](std::size_t p, std::size_t first, std::size_t last) {
    std::int64_t sum = 0;
    for(std::size_t i = first; i < last; ++i)
      sum += value(i);
    sums[p] = sum;
  });
  return std::accumulate(sums.begin(), sums.end(), std::int64_t(0));
}

// A list in two parts, each in the former order.
struct Parted_ids {
  Ids chosen, others;
};

// Parts the list id(i), i in [0, n). is_chosen(id) is evaluated once for each, at the same time for many, so it may
// change the item of its id only. Pieces are parted first, then copied to their places.
template <class Backend, class Id, class Predicate>
Parted_ids part_on_host(Backend& backend, std::size_t n, Id id, Predicate is_chosen)
{
  Ids parted(n);                                      // the others of a piece behind the chosen ones, in reverse
  std::array<std::size_t, pieces_on_host + 1> before; // chosen ones, before the piece
  before[0] = 0;
  for_each_piece_on_host(backend, n, [&](std::size_t p, std::size_t first, std::size_t last) {
    std::size_t front = first, back = last;
    for(std::size_t i = first; i < last; ++i) { // without a branch, which would be mispredicted often
      const std::uint32_t next = id(i);
      const bool is_in = is_chosen(next);
      parted[front] = parted[back - 1] = next;
      front += std::size_t(is_in);
      back -= std::size_t(!is_in);
    }
    before[p + 1] = front - first;
  });
  std::partial_sum(before.begin(), before.end(), before.begin());
  Parted_ids result = {Ids(before.back()), Ids(n - before.back())};
  for_each_piece_on_host(backend, n, [&](std::size_t p, std::size_t first, std::size_t last) {
    const auto at = [](Ids& ids, std::size_t i) { return ids.begin() + std::ptrdiff_t(i); };
    const std::size_t middle = first + (before[p + 1] - before[p]);
    std::copy(at(parted, first), at(parted, middle), at(result.chosen, before[p]));
    std::reverse_copy(at(parted, middle), at(parted, last), at(result.others, first - before[p]));
  });
  return result;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_HOST_LOOPS_H
