// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Copies between host and device.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_COPY_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_COPY_CUH

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
#include <memory>
#include <mutex>
#include <new>
#include <vector>

namespace CGAL::Tandem::internal {

// --- Pinned memory of the host, which fast copies from and to a device need. To allocate it is slow, so blocks are kept.
// Large tables are copied through small pieces of it. Pageable memory would be copied by one thread of the driver. Here,
// threads of the host fill or empty pieces while other pieces are copied.

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
    std::lock_guard<std::mutex> lock(state().mutex);
    return state().kept[device];
  }

  // Destroys the streams that no thread uses.
  static void release()
  {
    std::lock_guard<std::mutex> lock(state().mutex);
    for(auto& kept : state().kept) {
      const Device_guard guard(kept.first);
      for(Copy_stream copies; kept.second.take(copies);)
        copies.destroy();
    }
  }

private:
  struct State {
    std::mutex mutex;
    std::map<int, Kept_items<Copy_stream>> kept; // by device
  };

  // Not destroyed at the end of the program, when the runtime may be gone.
  static State& state()
  {
    static State& s = *new State;
    return s;
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

// --- Copies in the order of the stream of the thread.

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

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_COPY_CUH
