// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sums of links by pair of shapes, on the device. The list is defined by its contents and order, so it is the one of
// sum_links_on_host(): see shapes/links.h. Changes nothing else.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_STAGES_CUDA_LINKS_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_STAGES_CUDA_LINKS_CUH

#include <CGAL/Tandem/internal/cuda/execution/Cuda_backend.cuh>
#include <CGAL/Tandem/internal/shapes/links.h>

#include <cub/device/device_reduce.cuh>
#include <thrust/functional.h>

#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Keys for the sort by pair. Both ids take `bits` bits, so that the radix sort has fewer passes.
struct Split_links {
  const Link* link;
  int bits; // of an id
  std::uint64_t* pair;
  std::uint32_t* count;

  __device__ void operator()(std::size_t i) const
  {
    pair[i] = link[i].pair >> 32 << bits | std::uint32_t(link[i].pair);
    count[i] = link[i].count;
  }
};

// Keys for the sort by number of relations, largest first: the complement of the sum. Places behind the *size sums get
// the largest key, so they come last.
struct Rank_sums {
  const std::int64_t* size;
  const std::uint32_t* sum;
  std::uint32_t* rank; // most relations first
  std::uint32_t* place;

  __device__ void operator()(std::size_t i) const
  {
    rank[i] = std::int64_t(i) < *size ? ~sum[i] : ~0u;
    place[i] = std::uint32_t(i);
  }
};

// Back to links, in the order of the ranks.
struct Join_links {
  const std::uint64_t* pair;
  const std::uint32_t* rank;
  const std::uint32_t* place;
  int bits;
  Link* link;

  __device__ void operator()(std::size_t i) const
  {
    const std::uint64_t ids = pair[place[i]];
    link[i] = {ids >> bits << 32 | (ids & ((std::uint64_t(1) << bits) - 1)), ~rank[i]};
  }
};

// How many links have enough relations: their ranks are below `end`. Executed for one item.
struct Count_ranks {
  const std::uint32_t* rank; // sorted
  std::uint32_t size, end;
  std::uint32_t* below; // one number

  __device__ void operator()(std::size_t) const
  {
    *below = partition_point(0, size, [&](std::uint32_t i) { return rank[i] < end; });
  }
};

// Sort by pair, sum equal pairs, then sort by falling sum. Stable sorts keep links of equal sums in the order of their
// ids. Only links that are kept go to the host. Few links are summed on the host, because the launches would take
// longer.
inline Link_list sum_links_cuda(Cuda_backend& backend, const Link* source, std::size_t n, std::size_t ids,
                                std::uint32_t minimum)
{
  constexpr std::size_t few = 4096;
  if(n < few)
    return sum_links_on_host(backend, source, n, minimum);
  const int bits = bits_of(ids);
  Device_buffer<std::uint64_t> pairs[2] = {Device_buffer<std::uint64_t>(n), Device_buffer<std::uint64_t>(n)};
  Device_buffer<std::uint32_t> counts[2] = {Device_buffer<std::uint32_t>(n), Device_buffer<std::uint32_t>(n)};
  backend.for_each(n, Split_links{source, bits, pairs[0].data(), counts[0].data()});
  cub::DoubleBuffer<std::uint64_t> pair(pairs[0].data(), pairs[1].data());
  cub::DoubleBuffer<std::uint32_t> count(counts[0].data(), counts[1].data());
  sort_pairs(pair, count, n, 2 * bits);
  // Links of one pair are adjacent now. The number of different pairs stays on the device, so nothing waits for it.
  Device_buffer<std::int64_t> sums(1);
  with_cub_memory([&](void* memory, std::size_t& bytes) {
    return cub::DeviceReduce::ReduceByKey(memory, bytes, pair.Current(), pair.Alternate(), count.Current(),
                                          count.Alternate(), sums.data(), thrust::plus<std::uint32_t>(),
                                          std::int64_t(n), stream_of_thread());
  });
  // Ranks are sorted with the places of their sums, so that pairs need not move.
  Device_buffer<std::uint32_t> ranks[2] = {Device_buffer<std::uint32_t>(n), Device_buffer<std::uint32_t>(n)};
  Device_buffer<std::uint32_t> places[2] = {Device_buffer<std::uint32_t>(n), Device_buffer<std::uint32_t>(n)};
  backend.for_each(n, Rank_sums{sums.data(), count.Alternate(), ranks[0].data(), places[0].data()});
  cub::DoubleBuffer<std::uint32_t> rank(ranks[0].data(), ranks[1].data());
  cub::DoubleBuffer<std::uint32_t> place(places[0].data(), places[1].data());
  sort_pairs(rank, place, n, 32);
  Device_buffer<std::uint32_t> enough(1);
  // Sums of at least `minimum` have a rank of at most ~minimum.
  backend.for_each(1, Count_ranks{rank.Current(), std::uint32_t(n), ~minimum + 1, enough.data()});
  Device_buffer<Link> sorted(n);
  backend.for_each(n, Join_links{pair.Alternate(), rank.Current(), place.Current(), bits, sorted.data()});
  std::uint32_t size = 0;
  backend.to_host(enough.data(), 1, &size);
  Link_list links(size);
  backend.to_host(sorted.data(), size, links.data());
  return links;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_STAGES_CUDA_LINKS_CUH
