// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models of Backend and Block that take all the liberties that the concepts give:
// items run in random order, pieces have random sizes, new memory and scratch hold
// garbage, equal keys are sorted anyhow. What comes out must not notice.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SHUFFLED_BLOCK_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SHUFFLED_BLOCK_H

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>

#include <cstring>
#include <numeric>
#include <random>

namespace CGAL {
namespace Tandem {
namespace internal {

class Dice {
public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  // In [0, n).
  std::size_t below(std::size_t n) { return std::size_t(engine_() % n); }

  template <class Iterator>
  void shuffle(Iterator first, Iterator last)
  {
    for(std::size_t n = std::size_t(last - first); n > 1; --n)
      std::swap(first[n - 1], first[below(n)]);
  }

  // f(i) for i in [first, last).
  template <class F>
  void visit(std::size_t first, std::size_t last, F f)
  {
    std::vector<std::size_t> order(last - first);
    std::iota(order.begin(), order.end(), first);
    shuffle(order.begin(), order.end());
    for(std::size_t i : order)
      f(i);
  }

private:
  std::mt19937_64 engine_;
};

// Positions, counts and atomics are those of Serial_block: they are as random as
// the order in which the items ask for them.
struct Shuffled_block : Serial_block {
  explicit Shuffled_block(Dice& dice) : dice(dice) {}

  template <class F>
  void for_each(std::uint32_t n, F f)
  {
    dice.visit(0, n, [&](std::size_t i) { f(std::uint32_t(i)); });
  }

  template <class Row, class F>
  void for_each_neighbor(std::uint32_t n, int k, Row row, F f)
  {
    dice.visit(0, std::size_t(n) * std::size_t(k), [&](std::size_t at) {
      const std::uint32_t source = std::uint32_t(at / std::size_t(k));
      const std::uint32_t* neighbors = row(source);
      if(neighbors != nullptr)
        f(source, neighbors[at % std::size_t(k)]);
    });
  }

  // As a device does it: all items of a window, then the smallest.
  template <class F>
  std::uint32_t find_first(std::uint32_t first, std::uint32_t n, F f)
  {
    for(; first < n; first += window) {
      std::uint32_t found = n;
      dice.visit(first, (std::min)(first + window, n), [&](std::size_t i) {
        if(f(std::uint32_t(i)))
          found = (std::min)(found, std::uint32_t(i));
      });
      if(found < n)
        return found;
    }
    return n;
  }

  template <class F>
  std::uint32_t min(std::uint32_t n, F f)
  {
    std::uint32_t least = no_index;
    dice.visit(0, n, [&](std::size_t i) { least = (std::min)(least, std::uint32_t(f(std::uint32_t(i)))); });
    return least;
  }

  static constexpr std::uint32_t window = 64;
  Dice& dice;
};

// Not initialized means garbage.
template <class T>
class Soiled_buffer : public Host_buffer<T> {
public:
  Soiled_buffer() = default;
  explicit Soiled_buffer(std::size_t size) : Host_buffer<T>(size) { soil(); }

  void reset(std::size_t size)
  {
    Host_buffer<T>::reset(size);
    soil();
  }

private:
  void soil() { std::memset(static_cast<void*>(this->data()), 0xa7, this->size() * sizeof(T)); }
};

class Shuffled_backend : public Sequential_backend {
public:
  template <class T>
  using Buffer = Soiled_buffer<T>;

  explicit Shuffled_backend(std::uint64_t seed = 1) : dice_(seed) {}

  static const char* name() { return "shuffled"; }

  template <class F>
  void for_each(std::size_t n, F f)
  {
    dice_.visit(0, n, f);
  }

  template <class F>
  void for_each_piece(std::size_t n, std::size_t grain, F f)
  {
    std::vector<std::size_t> bound(1, 0);
    while(bound.back() < n)
      bound.push_back((std::min)(n, bound.back() + 1 + dice_.below(grain)));
    dice_.visit(1, bound.size(), [&](std::size_t piece) { f(bound[piece - 1], bound[piece]); });
  }

  template <class Scratch, class Body>
  void for_each_cell(std::size_t cells, Body body)
  {
    auto scratch = std::make_unique<Scratch>();
    Shuffled_block block(dice_);
    dice_.visit(0, cells, [&](std::size_t c) {
      std::memset(static_cast<void*>(scratch.get()), 0x5b, sizeof(Scratch));
      body(block, *scratch, std::uint32_t(c));
    });
  }

  void sort_by_key(Keyed_index* first, Keyed_index* last)
  {
    dice_.shuffle(first, last);
    std::sort(first, last, [](const Keyed_index& a, const Keyed_index& b) { return a.key < b.key; });
  }

  void sort_ranges(std::uint64_t* key, const Range* range, std::size_t ranges)
  {
    dice_.visit(0, ranges, [&](std::size_t c) {
      dice_.shuffle(key + range[c].first, key + range[c].last);
      std::sort(key + range[c].first, key + range[c].last);
    });
  }

private:
  Dice dice_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SHUFFLED_BLOCK_H
