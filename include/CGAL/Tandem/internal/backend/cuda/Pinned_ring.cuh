// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Large tables travel through small pieces of pinned memory, which the threads of the host, several with
// oneTBB, fill or empty while others are copied.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_CUDA_PINNED_RING_CUH
#define CGAL_TANDEM_INTERNAL_BACKEND_CUDA_PINNED_RING_CUH

#include <CGAL/Tandem/internal/backend/cuda/Device_buffer.cuh>
#include <CGAL/Tandem/internal/backend/cuda/Host_side.h>
#include <CGAL/Tandem/internal/backend/cuda/Pinned_memory.cuh>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <map>
#include <mutex>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// On the current device. Waits at its end for what it has recorded.
class Event {
public:
  Event() : device_(current_device())
  {
    if(!kept(device_).take(event_))
      CGAL_TANDEM_CUDA(cudaEventCreateWithFlags(&event_, cudaEventDisableTiming));
  }

  ~Event()
  {
    static_cast<void>(cudaEventSynchronize(event_));
    kept(device_).give(event_);
  }

  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;

  void record() { CGAL_TANDEM_CUDA(cudaEventRecord(event_, stream_of_thread())); }
  void wait() { CGAL_TANDEM_CUDA(cudaEventSynchronize(event_)); }

private:
  // Threads that make events at the same time wait for each other, longer than for a copy.
  static Kept_items<cudaEvent_t>& kept(int device)
  {
    static std::mutex& mutex = *new std::mutex;
    static std::map<int, Kept_items<cudaEvent_t>>& all = *new std::map<int, Kept_items<cudaEvent_t>>;
    std::lock_guard<std::mutex> lock(mutex);
    return all[device];
  }

  int device_;
  cudaEvent_t event_ = nullptr;
};

// Two pieces for one thread: one is filled while the other one is copied.
class Pinned_pair {
public:
  static constexpr std::size_t bytes = Pinned_block::bytes / 2;

  // The memory of the next piece, when its last copies have ended.
  char* next()
  {
    piece_ = 1 - piece_;
    copied_[piece_].wait();
    return block_.data() + piece_ * bytes;
  }

  // All that is to be copied from the piece has been asked for.
  void close() { copied_[piece_].record(); }

private:
  Pinned_block block_; // outlives the events, which wait for the copies from it
  Event copied_[2];
  std::size_t piece_ = 0;
};

// Runs work(pair) on the threads of the host, with the device of the caller and what its stream has done; throws
// what one of them has thrown. Each goes on until nothing is left, so that one of them may do all of the work.
template <class Work>
void run_on_host_threads(std::size_t pieces, Work work)
{
  constexpr std::size_t most_threads = 16;
  const int device = current_device();
  CGAL_TANDEM_CUDA(cudaStreamSynchronize(stream_of_thread()));
  Host_side().for_each_piece((std::min)(pieces, most_threads), 1, [&](std::size_t, std::size_t) {
    const Device_guard guard(device);
    Pinned_pair pair;
    work(pair);
    CGAL_TANDEM_CUDA(cudaStreamSynchronize(stream_of_thread()));
  });
}

// A table of the device that goes to the host.
struct Copy_to_host {
  const void* source;
  void* target;
  std::size_t bytes;
};

inline void empty_pinned_pieces(std::initializer_list<Copy_to_host> tables)
{
  constexpr std::size_t most = Pinned_pair::bytes / 2; // a piece is copied twice, one after the other
  std::vector<Copy_to_host> pieces;
  for(const Copy_to_host& table : tables)
    for(std::size_t first = 0; first < table.bytes; first += most)
      pieces.push_back({static_cast<const char*>(table.source) + first, static_cast<char*>(table.target) + first,
                        (std::min)(most, table.bytes - first)});
  std::atomic<std::size_t> next(0);
  run_on_host_threads(pieces.size(), [&](Pinned_pair& pair) {
    for(std::size_t i; (i = next++) < pieces.size();) {
      const Copy_to_host& piece = pieces[i];
      char* const memory = pair.next();
      CGAL_TANDEM_CUDA(cudaMemcpyAsync(memory, piece.source, piece.bytes, cudaMemcpyDeviceToHost, stream_of_thread()));
      CGAL_TANDEM_CUDA(cudaStreamSynchronize(stream_of_thread()));
      std::memcpy(piece.target, memory, piece.bytes);
    }
  });
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_CUDA_PINNED_RING_CUH
