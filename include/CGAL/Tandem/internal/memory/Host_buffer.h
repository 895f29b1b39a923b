// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory of the host for tables of the size of the cloud. Arrays without initial values, and the table that is
// sorted by key.

#ifndef CGAL_TANDEM_INTERNAL_MEMORY_HOST_BUFFER_H
#define CGAL_TANDEM_INTERNAL_MEMORY_HOST_BUFFER_H

#include <CGAL/Tandem/internal/memory/Kept_pages.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

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

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MEMORY_HOST_BUFFER_H
