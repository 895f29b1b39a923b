// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Copies of large tables through small pieces of pinned memory. Pageable memory would be copied by one thread of the
// driver. Here, threads of the host fill or empty pieces while other pieces are copied.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_PINNED_COPIES_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_PINNED_COPIES_CUH

#include <CGAL/Tandem/internal/backend/Parallel_host.h>
#include <CGAL/Tandem/internal/cuda/runtime/Device_buffer.cuh>
#include <CGAL/Tandem/internal/cuda/runtime/cuda_check.cuh>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <map>
#include <mutex>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// --- Pinned memory of the host, which fast copies from and to a device need. To allocate it is slow, so blocks are kept.

// Items that are slow to make, kept for the next thread that needs one.
template <class T>
class Kept_items {
public:
  // False if none is kept.
  bool take(T& item)
  {
    std::lock_guard<std::mutex> lock(mutex_);
    if(items_.empty())
      return false;
    item = items_.back();
    items_.pop_back();
    return true;
  }

  // False if there is no memory to keep it; the caller then destroys the item.
  bool put(T item) noexcept
  try {
    std::lock_guard<std::mutex> lock(mutex_);
    items_.push_back(item);
    return true;
  } catch(const std::exception&) {
    return false;
  }

  // Drops the items without destroying them.
  void clear()
  {
    std::lock_guard<std::mutex> lock(mutex_);
    items_.clear();
  }

private:
  std::mutex mutex_;
  std::vector<T> items_;
};

// One block of a fixed size, from those that are kept. All devices may use it (portable).
class Pinned_block {
public:
  static constexpr std::size_t bytes = std::size_t(4) << 20;

  Pinned_block()
  {
    if(kept().take(memory_))
      return;
    void* memory = nullptr;
    CGAL_TANDEM_CUDA(cudaHostAlloc(&memory, bytes, cudaHostAllocPortable));
    memory_ = static_cast<char*>(memory);
  }

  ~Pinned_block()
  {
    if(!kept().put(memory_))
      static_cast<void>(cudaFreeHost(memory_));
  }

  Pinned_block(const Pinned_block&) = delete;
  Pinned_block& operator=(const Pinned_block&) = delete;

  char* data() { return memory_; }

  // Frees the blocks that no thread uses.
  static void release()
  {
    for(char* memory; kept().take(memory);)
      CGAL_TANDEM_CUDA(cudaFreeHost(memory));
  }

private:
  // Not destroyed at the end of the program, when the runtime may be gone.
  static Kept_items<char*>& kept()
  {
    static Kept_items<char*>& k = *new Kept_items<char*>;
    return k;
  }

  char* memory_ = nullptr;
};

// A stream for copies, with an event for each of the two pieces of a pair.
struct Copy_stream {
  cudaStream_t stream = nullptr;
  cudaEvent_t copied[2] = {};

  // On the current device. Destroys what it has made when it throws.
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

// Streams of each device, kept for the next pair. Threads that create streams at the same time wait for each other,
// longer than a copy takes.
class Copy_streams {
public:
  static Kept_items<Copy_stream>& of_device(int device)
  {
    std::lock_guard<std::mutex> lock(mutex());
    return all()[device];
  }

  // Destroys the streams that no thread uses.
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

// More threads do not copy faster.
constexpr std::size_t maximum_copying_threads = 16;

// Two pieces for one thread, on the current device: one is filled while the other one is copied. Other sizes are
// no faster.
class Pinned_pair {
public:
  static constexpr std::size_t bytes = Pinned_block::bytes / 2;

  Pinned_pair() : device_(current_device())
  {
    if(!Copy_streams::of_device(device_).take(copies_))
      copies_.make();
  }

  // Waits for its copies, since the memory goes to the next pair.
  ~Pinned_pair()
  {
    static_cast<void>(cudaStreamSynchronize(copies_.stream));
    if(!Copy_streams::of_device(device_).put(copies_))
      copies_.destroy();
  }

  Pinned_pair(const Pinned_pair&) = delete;
  Pinned_pair& operator=(const Pinned_pair&) = delete;

  // The memory of the other piece, after its last copies have ended.
  char* next()
  {
    piece_ = 1 - piece_;
    CGAL_TANDEM_CUDA(cudaEventSynchronize(copies_.copied[piece_]));
    return block_.data() + piece_ * bytes;
  }

  // The copies of both pieces belong here.
  cudaStream_t stream() const { return copies_.stream; }

  // After the last copy from the current piece has been queued.
  void end_piece() { CGAL_TANDEM_CUDA(cudaEventRecord(copies_.copied[piece_], copies_.stream)); }

private:
  int device_;
  Pinned_block block_;
  Copy_stream copies_;
  std::size_t piece_ = 0;
};

// A table of the device and its place on the host.
struct Copy_to_host {
  const void* source;
  void* target;
  std::size_t bytes;
};

// Copies tables to the host, by the threads of the host. Each takes pieces until none is left, so one thread alone
// would copy all. The kernels that wrote the tables must have ended: these copies do not wait for the stream of the
// thread. Throws an exception that one of the threads has thrown.
inline void empty_pinned_pieces(std::initializer_list<Copy_to_host> tables)
{
  constexpr std::size_t maximum = Pinned_pair::bytes / 2; // small, since its two copies follow each other
  std::vector<Copy_to_host> pieces;
  for(const Copy_to_host& table : tables) {
    Device_work::of_thread().bytes_copied += table.bytes;
    for(std::size_t first = 0; first < table.bytes; first += maximum)
      pieces.push_back({static_cast<const char*>(table.source) + first, static_cast<char*>(table.target) + first,
                        (std::min)(maximum, table.bytes - first)});
  }
  ++Device_work::of_thread().waits;
  const int device = current_device();
  std::atomic<std::size_t> next(0);
  Parallel_host().for_each_piece((std::min)(pieces.size(), maximum_copying_threads), 1, [&](std::size_t, std::size_t) {
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
