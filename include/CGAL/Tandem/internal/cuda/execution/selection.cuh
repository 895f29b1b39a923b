// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which items are kept, of few by two loops of the queue, of many by CUB.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_SELECTION_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_SELECTION_CUH

#include <CGAL/Tandem/internal/cuda/execution/cub_calls.cuh>
#include <CGAL/Tandem/internal/cuda/execution/loops.cuh>
#include <CGAL/Tandem/internal/cuda/runtime/Device_buffer.cuh>
#include <CGAL/Tandem/internal/cuda/runtime/copy.cuh>

#include <cub/device/device_select.cuh>
#include <thrust/iterator/counting_iterator.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// The i in [0, n) with is_kept(i), ascending; waits for their number, which the device writes to pinned memory.
template <class F>
std::size_t select_items(std::size_t n, F is_kept, std::uint32_t* kept)
{
  constexpr std::size_t items_of_queue = 65536;
  if(n == 0)
    return 0;
  auto* const size = reinterpret_cast<std::int64_t*>(Staging::of_thread().take(sizeof(std::int64_t)));
  if(n <= items_of_queue) {
    Device_buffer<std::uint32_t> bits((n + warp_size - 1) / warp_size);
    queue_loop(n, n, Test_loop<F>{is_kept, bits.data()});
    queue_loop(n, n, List_loop{bits.data(), kept, size});
  } else {
    const thrust::counting_iterator<std::uint32_t> all(0);
    with_cub_memory([&](void* memory, std::size_t& bytes) {
      return cub::DeviceSelect::If(memory, bytes, all, kept, size, std::int64_t(n), is_kept, stream_of_thread());
    });
  }
  synchronize();
  return std::size_t(*size);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_SELECTION_CUH
