// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which rank reads which file.

#ifndef DETECT_PLANES_SHARE_FILES_H
#define DETECT_PLANES_SHARE_FILES_H

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace program {

// The rank of each file: consecutive files, with about as many bytes on each rank; the middle of a file decides. So the
// points have the order of the files, as in one process.
inline std::vector<int> share_files(const std::vector<std::uint64_t>& bytes, int ranks)
{
  const double files = double(bytes.size()); // each counts, so that files that are not there are spread, too
  const double total = std::accumulate(bytes.begin(), bytes.end(), files);
  std::vector<int> rank_of;
  double before = 0;
  for(const std::uint64_t n : bytes) {
    const double size = double(n) + 1;
    rank_of.push_back(int((before + size / 2) * ranks / total));
    before += size;
  }
  return rank_of;
}

} // namespace program

#endif // DETECT_PLANES_SHARE_FILES_H
