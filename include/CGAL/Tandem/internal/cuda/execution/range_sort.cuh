// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sorts many short ranges of keys, such as the seeds of each cell. Runs of a fixed size are sorted in shared memory,
// then merged by pairs. An own sort, because the segmented sort of CUB waits for the device. Moves keys within their
// ranges only.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_RANGE_SORT_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_RANGE_SORT_CUH

#include <CGAL/Tandem/internal/cuda/execution/kernels.cuh>

#include <cub/block/block_merge_sort.cuh>

namespace CGAL {
namespace Tandem {
namespace internal {

// A run has four keys a lane. More lanes than in other kernels, since fewer are slower.
constexpr unsigned run_lanes = 1024;
constexpr unsigned keys_of_lane = 4;
constexpr std::uint32_t keys_of_run = run_lanes * keys_of_lane;

struct Less_key {
  __device__ bool operator()(std::uint64_t a, std::uint64_t b) const { return a < b; }
};

// Sorts one run: blockIdx.x is the range, blockIdx.y the run in it. Blocks beyond the end of a short range have no
// work. Places without a key are filled with the largest number, which sorts to the end. Real keys of that value are
// not lost, since equal keys are the same.
static __global__ void __launch_bounds__(run_lanes)
  sort_runs(const Range* range, const std::uint64_t* from, std::uint64_t* to)
{
  using Sort = cub::BlockMergeSort<std::uint64_t, run_lanes, keys_of_lane>;
  __shared__ typename Sort::TempStorage storage;
  const Range r = range[blockIdx.x];
  const std::uint32_t first = blockIdx.y * keys_of_run;
  if(first >= r.size())
    return;
  const std::uint32_t size = r.size() - first < keys_of_run ? r.size() - first : keys_of_run;
  from += r.first + first;
  to += r.first + first;
  // Neighboring lanes read neighboring keys, for wide loads; the order does not matter before the sort. After the sort,
  // lane t has the keys 4t to 4t + 3 of the run.
  std::uint64_t key[keys_of_lane];
  for(unsigned i = 0; i < keys_of_lane; ++i) {
    const std::uint32_t at = i * run_lanes + threadIdx.x;
    key[i] = at < size ? from[at] : ~std::uint64_t(0);
  }
  Sort(storage).Sort(key, Less_key());
  for(unsigned i = 0; i < keys_of_lane; ++i) {
    const std::uint32_t at = threadIdx.x * keys_of_lane + i;
    if(at < size)
      to[at] = key[i];
  }
}

// A body for each range: merges runs of `width` keys to runs of twice as many. Each key finds its place alone, by a
// binary search in the other run. Places are distinct: equal keys of the first run come before those of the second.
// Takes O(n log n) steps for n keys, without an exchange between lanes.
struct Merge_runs {
  const Range* range; // by body
  // Keys of all ranges, before and after: two different buffers.
  const std::uint64_t* from;
  std::uint64_t* to;
  std::uint32_t width; // of a run, but for the last one of a range

  template <class Block>
  __device__ void operator()(Block& block, unsigned char&, std::uint32_t c) const
  {
    const std::uint64_t* const keys = from + range[c].first;
    std::uint64_t* const merged = to + range[c].first;
    const std::uint32_t size = range[c].size();
    block.for_each(size, [&](std::uint32_t at) {
      const std::uint64_t key = keys[at];
      const std::uint32_t first = at / (2 * width) * (2 * width);
      const std::uint32_t middle = size - first < width ? size : first + width;
      const std::uint32_t last = size - middle < width ? size : middle + width;
      // A run without a second one stays where it is: then the other range is empty.
      const std::uint32_t place =
        at < middle ? partition_point(middle, last, [&](std::uint32_t i) { return keys[i] < key; }) - middle + at
                    : partition_point(first, middle, [&](std::uint32_t i) { return keys[i] <= key; }) - middle + at;
      merged[place] = key;
    });
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_RANGE_SORT_CUH
