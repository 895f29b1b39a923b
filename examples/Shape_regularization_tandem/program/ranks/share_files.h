// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which rank reads which file.

#ifndef DETECT_PLANES_SHARE_FILES_H
#define DETECT_PLANES_SHARE_FILES_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace program {

// The rank of each file: the largest file goes first, to the rank that has least until then. Of equal ones, the first.
inline std::vector<int> share_files(const std::vector<std::uint64_t>& bytes, int ranks)
{
  std::vector<std::size_t> order(bytes.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return bytes[a] > bytes[b]; });
  std::vector<int> rank_of(bytes.size());
  std::vector<std::uint64_t> load(std::size_t(ranks), 0);
  for(std::size_t file : order) {
    const auto least = std::min_element(load.begin(), load.end());
    rank_of[file] = int(least - load.begin());
    *least += bytes[file] + 1; // files that are not there are spread, too
  }
  return rank_of;
}

} // namespace program

#endif // DETECT_PLANES_SHARE_FILES_H
