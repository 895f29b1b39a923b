// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory of the host for large tables. The first touch of new pages takes as long as a pass over the points. So freed
// tables are kept: those of a detection until its end, and beside a device, where it would take longer than all other
// work of the host, some for the next call.

#ifndef CGAL_TANDEM_INTERNAL_MEMORY_KEPT_PAGES_H
#define CGAL_TANDEM_INTERNAL_MEMORY_KEPT_PAGES_H

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <mutex>
#include <new>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

constexpr std::size_t large_page = std::size_t(2) << 20;

// Smaller blocks would waste much of a large page.
inline bool has_large_pages(std::size_t bytes) { return bytes >= 2 * large_page; }

// Requests large pages where the system has them: the first touch of small ones takes longer than most passes over the
// points. Other blocks are aligned to a cache line only. Null if there is no memory.
inline void* allocate_pages(std::size_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  if(has_large_pages(bytes)) {
    void* const memory = std::aligned_alloc(large_page, (bytes + large_page - 1) / large_page * large_page);
    if(memory != nullptr)
      static_cast<void>(madvise(memory, bytes, MADV_HUGEPAGE));
    return memory;
  }
#endif
  constexpr std::size_t line = 64;
  return std::aligned_alloc(line, (bytes + line - 1) / line * line);
}

// Freed blocks of the whole process, for any thread: those for the next call, and, while there is a detection, all that
// have large pages. Their number and sum are bounded.
class Kept_pages {
public:
  // A block that std::free() accepts, with its full size.
  struct Block {
    void* memory = nullptr;
    std::size_t bytes = 0;
    bool is_for_next_call = false;
  };

  // Most buffers of a detection come and go, so their memory is kept until its end. Buffers in use and kept blocks
  // together are not more than what buffers had in use at one time.
  class Detection {
  public:
    Detection()
    {
      std::lock_guard<std::mutex> lock(mutex());
      if(state().detections++ == 0)
        state().peak = state().used;
    }
    ~Detection()
    {
      std::lock_guard<std::mutex> lock(mutex());
      if(--state().detections == 0)
        free_if([](const Block& block) { return !block.is_for_next_call; });
    }
    Detection(const Detection&) = delete;
    Detection& operator=(const Detection&) = delete;
  };

  // A kept block, or memory of the system.
  static Block allocate(std::size_t bytes)
  {
    std::unique_lock<std::mutex> lock(mutex());
    Block block = take(bytes);
    count_in_use(block.memory != nullptr ? block.bytes : bytes);
    lock.unlock();
    if(block.memory == nullptr)
      block = {allocate_pages(bytes), bytes};
    if(block.memory == nullptr) {
      put({nullptr, bytes}); // it is not in use
      throw std::bad_alloc();
    }
    return block;
  }

  // Instead of std::free(). Where the bound on the number is exceeded, or that on the sum of those for the next call,
  // the oldest blocks are freed.
  static void put(Block block) noexcept
  {
    std::lock_guard<std::mutex> lock(mutex());
    State& s = state();
    if(has_large_pages(block.bytes))
      s.used -= (std::min)(s.used, block.bytes);
    const bool is_kept =
      block.is_for_next_call ? block.bytes <= maximum_bytes : s.detections > 0 && has_large_pages(block.bytes);
    if(!is_kept || block.memory == nullptr)
      return std::free(block.memory);
    const auto unused =
      std::find_if(s.blocks.begin(), s.blocks.end() - 1, [](const Block& b) { return b.memory == nullptr; });
    std::free(unused->memory);
    std::move_backward(s.blocks.begin(), unused, unused + 1);
    s.blocks.front() = block;
    std::size_t sum = 0;
    free_if([&](const Block& b) { return b.is_for_next_call && (sum += b.bytes) > maximum_bytes; });
  }

  // Frees all blocks that are kept; tables in use stay.
  static void release() noexcept
  {
    std::lock_guard<std::mutex> lock(mutex());
    free_if([](const Block&) { return true; });
  }

  // Of all blocks.
  static std::size_t kept_bytes()
  {
    std::lock_guard<std::mutex> lock(mutex());
    std::size_t sum = 0;
    for(const Block& block : state().blocks)
      sum += block.bytes;
    return sum;
  }

private:
  struct State {
    std::array<Block, 32> blocks;   // the latest first; unused entries have a null pointer
    std::size_t used = 0, peak = 0; // bytes in blocks of large pages: now, and at most since the first detection began
    int detections = 0;
  };

  static constexpr std::size_t maximum_bytes = std::size_t(8) << 30; // of all blocks for the next call

  // The smallest kept block of at least that size and at most a quarter more; null if there is none. The bound keeps
  // large blocks for large tables.
  static Block take(std::size_t bytes)
  {
    Block* best = nullptr;
    for(Block& block : state().blocks)
      if(block.memory != nullptr && block.bytes >= bytes && block.bytes - bytes <= bytes / 4 &&
         (best == nullptr || block.bytes < best->bytes))
        best = &block;
    return best != nullptr ? std::exchange(*best, Block()) : Block();
  }

  template <class F>
  static void free_if(F is_freed)
  {
    for(Block& block : state().blocks)
      if(block.memory != nullptr && is_freed(block))
        std::free(std::exchange(block, Block()).memory);
  }

  // Frees the oldest kept blocks as long as these and those in use are more than ever were in use.
  static void count_in_use(std::size_t bytes)
  {
    State& s = state();
    if(!has_large_pages(bytes))
      return;
    s.used += bytes;
    s.peak = (std::max)(s.peak, s.used);
    std::size_t sum = s.used;
    free_if([&](const Block& b) { return !b.is_for_next_call && (sum += b.bytes) > s.peak; });
  }

  // Buffers of several threads may end at the same time. Neither is destroyed at the end of the program, when there may
  // still be tables.
  static std::mutex& mutex()
  {
    static std::mutex& m = *new std::mutex;
    return m;
  }

  static State& state()
  {
    static State& s = *new State;
    return s;
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MEMORY_KEPT_PAGES_H
