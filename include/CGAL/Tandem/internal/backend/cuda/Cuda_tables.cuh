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

#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <mutex>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// The caller's values, as they are. Threads may send them a piece at a time.
struct Values_on_device {
  Values_on_device(const Vector_table& coordinates, const Vector_table& normals, std::size_t n)
    : device(current_device()), vector_bytes(coordinates.vector_bytes()), source{coordinates.view(), normals.view()},
      value{Device_buffer<char>(n * vector_bytes), Device_buffer<char>(normals.view().data ? n * vector_bytes : 0)}
  {
    CGAL_TANDEM_CUDA(cudaStreamSynchronize(stream_of_thread())); // other threads use the memory
  }

  // Through `pair`, on the stream of the thread.
  void send(std::size_t first, std::size_t last, Pinned_pair& pair)
  {
    const std::size_t tables = source[1].data != nullptr ? 2 : 1;
    const std::size_t most = Pinned_pair::bytes / (tables * vector_bytes);
    for(std::size_t i = first; i < last; i += most) {
      const std::size_t bytes = (std::min)(most, last - i) * vector_bytes;
      char* memory = pair.next();
      for(std::size_t t = 0; t < tables; ++t, memory += bytes) {
        std::memcpy(memory, static_cast<const char*>(source[t].data) + i * vector_bytes, bytes);
        CGAL_TANDEM_CUDA(cudaMemcpyAsync(value[t].data() + i * vector_bytes, memory, bytes, cudaMemcpyHostToDevice,
                                         stream_of_thread()));
      }
      pair.close();
    }
  }

  std::unique_ptr<Pinned_pair> take_pair()
  {
    std::lock_guard<std::mutex> lock(mutex);
    if(pairs.empty())
      return std::make_unique<Pinned_pair>();
    std::unique_ptr<Pinned_pair> pair = std::move(pairs.back());
    pairs.pop_back();
    return pair;
  }

  void give_back(std::unique_ptr<Pinned_pair> pair)
  {
    std::lock_guard<std::mutex> lock(mutex);
    pairs.push_back(std::move(pair));
  }

  int device;
  std::size_t vector_bytes;
  Vectors_view source[2]; // coordinates and normals, on the host
  Device_buffer<char> value[2];
  std::vector<std::unique_ptr<Pinned_pair>> pairs; // that no thread uses, while they are read
  std::mutex mutex;
  std::atomic<bool> has_failed{false}; // to send some of them
};

inline std::shared_ptr<Values_on_device> send_values(const Import& in)
{
  constexpr std::size_t piece = 65536;
  auto values = std::make_shared<Values_on_device>(in.coordinates, in.normals, in.size());
  std::atomic<std::size_t> next(0);
  run_on_host_threads((in.size() + piece - 1) / piece, [&](Pinned_pair& pair) {
    for(std::size_t first; (first = piece * next++) < in.size();)
      values->send(first, (std::min)(first + piece, in.size()), pair);
  });
  return values;
}

inline Device_buffer<Grid_point> import_points(Cuda_backend& backend, const Import& in)
{
  Device_buffer<Grid_point> point(in.size());
  const auto values = in.uploaded ? std::static_pointer_cast<Values_on_device>(in.uploaded) : send_values(in);
  Place_on_grid place = place_on_grid(in, point.data());
  place.coordinates.data = values->value[0].data();
  place.normals.data = values->value[1].data();
  backend.for_each(in.size(), place);
  for(Device_buffer<char>& value : values->value)
    value.release();
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
inline void take_points(Cuda_backend& backend, Device_buffer<std::int32_t>&& shape_of, std::size_t shapes,
                        Engine_result& result)
{
  const std::size_t n = shape_of.size();
  Device_buffer<std::uint32_t> keys[2] = {Device_buffer<std::uint32_t>(n), Device_buffer<std::uint32_t>(n)};
  Device_buffer<std::uint32_t> positions[2] = {Device_buffer<std::uint32_t>(n), Device_buffer<std::uint32_t>(n)};
  backend.for_each(n, Write_pairs{shape_of.data(), keys[0].data(), positions[0].data()});
  cub::DoubleBuffer<std::uint32_t> key(keys[0].data(), keys[1].data());
  cub::DoubleBuffer<std::uint32_t> position(positions[0].data(), positions[1].data());
  sort_pairs(key, position, n, bits_of(shapes));
  std::vector<std::uint32_t> first(shapes + 1);
  Device_buffer<std::uint32_t> found(shapes + 1);
  backend.for_each(shapes + 1, Find_first{key.Current(), std::uint32_t(n), found.data()});
  backend.to_host(found.data(), first.size(), first.data());
  Host_buffer<std::uint32_t> grouped(first.back());
  Host_buffer<std::int32_t> table(n);
  grouped.keep_pages();
  table.keep_pages();
  empty_pinned_pieces({{position.Current(), grouped.data(), grouped.size() * sizeof(std::uint32_t)},
                       {shape_of.data(), table.data(), n * sizeof(std::int32_t)}});
  result.points = {std::vector<std::size_t>(first.begin(), first.end()), std::move(grouped)};
  result.shape_of = std::move(table);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_CUDA_CUDA_TABLES_CUH
