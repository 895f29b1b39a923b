// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory of the host for tables of the size of the cloud. Arrays without initial values, and the table that is
// sorted by key.

#ifndef CGAL_TANDEM_INTERNAL_MEMORY_HOST_BUFFER_H
#define CGAL_TANDEM_INTERNAL_MEMORY_HOST_BUFFER_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <new>
#include <type_traits>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace CGAL::Tandem::internal {

// --- Memory of the host for large tables. The first touch of new pages takes as long as a pass over the points. So freed
// tables are kept: those of a detection until its end, and beside a device, where it would take longer than all other
// work of the host, some for the next call.

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
      std::lock_guard<std::mutex> lock(state().mutex);
      if(state().detections++ == 0)
        state().peak = state().used;
    }
    ~Detection()
    {
      std::lock_guard<std::mutex> lock(state().mutex);
      if(--state().detections == 0)
        free_if([](const Block& block) { return !block.is_for_next_call; });
    }
    Detection(const Detection&) = delete;
    Detection& operator=(const Detection&) = delete;
  };

  // A kept block, or memory of the system.
  static Block allocate(std::size_t bytes)
  {
    std::unique_lock<std::mutex> lock(state().mutex);
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
    std::lock_guard<std::mutex> lock(state().mutex);
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
    std::lock_guard<std::mutex> lock(state().mutex);
    free_if([](const Block&) { return true; });
  }

  // Of all blocks.
  static std::size_t kept_bytes()
  {
    std::lock_guard<std::mutex> lock(state().mutex);
    std::size_t sum = 0;
    for(const Block& block : state().blocks)
      sum += block.bytes;
    return sum;
  }

private:
  struct State {
    std::mutex mutex;               // buffers of several threads may end at the same time
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

  // Not destroyed at the end of the program, when there may still be tables.
  static State& state()
  {
    static State& s = *new State;
    return s;
  }
};

// An array of plain items without initial values. So each page is first touched by the thread that fills it, and lies
// in that thread's part of the memory. Cannot be copied, only moved.
template <class T>
class Host_buffer {
  static_assert(std::is_trivially_destructible<T>::value, "buffers hold plain data");

public:
  Host_buffer() = default;
  explicit Host_buffer(std::size_t size) { reset(size); }

  // Discards the contents. Takes a kept block if one has the right size, else memory of the system.
  void reset(std::size_t size)
  {
    release();
    if(size == 0)
      return;
    const std::size_t bytes = size * sizeof(T);
    const Kept_pages::Block block = Kept_pages::allocate(bytes);
#ifdef CGAL_TANDEM_POISONS_MEMORY
    std::memset(block.memory, 0xa5, bytes); // so that tests see who reads it
#endif
    data_ = std::unique_ptr<T[], Free>(static_cast<T*>(block.memory), Free{block.bytes, false});
    size_ = size;
  }

  // Makes the buffer leave its memory at its end to the buffers of about this size of the next call.
  void keep_pages() { data_.get_deleter().is_kept = true; }

  // The buffer is empty afterwards.
  void release()
  {
    data_.reset();
    size_ = 0;
  }

  T* get() const { return data_.get(); }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_.get(); }
  T* end() { return data_.get() + size_; }
  const T* begin() const { return data_.get(); }
  const T* end() const { return data_.get() + size_; }

private:
  // The bytes are those of the block, which may be larger than the array.
  struct Free {
    std::size_t bytes = 0;
    bool is_kept = false;

    void operator()(T* memory) const { Kept_pages::put({memory, bytes, is_kept}); }
  };

  std::unique_ptr<T[], Free> data_;
  std::size_t size_ = 0;
};

// Keys with the index that each belongs to, in the layout that sorts on the host need: both beside each other. Functors
// use the view only, because a device has two separate arrays.
class Host_sort_table {
public:
  struct Entry {
    std::uint64_t key;
    std::uint32_t index;
  };

  // Functors copy the view and write entries through it, each entry from one functor.
  struct View {
    Entry* entry;

    std::uint64_t key(std::size_t i) const { return entry[i].key; }
    std::uint32_t index(std::size_t i) const { return entry[i].index; }
    void set(std::size_t i, std::uint64_t key, std::uint32_t index) const { entry[i] = {key, index}; }
  };

  explicit Host_sort_table(std::size_t size) : entries_(size) {}

  View view() const { return {entries_.get()}; }
  std::size_t size() const { return entries_.size(); }
  Entry* begin() { return entries_.begin(); }
  Entry* end() { return entries_.end(); }

private:
  Host_buffer<Entry> entries_;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_MEMORY_HOST_BUFFER_H
