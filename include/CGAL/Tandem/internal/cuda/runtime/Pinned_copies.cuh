// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Large tables travel through small pieces of pinned memory, which the threads of the host, several with
// oneTBB, fill or empty while others are copied.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_PINNED_COPIES_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_PINNED_COPIES_CUH

#include <CGAL/Tandem/internal/cuda/runtime/Device_buffer.cuh>
#include <CGAL/Tandem/internal/cuda/runtime/Host_side.h>
#include <CGAL/Tandem/internal/cuda/runtime/Pinned_memory.cuh>

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

// A stream for copies and an event for each of its two pieces.
struct Copy_stream {
  cudaStream_t stream = nullptr;
  cudaEvent_t copied[2] = {};

  // On the current device; cells nothing behind when it throws.
  void make()
  try {
    CGAL_TANDEM_CUDA(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking));
    for(cudaEvent_t& event : copied)
      CGAL_TANDEM_CUDA(cudaEventCreateWithFlags(&event, cudaEventDisableTiming));
  } catch(...) {
    destroy();
    throw;
  }

  void destroy()
  {
    for(cudaEvent_t event : copied)
      if(event != nullptr)
        static_cast<void>(cudaEventDestroy(event));
    if(stream != nullptr)
      static_cast<void>(cudaStreamDestroy(stream));
  }
};

// Of each device, kept for the next who needs one: threads that make them at the same time wait for each other, longer
// than for a copy.
class Copy_streams {
public:
  static Kept_items<Copy_stream>& of_device(int device)
  {
    std::lock_guard<std::mutex> lock(mutex());
    return all()[device];
  }

  // Destroys what no thread uses.
  static void release()
  {
    std::lock_guard<std::mutex> lock(mutex());
    for(auto& kept : all()) {
      const Device_guard guard(kept.first);
      for(Copy_stream copies; kept.second.take(copies);)
        copies.destroy();
    }
  }

private:
  // Not destroyed at the end of the program, when the runtime may be gone.
  static std::mutex& mutex()
  {
    static std::mutex& m = *new std::mutex;
    return m;
  }

  static std::map<int, Kept_items<Copy_stream>>& all()
  {
    static std::map<int, Kept_items<Copy_stream>>& a = *new std::map<int, Kept_items<Copy_stream>>;
    return a;
  }
};

// More do not copy faster.
constexpr std::size_t maximum_copying_threads = 16;

// Two pieces for one thread, on the current device: one is filled while the other one is copied.
class Pinned_pair {
public:
  static constexpr std::size_t bytes = Pinned_block::bytes / 2;

  Pinned_pair() : device_(current_device())
  {
    if(!Copy_streams::of_device(device_).take(copies_))
      copies_.make();
  }

  ~Pinned_pair()
  {
    static_cast<void>(cudaStreamSynchronize(copies_.stream));
    if(!Copy_streams::of_device(device_).give(copies_))
      copies_.destroy();
  }

  Pinned_pair(const Pinned_pair&) = delete;
  Pinned_pair& operator=(const Pinned_pair&) = delete;

  // The memory of the next piece, when its last copies have ended.
  char* next()
  {
    piece_ = 1 - piece_;
    CGAL_TANDEM_CUDA(cudaEventSynchronize(copies_.copied[piece_]));
    return block_.data() + piece_ * bytes;
  }

  // Of the copies.
  cudaStream_t stream() const { return copies_.stream; }

  // All that is to be copied from the piece has been asked for.
  void end_piece() { CGAL_TANDEM_CUDA(cudaEventRecord(copies_.copied[piece_], copies_.stream)); }

private:
  int device_;
  Pinned_block block_;
  Copy_stream copies_;
  std::size_t piece_ = 0;
};

// A table of the device that goes to the host.
struct Copy_to_host {
  const void* source;
  void* target;
  std::size_t bytes;
};

// On the threads of the host, which go on until nothing is left, so that one of them may do all of the work; throws
// what one of them has thrown. What has written the tables has ended; the stream of the thread is not waited for.
inline void empty_pinned_pieces(std::initializer_list<Copy_to_host> tables)
{
  constexpr std::size_t maximum = Pinned_pair::bytes / 2; // a piece is copied twice, one after the other
  std::vector<Copy_to_host> pieces;
  for(const Copy_to_host& table : tables)
    for(std::size_t first = 0; first < table.bytes; first += maximum)
      pieces.push_back({static_cast<const char*>(table.source) + first, static_cast<char*>(table.target) + first,
                        (std::min)(maximum, table.bytes - first)});
  const int device = current_device();
  std::atomic<std::size_t> next(0);
  Host_side().for_each_piece((std::min)(pieces.size(), maximum_copying_threads), 1, [&](std::size_t, std::size_t) {
    const Device_guard guard(device);
    Pinned_pair pair;
    for(std::size_t i; (i = next++) < pieces.size();) {
      const Copy_to_host& piece = pieces[i];
      char* const memory = pair.next();
      CGAL_TANDEM_CUDA(cudaMemcpyAsync(memory, piece.source, piece.bytes, cudaMemcpyDeviceToHost, pair.stream()));
      CGAL_TANDEM_CUDA(cudaStreamSynchronize(pair.stream()));
      std::memcpy(piece.target, memory, piece.bytes);
    }
  });
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_PINNED_COPIES_CUH
