// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pinned memory of the host, which copies from and to a device need to be fast. It
// is slow to get, so it is kept for the next thread that asks.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_CUDA_PINNED_MEMORY_CUH
#define CGAL_TANDEM_INTERNAL_BACKEND_CUDA_PINNED_MEMORY_CUH

#include <CGAL/Tandem/internal/backend/cuda/cuda_check.cuh>

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// One block, from those that are kept.
class Pinned_block {
public:
  static constexpr std::size_t bytes = std::size_t(4) << 20;

  Pinned_block()
  {
    {
      std::lock_guard<std::mutex> lock(mutex());
      if(!kept().empty()) {
        memory_ = kept().back();
        kept().pop_back();
        return;
      }
    }
    void* memory = nullptr;
    CGAL_TANDEM_CUDA(cudaHostAlloc(&memory, bytes, cudaHostAllocPortable));
    memory_ = static_cast<char*>(memory);
  }

  ~Pinned_block()
  {
    std::lock_guard<std::mutex> lock(mutex());
    kept().push_back(memory_);
  }

  Pinned_block(const Pinned_block&) = delete;
  Pinned_block& operator=(const Pinned_block&) = delete;

  char* data() { return memory_; }

  // Gives back what no thread uses.
  static void release()
  {
    std::vector<char*> unused;
    {
      std::lock_guard<std::mutex> lock(mutex());
      unused.swap(kept());
    }
    for(char* memory : unused)
      CGAL_TANDEM_CUDA(cudaFreeHost(memory));
  }

private:
  static std::mutex& mutex()
  {
    static std::mutex& m = *new std::mutex;
    return m;
  }

  // Not destroyed at the end of the program, when the runtime may be gone.
  static std::vector<char*>& kept()
  {
    static std::vector<char*>& k = *new std::vector<char*>;
    return k;
  }

  char* memory_ = nullptr;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_CUDA_PINNED_MEMORY_CUH
