// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Copies between host and device in the order of the stream of the thread.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_COPY_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_COPY_CUH

#include <CGAL/Tandem/internal/backend/Parallel_host.h>
#include <CGAL/Tandem/internal/cuda/runtime/Pinned_copies.cuh>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <new>

namespace CGAL {
namespace Tandem {
namespace internal {

// Pinned memory for copies of small tables. The source of a copy has to stay until the stream has come that far. So
// places are used again only after a synchronization. A staging belongs to one thread and one device: the thread has
// another stream on each device, and to wait for one does not end the copies of the other.
class Staging {
public:
  // That of this thread for its current device.
  static Staging& of_thread()
  {
    thread_local std::map<int, Staging> stagings;
    return stagings[current_device()];
  }

  Staging() : device_(current_device()) {}
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  // After an exception, copies may still be running.
  ~Staging()
  {
    const Device_guard guard(device_, std::nothrow);
    wait_quietly();
  }

  // So many bytes, at most Pinned_block::bytes, for one copy. Waits for the stream if the block is full.
  char* take(std::size_t bytes)
  {
    if(block_ == nullptr)
      block_ = std::make_unique<Pinned_block>();
    if(used_ + bytes > Pinned_block::bytes)
      synchronize();
    char* const memory = block_->data() + used_;
    used_ += (bytes + 63) / 64 * 64;
    Device_work::of_thread().bytes_copied += bytes;
    return memory;
  }

  // Waits for the stream. All copies have ended then, so all of the block is free again.
  void synchronize()
  {
    wait_for_stream();
    used_ = 0;
  }

private:
  int device_;
  std::unique_ptr<Pinned_block> block_;
  std::size_t used_ = 0;
};

// Waits until all work that this thread has queued is done.
inline void synchronize() { Staging::of_thread().synchronize(); }

// target[i] = f(i) for i in [0, n), where f is evaluated on the host. The items are made in pinned memory, and are on
// their way when this returns. Waits where that memory is full.
template <class T, class F>
void make_on_device(std::size_t n, F f, T* target)
{
  constexpr std::size_t maximum = Pinned_block::bytes / 2 / sizeof(T);
  for(std::size_t first = 0; first < n; first += maximum) {
    const std::size_t size = (std::min)(maximum, n - first);
    T* const piece = reinterpret_cast<T*>(Staging::of_thread().take(size * sizeof(T)));
    Parallel_host().for_each_on_host(
      size, [&](std::size_t i) { new(piece + i) T(f(first + i)); }, 4096);
    CGAL_TANDEM_CUDA(
      cudaMemcpyAsync(target + first, piece, size * sizeof(T), cudaMemcpyHostToDevice, stream_of_thread()));
  }
}

// Waits for the items. Large tables are copied by several threads, after the stream has come to an end.
template <class T>
void copy_to_host(const T* source, std::size_t n, T* target)
{
  if(n == 0)
    return synchronize();
  const std::size_t bytes = n * sizeof(T);
  if(bytes > Pinned_block::bytes) {
    synchronize();
    return empty_pinned_pieces({{source, target, bytes}});
  }
  char* const memory = Staging::of_thread().take(bytes);
  CGAL_TANDEM_CUDA(cudaMemcpyAsync(memory, source, bytes, cudaMemcpyDeviceToHost, stream_of_thread()));
  synchronize();
  std::memcpy(target, memory, bytes);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_COPY_CUH
