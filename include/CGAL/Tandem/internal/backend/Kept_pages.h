// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory of the host for large tables. What users of a device ask for is kept for the
// next time: there, the first touch of new pages takes longer than all else on the host.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_KEPT_PAGES_H
#define CGAL_TANDEM_INTERNAL_BACKEND_KEPT_PAGES_H

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <cstddef>
#include <cstdlib>
#include <mutex>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Asks for large pages where the system has them: the first touch of small ones takes
// longer than most passes over the points.
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

class Kept_pages {
public:
  // Of about that size; null if there are none.
  static void* take(std::size_t bytes)
  {
    std::lock_guard<std::mutex> lock(mutex());
    for(Block& block : blocks())
      if(block.bytes >= bytes && block.bytes - bytes <= bytes / 4) {
        void* const memory = block.memory;
        block = blocks().back();
        blocks().pop_back();
        return memory;
      }
    return nullptr;
  }

  // Instead of std::free().
  static void give(void* memory, std::size_t bytes)
  {
    std::vector<Block> unused;
    {
      std::lock_guard<std::mutex> lock(mutex());
      if(blocks().size() == most_blocks)
        unused.swap(blocks()); // they are of sizes that nobody asks for any more
      if(bytes <= most_bytes)
        blocks().push_back({memory, bytes});
      else
        unused.push_back({memory, bytes});
    }
    free_all(unused);
  }

  static void release()
  {
    std::vector<Block> unused;
    {
      std::lock_guard<std::mutex> lock(mutex());
      unused.swap(blocks());
    }
    free_all(unused);
  }

private:
  struct Block {
    void* memory;
    std::size_t bytes;
  };

  static constexpr std::size_t most_blocks = 4;
  static constexpr std::size_t most_bytes = std::size_t(2) << 30; // of a block

  static void free_all(const std::vector<Block>& blocks)
  {
    for(const Block& block : blocks)
      std::free(block.memory);
  }

  static std::mutex& mutex()
  {
    static std::mutex& m = *new std::mutex;
    return m;
  }

  // Not destroyed at the end of the program, when there may still be tables.
  static std::vector<Block>& blocks()
  {
    static std::vector<Block>& b = *new std::vector<Block>;
    return b;
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_KEPT_PAGES_H
