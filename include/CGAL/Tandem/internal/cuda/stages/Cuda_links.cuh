// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sums of links, as the device makes them: see links.h.

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

// What is behind the sums comes last.
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

struct Count_ranks {
  const std::uint32_t* rank; // sorted
  std::uint32_t size, end;
  std::uint32_t* below; // end

  __device__ void operator()(std::size_t) const
  {
    *below = partition_point(0, size, [&](std::uint32_t i) { return rank[i] < end; });
  }
};

// By stable sorts; few of them are summed on the host.
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
  Device_buffer<std::int64_t> sums(1);
  with_cub_memory([&](void* memory, std::size_t& bytes) {
    return cub::DeviceReduce::ReduceByKey(memory, bytes, pair.Current(), pair.Alternate(), count.Current(),
                                          count.Alternate(), sums.data(), thrust::plus<std::uint32_t>(),
                                          std::int64_t(n), stream_of_thread());
  });
  Device_buffer<std::uint32_t> ranks[2] = {Device_buffer<std::uint32_t>(n), Device_buffer<std::uint32_t>(n)};
  Device_buffer<std::uint32_t> places[2] = {Device_buffer<std::uint32_t>(n), Device_buffer<std::uint32_t>(n)};
  backend.for_each(n, Rank_sums{sums.data(), count.Alternate(), ranks[0].data(), places[0].data()});
  cub::DoubleBuffer<std::uint32_t> rank(ranks[0].data(), ranks[1].data());
  cub::DoubleBuffer<std::uint32_t> place(places[0].data(), places[1].data());
  sort_pairs(rank, place, n, 32);
  Device_buffer<std::uint32_t> enough(1);
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
