// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// run_rounds() and make_buffer() on several back ends: each step sees all of the one before, and rounds end where they
// should.

#include "testing/Reverse_backend.h"
#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/backend/lanes.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_rounds)

using namespace CGAL::Tandem::internal;

// Sums up to each item, by distances that double in each round: a step needs all of the one before.
struct Prefix_sums {
  static constexpr int steps = 2;
  static constexpr std::size_t few(int) { return 3; }

  std::uint32_t *sum, *next;
  std::size_t size, last_round;

  bool is_last(std::size_t round) const { return round == last_round; }

  void run(int step, std::size_t round, std::size_t lane, std::size_t lanes) const
  {
    const std::size_t distance = std::size_t(1) << round;
    for_items_of_lane(lane, lanes, size, [&](std::size_t i) {
      if(step == 0)
        next[i] = sum[i] + (i < distance ? 0 : sum[i - distance]);
      else
        sum[i] = next[i];
    });
  }
};

// With fewer and with more lanes than items; the end by is_last(), before the last step, or by the number of rounds.
template <class Backend>
void test_rounds(Backend&& backend)
{
  const std::string name = backend.name();
  constexpr std::uint32_t n = 700;
  const auto made = backend.template make_buffer<std::uint32_t>(n, [](std::size_t i) { return std::uint32_t(i % 7); });
  const std::pair<std::size_t, std::size_t> ends[] = {{12, 99}, {99, 12}, {3, 99}, {99, 3}, {0, 99}};
  for(const auto& end : ends)
    for(std::size_t items : {std::size_t(1), std::size_t(100), std::size_t(n), std::size_t(2 * n)}) {
      std::vector<std::uint32_t> sum(made.begin(), made.end()), next(n, 0), expected(n, 0);
      backend.run_rounds(end.first, items, Prefix_sums{sum.data(), next.data(), n, end.second});
      const std::uint32_t reach = 1u << (std::min)(end.first, end.second);
      for(std::uint32_t i = 0; i < n; ++i)
        for(std::uint32_t j = 0; j < reach && j <= i; ++j)
          expected[i] += (i - j) % 7;
      check_lists(sum, expected, name + ": rounds of steps");
      if(end.second < end.first && reach < n) // the step before the last one has run
        CHECK_AT(next[n - 1] > sum[n - 1], name + ": last round");
    }
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  test_rounds(Sequential_backend());
  test_rounds(Thread_backend());
  test_rounds(Reverse_backend());
#ifdef CGAL_LINKED_WITH_TBB
  test_rounds(Tbb_backend());
#endif
  for(std::uint64_t seed : {1, 2, 3})
    test_rounds(Shuffled_backend(seed));
}

BOOST_AUTO_TEST_SUITE_END()
