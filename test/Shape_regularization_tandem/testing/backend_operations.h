// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Loops, compaction, collection, sums and buffers beside plain loops, on any back end.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BACKEND_OPERATIONS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BACKEND_OPERATIONS_H

#include <CGAL/Tandem/internal/backend/buffers.h>

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL::Tandem::internal {

struct Visit_item {
  std::uint32_t* visits;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { ++visits[i]; }
};

struct Is_end_of_step {
  std::uint32_t step;

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const { return i % step == step - 1; }
};

// Of a size that is no power of two.
struct Taken_item {
  std::uint32_t index;
  unsigned char rest[7];

  CGAL_TANDEM_HD bool operator==(const Taken_item& other) const
  {
    return index == other.index && rest[0] == other.rest[0] && rest[6] == other.rest[6];
  }
};

CGAL_TANDEM_HD inline Taken_item make_taken_item(std::uint32_t i)
{
  return {i, {(unsigned char)(i % 7), 0, 0, 0, 0, 0, (unsigned char)(i % 251)}};
}

// What is taken changes what decides which items are: an item and the one at the same distance from the end.
struct Take_items {
  std::uint32_t* counter;
  std::uint32_t size;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const { return counter[i] + counter[size - 1 - i] == 7; }
  CGAL_TANDEM_HD Taken_item take(std::uint32_t i) const
  {
    counter[i] += 100;
    return make_taken_item(i);
  }
};

// Large and negative summands; some items add nothing to the second and the third sum.
struct Add_to_sums {
  CGAL_TANDEM_HD void operator()(std::size_t i, std::int64_t* sums) const
  {
    const std::int64_t value = std::int64_t(i % 1000) - 300;
    sums[0] += value * (std::int64_t(1) << 40);
    if(i % 3 == 0)
      sums[1] -= value;
    if(i % 20000 == 19999)
      sums[2] += 1;
  }
};

template <class Backend>
class Backend_operations {
public:
  explicit Backend_operations(Backend& backend) : backend_(backend) {}

  // What is wrong.
  std::vector<std::string> run()
  {
    for(std::uint32_t n : {0u, 1u, 1023u, 1024u, 1025u, 32768u, 32769u, 300000u}) {
      test_loops(n);
      for(std::uint32_t step : {1u, 3u, 20000u, 400000u})
        test_collect(n, step);
      test_sums(n);
      test_buffers(n);
    }
    return wrong_;
  }

private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  void check(bool is_right, const char* what, std::size_t n)
  {
    if(!is_right)
      wrong_.push_back(what + std::string(" of ") + std::to_string(n));
  }

  // Each item once, whatever number of items is said to be worth a thread.
  void test_loops(std::size_t n)
  {
    Buffer<std::uint32_t> visits = filled_buffer(backend_, n, std::uint32_t(0));
    std::uint32_t times = 0;
    for(std::size_t grain : {1, 3, 32, 4096, 1000000}) {
      backend_.for_each(n, Visit_item{visits.data()}, grain);
      check(to_vector(backend_, visits) == std::vector<std::uint32_t>(n, ++times), "a loop", n);
    }
  }

  // The items come in their order, and each is taken once.
  void test_collect(std::uint32_t n, std::uint32_t step)
  {
    std::vector<std::uint32_t> kept, before(n, 4);
    for(std::uint32_t i = 0; i < n; ++i)
      if(Is_end_of_step{step}(i)) {
        kept.push_back(i);
        before[i] = 3;
      }
    check(to_vector(backend_, backend_.compact(n, Is_end_of_step{step})) == kept, "a compaction", n);
    std::vector<Taken_item> expected;
    std::vector<std::uint32_t> after = before;
    for(std::uint32_t i = 0; i < n; ++i)
      if(before[i] + before[n - 1 - i] == 7) {
        expected.push_back(make_taken_item(i));
        after[i] += 100;
      }
    Buffer<std::uint32_t> counter = to_buffer(backend_, before);
    const auto items = backend_.template collect<Taken_item>(n, Take_items{counter.data(), n});
    static_assert(std::is_same<decltype(items), const Buffer<Taken_item>>::value, "they stay where functors run");
    check(to_vector(backend_, items) == expected, "a collection", n);
    check(to_vector(backend_, counter) == after, "what is taken, ", n);
  }

  void test_sums(std::size_t n)
  {
    std::array<std::int64_t, 3> expected = {};
    for(std::size_t i = 0; i < n; ++i)
      Add_to_sums()(i, expected.data());
    check(backend_.template sum<3>(n, Add_to_sums()) == expected, "three sums", n);
  }

  void test_buffers(std::uint32_t n)
  {
    std::vector<Taken_item> table(n, make_taken_item(9));
    check(to_vector(backend_, filled_buffer(backend_, n, make_taken_item(9))) == table, "a filled buffer", n);
    for(std::uint32_t i = 0; i < n; ++i)
      table[i] = make_taken_item(i);
    const Buffer<Taken_item> copy = to_buffer(backend_, table);
    check(copy.size() == n && to_vector(backend_, copy) == table, "a buffer", n);
    table.resize(n / 2);
    check(to_vector(backend_, copy.data(), n / 2) == table, "half a buffer", n);
  }

  Backend& backend_;
  std::vector<std::string> wrong_;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BACKEND_OPERATIONS_H
