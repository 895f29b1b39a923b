// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory of the device, from a pool that keeps freed memory between calls. Allocations, kernels and copies of a host
// thread are in the order of its stream, so threads do not wait for each other.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_DEVICE_BUFFER_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_DEVICE_BUFFER_CUH

#include <CGAL/Tandem/internal/cuda/runtime/Loop_queue.cuh>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <map>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- Small blocks of device memory that a host thread has freed and may use again at once: calls of the pool for them take
// as long as what is done with them. All work of a thread is in the order of its stream, so a block may still be in use
// by what was queued before.

// The blocks of a thread, by device and size.
class Kept_blocks {
public:
  // Sizes are powers of two; larger ones than the last are not kept.
  static constexpr std::size_t smallest = std::size_t(1) << 8, largest = std::size_t(1) << 21;
  static constexpr std::size_t maximum_bytes = std::size_t(32) << 20; // of one thread on one device

  // The size of a block for so many bytes.
  static std::size_t size_for(std::size_t bytes)
  {
    std::size_t size = smallest;
    while(size < bytes)
      size *= 2;
    return bytes <= largest ? size : bytes;
  }

  // A block of this size on the current device, or null.
  static void* take(std::size_t size)
  {
    if(size > largest || state() == State::ended)
      return nullptr;
    Blocks& blocks = of_thread().blocks_[current_device()];
    std::vector<void*>& kept = blocks.kept[place(size)];
    if(kept.empty())
      return nullptr;
    void* const memory = kept.back();
    kept.pop_back();
    blocks.bytes -= size;
    return memory;
  }

  // False if it is not kept.
  static bool put(void* memory, std::size_t size) noexcept
  try {
    if(size > largest || state() == State::ended)
      return false;
    Blocks& blocks = of_thread().blocks_[current_device()];
    if(blocks.bytes + size > maximum_bytes)
      return false;
    blocks.kept[place(size)].push_back(memory);
    blocks.bytes += size;
    return true;
  } catch(const std::exception&) {
    return false;
  }

  // Returns the blocks of this thread to their pools.
  static void release()
  {
    if(state() != State::ended)
      of_thread().free_all();
  }

  Kept_blocks() = default;
  Kept_blocks(const Kept_blocks&) = delete;
  Kept_blocks& operator=(const Kept_blocks&) = delete;

  ~Kept_blocks()
  {
    free_all();
    state() = State::ended;
  }

private:
  static constexpr std::size_t sizes = 14;
  static_assert(smallest << (sizes - 1) == largest, "a list for each size");

  struct Blocks {
    std::vector<void*> kept[sizes];
    std::size_t bytes = 0;
  };

  // Of the blocks of the thread. Buffers of static objects end after them.
  enum class State { running, ended };
  static State& state()
  {
    thread_local State s = State::running;
    return s;
  }

  static Kept_blocks& of_thread()
  {
    thread_local Kept_blocks blocks;
    return blocks;
  }

  static std::size_t place(std::size_t size)
  {
    std::size_t result = 0;
    while(smallest << result < size)
      ++result;
    return result;
  }

  void free_all() noexcept
  try {
    for(auto& blocks : blocks_) {
      const Device_guard guard(blocks.first);
      Loop_queue::of_thread().launch_quietly();
      for(std::vector<void*>& kept : blocks.second.kept) {
        for(void* const memory : kept)
          static_cast<void>(cudaFreeAsync(memory, cudaStreamPerThread));
        kept.clear();
      }
      blocks.second.bytes = 0;
    }
  } catch(const std::exception&) { // the device has failed, and its memory is gone
    blocks_.clear();
  }

  std::map<int, Blocks> blocks_;
};

// A pool for each device, made at its first use. Not the default pools: their settings belong to the caller.
class Memory_pools {
public:
  static cudaMemPool_t of_device(int device)
  {
    std::lock_guard<std::mutex> lock(state().mutex);
    const auto found = state().pools.find(device);
    return found != state().pools.end() ? found->second : state().pools[device] = make(device);
  }

  // Returns unused memory to the devices, but for blocks that other threads keep. The lock is not held meanwhile, since
  // this waits for all work of the devices.
  static void trim()
  {
    Kept_blocks::release();
    std::unique_lock<std::mutex> lock(state().mutex);
    const std::map<int, cudaMemPool_t> all = state().pools;
    lock.unlock();
    for(const auto& pool : all) {
      const Device_guard guard(pool.first);
      CGAL_TANDEM_CUDA(cudaDeviceSynchronize()); // frees that are queued take effect
      CGAL_TANDEM_CUDA(cudaMemPoolTrimTo(pool.second, 0));
    }
  }

private:
  // The pool keeps all freed memory for later calls; release_cuda_memory() returns it.
  static cudaMemPool_t make(int device)
  {
    cudaMemPoolProps properties = {};
    properties.allocType = cudaMemAllocationTypePinned;
    properties.handleTypes = cudaMemHandleTypeNone;
    properties.location.type = cudaMemLocationTypeDevice;
    properties.location.id = device;
    cudaMemPool_t pool;
    CGAL_TANDEM_CUDA(cudaMemPoolCreate(&pool, &properties));
    std::uint64_t keep = ~std::uint64_t(0);
    CGAL_TANDEM_CUDA(cudaMemPoolSetAttribute(pool, cudaMemPoolAttrReleaseThreshold, &keep));
    return pool;
  }

  struct State {
    std::mutex mutex;
    std::map<int, cudaMemPool_t> pools; // by device
  };

  // Not destroyed at the end of the program: destructors of static objects may still free memory.
  static State& state()
  {
    static State& s = *new State;
    return s;
  }
};

// An array of plain items on the device, without initial values. It has the interface of Host_buffer without access to
// single items. Belongs to the stream of the thread that makes it: another thread may use it only after the first one
// has waited.
template <class T>
class Device_buffer {
  static_assert(std::is_trivially_destructible<T>::value, "buffers hold plain data");

public:
  Device_buffer() = default;
  explicit Device_buffer(std::size_t size) { allocate(size); }
  Device_buffer(Device_buffer&& other) noexcept { swap(other); }

  Device_buffer& operator=(Device_buffer&& other) noexcept
  {
    Device_buffer(std::move(other)).swap(*this);
    return *this;
  }

  ~Device_buffer() { release(); }

  // Discards the contents.
  void reset(std::size_t size)
  {
    release();
    allocate(size);
  }

  // Keeps the first items, and the memory of all.
  void shrink(std::size_t size) { size_ = size; }

  // In the order of the stream: kernels that were launched before may still use the memory.
  void release()
  {
    if(data_ != nullptr && !Kept_blocks::put(data_, bytes_))
      free();
    data_ = nullptr;
    size_ = bytes_ = 0;
  }

  void swap(Device_buffer& other) noexcept
  {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(bytes_, other.bytes_);
  }

  T* data() { return data_; }
  const T* data() const { return data_; }
  std::size_t size() const { return size_; }

private:
  void allocate(std::size_t size)
  {
    // The pool joins freed blocks only after the stream has come to where they were freed. So waiting before large
    // requests saves memory, which the largest clouds need.
    constexpr std::size_t large = std::size_t(256) << 20;
    const std::size_t bytes = size > 0 ? Kept_blocks::size_for(size * sizeof(T)) : 0;
    void* memory = nullptr;
    if(bytes >= large)
      wait_for_stream();
    // Loops that wait to be launched do not use new memory, so this is in their order, too.
    if(bytes > 0 && (memory = Kept_blocks::take(bytes)) == nullptr)
      CGAL_TANDEM_CUDA(
        cudaMallocFromPoolAsync(&memory, bytes, Memory_pools::of_device(current_device()), cudaStreamPerThread));
    data_ = static_cast<T*>(memory);
    size_ = size;
    bytes_ = bytes;
  }

  // To the pool, after the loops that wait to be launched, since they may use it. An error is reported by the next wait.
  void free() noexcept
  {
    Loop_queue::of_thread().launch_quietly();
    static_cast<void>(cudaFreeAsync(data_, cudaStreamPerThread));
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t bytes_ = 0; // of the memory
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_DEVICE_BUFFER_CUH
