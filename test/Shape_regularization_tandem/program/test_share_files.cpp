// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files are shared among processes by their sizes.

#include "testing/checks.h"

#include "ranks/Ranks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

BOOST_AUTO_TEST_SUITE(test_share_files)

using Sizes = std::vector<std::uint64_t>;
using Shares = std::vector<int>;

// Files keep their order, and no rank is off its share by more than the largest file.
void check_balance(const Sizes& bytes, int ranks)
{
  const Shares rank_of = program::share_files(bytes, ranks);
  CHECK(std::is_sorted(rank_of.begin(), rank_of.end()));
  Sizes load(std::size_t(ranks), 0);
  for(std::size_t file = 0; file < bytes.size(); ++file)
    load.at(std::size_t(rank_of.at(file))) += bytes[file];
  const double share = double(std::accumulate(bytes.begin(), bytes.end(), std::uint64_t(0))) / ranks;
  const double largest = double(*std::max_element(bytes.begin(), bytes.end()));
  for(std::size_t rank = 0; rank < load.size(); ++rank)
    CHECK_AT(std::abs(double(load[rank]) - share) <= largest + double(bytes.size()), std::to_string(rank));
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  CHECK(program::share_files({}, 3).empty());
  CHECK(program::share_files({5, 7, 6}, 1) == Shares({0, 0, 0}));
  CHECK(program::share_files({5, 7, 6}, 5) == Shares({0, 2, 4}));
  CHECK(program::share_files({10, 30, 20, 10}, 2) == Shares({0, 0, 1, 1}));
  CHECK(program::share_files({0, 0, 0, 0}, 2) == Shares({0, 0, 1, 1})); // not there
  Sizes bytes;
  for(std::uint64_t i = 0; i < 100; ++i)
    bytes.push_back(1 + i * 7919 % 1000 * (i % 11 == 0 ? 1000 : 1));
  for(int ranks = 1; ranks < 120; ranks += 7)
    check_balance(bytes, ranks);
}

BOOST_AUTO_TEST_SUITE_END()
