// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small blocks of device memory that a host thread has freed and may use again at once: calls of the pool for them take
// as long as what is done with them. All work of a thread is in the order of its stream, so a block may still be in use
// by what was queued before.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_KEPT_BLOCKS_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_KEPT_BLOCKS_CUH

#include <CGAL/Tandem/internal/cuda/runtime/Loop_queue.cuh>

#include <cstddef>
#include <exception>
#include <map>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

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

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_KEPT_BLOCKS_CUH
