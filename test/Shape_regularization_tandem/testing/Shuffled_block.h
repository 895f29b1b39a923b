// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models of Backend and Block that take all the liberties that the concepts give:
// items and pieces run in random order, new memory and scratch hold
// garbage, equal keys are sorted anyhow. What comes out must not change.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SHUFFLED_BLOCK_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SHUFFLED_BLOCK_H

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

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
  static constexpr std::uint32_t lookahead = 32; // of a CUDA block

  explicit Shuffled_block(Dice& dice) : dice(dice) {}

  template <class F>
  void for_each(std::uint32_t n, F f)
  {
    dice.visit(0, n, [&](std::size_t i) { f(std::uint32_t(i)); });
  }

  // Which lane an item comes to is random, too.
  template <class Sum, class F, class Add>
  void accumulate(std::uint32_t n, F f, Add add)
  {
    Sum sum[3];
    for_each(n, [&](std::uint32_t i) { f(i, sum[dice.below(3)]); });
    for_each(3, [&](std::uint32_t lane) { add(sum[lane]); });
  }

  template <class Row, class F>
  void for_each_neighbor(std::uint32_t n, int k, Row row, F f)
  {
    dice.visit(0, std::size_t(n) * std::size_t(k), [&](std::size_t at) {
      const std::uint32_t source = std::uint32_t(at / std::size_t(k));
      f(source, row(source)[at % std::size_t(k)]);
    });
  }

  template <class F>
  std::uint32_t find_first(std::uint32_t first, std::uint32_t n, F f)
  {
    find(first, n, 1, f, [&](std::uint32_t, std::uint32_t i) { n = i; });
    return n;
  }

  // As a device does it: all items of a window, the first of them in any order.
  template <class F, class Take>
  std::uint32_t find(std::uint32_t first, std::uint32_t n, std::uint32_t most, F f, Take take)
  {
    std::vector<std::uint32_t> found;
    for(; first < n && found.size() < most; first += window) {
      const std::uint32_t end = (std::min)(first + window, n);
      std::vector<char> is_hit(end - first);
      dice.visit(first, end, [&](std::size_t i) { is_hit[i - first] = f(std::uint32_t(i)); });
      for(std::uint32_t i = first; i < end; ++i)
        if(is_hit[i - first])
          found.push_back(i);
    }
    const std::uint32_t size = (std::min)(std::uint32_t(found.size()), most);
    for_each(size, [&](std::uint32_t rank) { take(rank, found[rank]); });
    return size;
  }

  static constexpr std::uint32_t window = 64;
  Dice& dice;
};

// Not initialized means garbage.
template <class T>
void fill_with_garbage(T* data, std::size_t size)
{
  if(size > 0) // or there is no memory
    std::memset(static_cast<void*>(data), 0xa7, size * sizeof(T));
}

template <class T>
class Garbage_buffer : public Host_buffer<T> {
public:
  Garbage_buffer() = default;
  explicit Garbage_buffer(std::size_t size) : Host_buffer<T>(size) { fill_with_garbage(this->data(), size); }
  Garbage_buffer(Host_buffer<T>&& filled) : Host_buffer<T>(std::move(filled)) {}

  void reset(std::size_t size)
  {
    Host_buffer<T>::reset(size);
    fill_with_garbage(this->data(), size);
  }
};

class Shuffled_backend : public Host_operations<Shuffled_backend>, public Plain_atomics {
public:
  template <class T>
  using Buffer = Garbage_buffer<T>;

  explicit Shuffled_backend(std::uint64_t seed = 1) : dice_(seed) {}
  virtual ~Shuffled_backend() = default;

  static const char* name() { return "shuffled"; }

  // So many that cells of small clouds are parted.
  std::size_t concurrency() const { return 20; }

  // Before a loop that is not put off, nor part of one that is.
  virtual void begin_loop() {}

  template <class F>
  void for_each(std::size_t n, F f, std::size_t = 0)
  {
    dice_.visit(0, n, f);
  }

  template <class F>
  void for_each_on_host(std::size_t n, F f, std::size_t = 256)
  {
    for_each(n, f);
  }

  template <class F>
  void for_each_piece(std::size_t n, std::size_t grain, F f)
  {
    begin_loop();
    dice_.visit(0, (n + grain - 1) / grain,
                [&](std::size_t piece) { f(piece * grain, (std::min)((piece + 1) * grain, n)); });
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

  // Equal keys come in random order.
  void sort(Sort_table& table, int = 63)
  {
    using Entry = Sort_table::Entry;
    dice_.shuffle(table.begin(), table.end());
    std::sort(table.begin(), table.end(), [](const Entry& a, const Entry& b) { return a.key < b.key; });
  }

  // The predicate is evaluated twice, in random order.
  template <class F>
  Buffer<std::uint32_t> compact(std::size_t n, F is_kept, [[maybe_unused]] std::size_t size = unknown_size)
  {
    begin_loop();
    dice_.visit(0, n, [&](std::size_t i) { is_kept(std::uint32_t(i)); });
    std::vector<std::uint32_t> kept;
    dice_.visit(0, n, [&](std::size_t i) {
      if(is_kept(std::uint32_t(i)))
        kept.push_back(std::uint32_t(i));
    });
    assert(size == unknown_size || size == kept.size());
    std::sort(kept.begin(), kept.end());
    Buffer<std::uint32_t> result(kept.size());
    std::copy(kept.begin(), kept.end(), result.begin());
    return result;
  }

  void sort_ranges(std::uint64_t* key, const Range* range, std::size_t ranges, std::size_t, std::size_t)
  {
    dice_.visit(0, ranges, [&](std::size_t c) {
      dice_.shuffle(key + range[c].first, key + range[c].last);
      std::sort(key + range[c].first, key + range[c].last);
    });
  }

private:
  Dice dice_;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SHUFFLED_BLOCK_H
