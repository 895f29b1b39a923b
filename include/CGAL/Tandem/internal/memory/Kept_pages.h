// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory of the host for large tables. Beside a device, freed tables are kept for the next call. There, the first touch
// of new pages would take longer than all other work of the host.

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
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

// Requests large pages where the system has them: the first touch of small ones takes longer than most passes over the
// points. Smaller blocks would waste much of a large page, and are aligned to a cache line only. Null if there is no
// memory.
inline void* allocate_pages(std::size_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::size_t page = std::size_t(2) << 20;
  if(bytes >= 2 * page) {
    void* const memory = std::aligned_alloc(page, (bytes + page - 1) / page * page);
    if(memory != nullptr)
      static_cast<void>(madvise(memory, bytes, MADV_HUGEPAGE));
    return memory;
  }
#endif
  constexpr std::size_t line = 64;
  return std::aligned_alloc(line, (bytes + line - 1) / line * line);
}

// Freed blocks of the whole process, for any thread. Their number and sum are bounded; release_memory() frees them.
class Kept_pages {
public:
  // A block that std::free() accepts, with its full size.
  struct Block {
    void* memory = nullptr;
    std::size_t bytes = 0;
  };

  // The smallest block of at least that size and at most a quarter more; null if there is none. The bound keeps large
  // blocks for large tables.
  static Block take(std::size_t bytes)
  {
    std::lock_guard<std::mutex> lock(mutex());
    Block* best = nullptr;
    for(Block& block : blocks())
      if(block.memory != nullptr && block.bytes >= bytes && block.bytes - bytes <= bytes / 4 &&
         (best == nullptr || block.bytes < best->bytes))
        best = &block;
    return best != nullptr ? std::exchange(*best, Block()) : Block();
  }

  // Called instead of std::free(). Where the bound on the number or on the sum is exceeded, the oldest blocks are
  // freed.
  static void put(void* memory, std::size_t bytes) noexcept
  {
    if(bytes > maximum_bytes)
      return std::free(memory);
    std::lock_guard<std::mutex> lock(mutex());
    Blocks& all = blocks();
    const auto unused = std::find_if(all.begin(), all.end() - 1, [](const Block& b) { return b.memory == nullptr; });
    std::free(unused->memory);
    std::move_backward(all.begin(), unused, unused + 1);
    all.front() = {memory, bytes};
    std::size_t sum = 0;
    for(Block& block : all) {
      sum += block.bytes;
      if(sum > maximum_bytes)
        std::free(std::exchange(block, Block()).memory);
    }
  }

  // Frees all blocks that are kept; tables in use stay.
  static void release() noexcept
  {
    std::lock_guard<std::mutex> lock(mutex());
    for(Block& block : blocks())
      std::free(std::exchange(block, Block()).memory);
  }

private:
  // The latest first. Empty entries have a null pointer.
  using Blocks = std::array<Block, 8>;

  static constexpr std::size_t maximum_bytes = std::size_t(8) << 30; // of all blocks

  // Buffers of several threads may end at the same time. Not destroyed either, for the same reason as the blocks.
  static std::mutex& mutex()
  {
    static std::mutex& m = *new std::mutex;
    return m;
  }

  // Not destroyed at the end of the program, when there may still be tables.
  static Blocks& blocks()
  {
    static Blocks& b = *new Blocks;
    return b;
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MEMORY_KEPT_PAGES_H
