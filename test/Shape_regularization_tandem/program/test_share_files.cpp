// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files are shared among processes by their sizes.

#undef NDEBUG

#include "testing/checks.h"

#include "ranks/share_files.h"

#include <algorithm>
#include <numeric>

using Sizes = std::vector<std::uint64_t>;
using Shares = std::vector<int>;

// No rank has more than the others by more than its smallest file.
void check_balance(const Sizes& bytes, int ranks)
{
  const Shares rank_of = program::share_files(bytes, ranks);
  Sizes load(std::size_t(ranks), 0), smallest(std::size_t(ranks), 0);
  for(std::size_t file = 0; file < bytes.size(); ++file) {
    const std::size_t rank = std::size_t(rank_of.at(file));
    smallest.at(rank) = load[rank] == 0 ? bytes[file] : (std::min)(smallest[rank], bytes[file]);
    load[rank] += bytes[file];
  }
  const std::uint64_t least = *std::min_element(load.begin(), load.end());
  for(std::size_t rank = 0; rank < load.size(); ++rank)
    CHECK_AT(load[rank] - smallest[rank] <= least + bytes.size(), std::to_string(rank));
  CHECK(rank_of == program::share_files(bytes, ranks));
}

int main()
{
  CHECK(program::share_files({}, 3).empty());
  CHECK(program::share_files({5, 7, 6}, 1) == Shares({0, 0, 0}));
  CHECK(program::share_files({5, 7, 6}, 5) == Shares({2, 0, 1}));
  CHECK(program::share_files({10, 30, 20, 10}, 2) == Shares({1, 0, 1, 0}));
  CHECK(program::share_files({0, 0, 0, 0}, 2) == Shares({0, 1, 0, 1})); // not there
  Sizes bytes;
  for(std::uint64_t i = 0; i < 100; ++i)
    bytes.push_back(1 + i * 7919 % 1000 * (i % 11 == 0 ? 1000 : 1));
  for(int ranks = 1; ranks < 120; ranks += 7)
    check_balance(bytes, ranks);
  return report();
}
