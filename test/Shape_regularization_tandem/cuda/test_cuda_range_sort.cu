// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The device sorts the keys of ranges: of any size, with equal keys, and nothing beside them.

#undef NDEBUG

#include "testing/cuda_device.h"

#include <CGAL/Tandem/internal/backend/buffers.h>
#include <CGAL/Tandem/internal/cuda/execution/Cuda_backend.cuh>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <random>

using namespace CGAL::Tandem::internal;

// Ranges of these sizes, one after the other, of keys below `keys`; every tenth is the largest there is.
bool is_sorted_alike(const std::vector<std::uint32_t>& sizes, std::uint64_t keys, std::size_t largest)
{
  std::mt19937_64 random(7);
  std::vector<Range> ranges;
  for(std::uint32_t size : sizes) {
    const std::uint32_t first = ranges.empty() ? 0 : ranges.back().last;
    ranges.push_back({first, first + size});
  }
  std::vector<std::uint64_t> key(ranges.empty() ? 0 : ranges.back().last);
  for(std::uint64_t& k : key)
    k = random() % 10 == 0 ? ~std::uint64_t(0) : random() % keys;

  Cuda_backend cuda;
  Device_buffer<std::uint64_t> keys_there = to_buffer(cuda, key);
  const Device_buffer<Range> ranges_there = to_buffer(cuda, ranges);
  cuda.sort_ranges(keys_there.data(), ranges_there.data(), ranges.size(), key.size(), largest);
  const std::vector<std::uint64_t> sorted = to_vector(cuda, keys_there.data(), key.size());

  for(const Range& r : ranges)
    std::sort(key.begin() + r.first, key.begin() + r.last);
  return sorted == key;
}

int main()
{
  if(!has_device())
    return exit_skipped;
  std::vector<std::uint32_t> many(300);
  std::iota(many.begin(), many.end(), 1);
  int failures = 0;
  for(const std::vector<std::uint32_t>& sizes :
      {std::vector<std::uint32_t>{}, {1}, {4095, 4096, 4097, 1, 8191, 8192}, {8193, 20000, 3, 65535, 65536}, many})
    for(std::uint64_t keys : {std::uint64_t(1), std::uint64_t(5), ~std::uint64_t(0)}) {
      const std::size_t most = sizes.empty() ? 0 : *std::max_element(sizes.begin(), sizes.end());
      for(std::size_t largest : {most, most + 1, std::size_t(65536)})
        if(!is_sorted_alike(sizes, keys, largest)) {
          std::fprintf(stderr, "%zu ranges of up to %zu keys below %llu differ\n", sizes.size(), most,
                       static_cast<unsigned long long>(keys));
          ++failures;
        }
    }
  std::printf("%d failures\n", failures);
  return failures != 0;
}
