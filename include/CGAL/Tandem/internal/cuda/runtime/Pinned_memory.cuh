// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pinned memory of the host, which fast copies from and to a device need. To allocate it is slow, so blocks are kept.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_PINNED_MEMORY_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_PINNED_MEMORY_CUH

#include <CGAL/Tandem/internal/cuda/runtime/cuda_check.cuh>

#include <cstddef>
#include <exception>
#include <mutex>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

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

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_PINNED_MEMORY_CUH
