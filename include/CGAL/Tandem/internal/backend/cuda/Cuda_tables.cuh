// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tables of the size of the cloud at both ends, as the device makes them. Both are
// defined without reference to it.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_CUDA_CUDA_TABLES_CUH
#define CGAL_TANDEM_INTERNAL_BACKEND_CUDA_CUDA_TABLES_CUH

#include <CGAL/Tandem/internal/Engine_result.h>
#include <CGAL/Tandem/internal/Import.h>
#include <CGAL/Tandem/internal/backend/cuda/Cuda_backend.cuh>
#include <CGAL/Tandem/internal/backend/cuda/Pinned_ring.cuh>

namespace CGAL {
namespace Tandem {
namespace internal {

// The values of the caller travel as they are, a piece at a time.
inline Device_buffer<Grid_point> import_points(Cuda_backend&, const Import& in)
{
  const std::size_t n = in.size(), vector = in.coordinates.vector_bytes();
  const std::size_t piece = Pinned_pair::bytes / in.value_bytes();
  const Place_on_grid all = place_on_grid(in, nullptr);
  Device_buffer<Grid_point> point(n);
  std::atomic<std::size_t> next(0);
  run_on_host_threads((n + piece - 1) / piece, [&](Pinned_pair& pair) {
    Device_buffer<char> values(Pinned_pair::bytes);
    for(std::size_t first; (first = piece * next++) < n;) {
      const std::size_t size = (std::min)(piece, n - first);
      char* const memory = static_cast<char*>(pair.next());
      Place_on_grid place = all;
      place.point = point.data() + first;
      place.coordinates.data = values.data();
      std::memcpy(memory, static_cast<const char*>(all.coordinates.data) + first * vector, size * vector);
      if(in.has_normals) {
        place.normals.data = values.data() + size * vector;
        std::memcpy(memory + size * vector, static_cast<const char*>(all.normals.data) + first * vector, size * vector);
      }
      pair.copy(values.data(), size * in.value_bytes());
      run_items<<<unsigned((size + item_lanes - 1) / item_lanes), item_lanes, 0, stream_of_thread()>>>(size, place);
      CGAL_TANDEM_CUDA_LAUNCHED();
    }
  });
  return point;
}

struct Write_pairs {
  const std::int32_t* shape_of;
  std::uint32_t* key;
  std::uint32_t* position;

  __device__ void operator()(std::size_t i) const
  {
    key[i] = std::uint32_t(shape_of[i]); // the bits of -1 are the largest
    position[i] = std::uint32_t(i);
  }
};

struct Find_first {
  const std::uint32_t* key;
  std::uint32_t size;
  std::uint32_t* first; // of each shape

  __device__ void operator()(std::size_t s) const
  {
    first[s] = partition_point(0, size, [&](std::uint32_t i) { return key[i] < s; });
  }
};

// By a stable sort.
inline Point_groups group_points(Cuda_backend& backend, const std::int32_t* shape_of, std::size_t n, std::size_t shapes)
{
  Device_buffer<std::uint32_t> keys[2] = {Device_buffer<std::uint32_t>(n), Device_buffer<std::uint32_t>(n)};
  Device_buffer<std::uint32_t> positions[2] = {Device_buffer<std::uint32_t>(n), Device_buffer<std::uint32_t>(n)};
  backend.for_each(n, Write_pairs{shape_of, keys[0].data(), positions[0].data()});
  int bits = 1;
  while(shapes >> bits)
    ++bits;
  cub::DoubleBuffer<std::uint32_t> key(keys[0].data(), keys[1].data());
  cub::DoubleBuffer<std::uint32_t> position(positions[0].data(), positions[1].data());
  std::size_t bytes = 0;
  const auto sort = [&](void* memory) {
    CGAL_TANDEM_CUDA(
      cub::DeviceRadixSort::SortPairs(memory, bytes, key, position, std::int64_t(n), 0, bits, stream_of_thread()));
  };
  sort(nullptr);
  Device_buffer<unsigned char> memory(bytes + 1);
  sort(memory.data());
  std::vector<std::uint32_t> first(shapes + 1);
  Device_buffer<std::uint32_t> found(shapes + 1);
  backend.for_each(shapes + 1, Find_first{key.Current(), std::uint32_t(n), found.data()});
  backend.to_host(found.data(), first.size(), first.data());
  Host_buffer<std::uint32_t> grouped(first.back());
  backend.to_host(position.Current(), grouped.size(), grouped.data());
  return {std::vector<std::size_t>(first.begin(), first.end()), std::move(grouped)};
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_CUDA_CUDA_TABLES_CUH
