// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The search for the k nearest neighbors on a CUDA device. The order of neighbors is total, so rows are those of
// find_neighbors() of the engine: see the manual, "Grid and Units". Most points are searched 32 at a time, the
// remaining ones one by one. Nothing here waits.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_CUDA_NEIGHBORS_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_CUDA_NEIGHBORS_CUH

#include <CGAL/Tandem/internal/cuda/neighbors/Neighbor_packet.cuh>
#include <CGAL/Tandem/internal/cuda/neighbors/Neighbor_query.cuh>
#include <CGAL/Tandem/internal/cuda/runtime/Loop_queue.cuh>

namespace CGAL::Tandem::internal {

constexpr int largest_packet_k = 20; // the largest K of find_packet_neighbors()
constexpr int largest_cuda_k = 64;   // two entries a lane
constexpr unsigned neighbor_lanes = 128;

// The rows of k neighbors of n points; pointers to memory of the current device that are aligned to 16 bytes.
struct Neighbor_rows {
  const Grid_point* point;
  std::uint32_t n;
  int k;
  std::uint32_t* neighbor;
};

// Divides the scratch: counters, deferred packets, deferred queries, boxes.
inline Neighbor_task make_neighbor_task(const Neighbor_rows& rows, void* scratch)
{
  Neighbor_task task;
  task.point = reinterpret_cast<const int4*>(rows.point);
  task.n = rows.n;
  task.k = rows.k;
  task.neighbor = rows.neighbor;
  task.counters = static_cast<Neighbor_counters*>(scratch);
  task.deferred = reinterpret_cast<Deferred_lanes*>(task.counters + 1);
  task.query = reinterpret_cast<std::uint32_t*>(task.deferred + task.packets());
  task.tree.shape(rows.n);
  task.tree.place(reinterpret_cast<std::int32_t*>(task.query + task.maximum_queries()));
  return task;
}

// The sum of these tables: 3.9 bytes a point.
inline std::size_t neighbor_scratch_bytes(std::uint32_t n)
{
  const std::size_t packets = n / warp_size + (n % warp_size != 0);
  Box_levels tree;
  return sizeof(Neighbor_counters) + packets * (sizeof(Deferred_lanes) + 4 * sizeof(std::uint32_t)) +
         tree.shape(n) * sizeof(std::int32_t);
}

// From the buckets up: a level needs the boxes of the one below.
inline void build_box_levels(const Neighbor_task& task, cudaStream_t stream)
{
  const auto blocks = [&](int level, std::size_t lanes_per_node) {
    const std::size_t nodes = std::size_t(Box_levels::parents(task.tree.count[level])) * warp_size;
    return unsigned((nodes * lanes_per_node + neighbor_lanes - 1) / neighbor_lanes);
  };
  fill_bucket_boxes<<<blocks(0, 1), neighbor_lanes, 0, stream>>>(task.point, task.n, task.tree);
  CGAL_TANDEM_CUDA_LAUNCHED();
  for(int level = 1; level < task.tree.levels; ++level) {
    join_boxes<<<blocks(level, warp_size), neighbor_lanes, 0, stream>>>(task.tree, level);
    CGAL_TANDEM_CUDA_LAUNCHED();
  }
}

// Rows of k <= K are the beginnings of rows of K, so few kernels serve all k.
inline void search_packets(const Neighbor_task& task, cudaStream_t stream)
{
  constexpr unsigned lanes = packets_in_block * warp_size;
  const unsigned blocks = (task.packets() + packets_in_block - 1) / packets_in_block;
  if(task.k <= 8)
    find_packet_neighbors<8><<<blocks, lanes, 0, stream>>>(task);
  else if(task.k <= 12)
    find_packet_neighbors<12><<<blocks, lanes, 0, stream>>>(task);
  else if(task.k <= 16)
    find_packet_neighbors<16><<<blocks, lanes, 0, stream>>>(task);
  else
    find_packet_neighbors<20><<<blocks, lanes, 0, stream>>>(task);
  CGAL_TANDEM_CUDA_LAUNCHED();
}

// Only the device knows how many queries were deferred. So the number of warps is fixed, and they take queries from the
// list. `all`: all points, because k is too large for packets.
inline void search_single(const Neighbor_task& task, bool all, cudaStream_t stream)
{
  constexpr std::size_t maximum_blocks = 12; // on a multiprocessor
  const unsigned blocks = unsigned(number_of_multiprocessors() * maximum_blocks);
  if(task.k <= int(warp_size))
    find_single_neighbors<1><<<blocks, neighbor_lanes, 0, stream>>>(task, all);
  else
    find_single_neighbors<2><<<blocks, neighbor_lanes, 0, stream>>>(task, all);
  CGAL_TANDEM_CUDA_LAUNCHED();
}

// As find_neighbors() of the engine, for 1 <= k <= 64. `scratch` has neighbor_scratch_bytes(n) bytes, aligned as the
// rows. Returns before the search has ended.
inline void find_neighbors_cuda(const Neighbor_rows& rows, void* scratch, cudaStream_t stream)
{
  static_assert(sizeof(Grid_point) == sizeof(int4), "points are read as int4");
  if(rows.n == 0)
    return;
  if(rows.k < 1 || rows.k > largest_cuda_k)
    throw std::invalid_argument("k is " + std::to_string(rows.k) + ", must be in [1, 64]");
  const Neighbor_task task = make_neighbor_task(rows, scratch);
  CGAL_TANDEM_CUDA(cudaMemsetAsync(task.counters, 0, sizeof(Neighbor_counters), stream));
  build_box_levels(task, stream);
  const bool has_packets = rows.k <= largest_packet_k;
  if(has_packets)
    search_packets(task, stream);
  search_single(task, !has_packets, stream);
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_CUDA_NEIGHBORS_CUH
