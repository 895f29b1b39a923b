// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_HOST_BUFFER_H
#define CGAL_TANDEM_INTERNAL_BACKEND_HOST_BUFFER_H

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

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

// An array that is not initialized: each of its pages is first touched by the
// thread that fills it.
template <class T>
class Host_buffer {
  static_assert(std::is_trivially_destructible<T>::value, "buffers hold plain data");

public:
  Host_buffer() = default;
  explicit Host_buffer(std::size_t size) { reset(size); }

  // Discards the contents.
  void reset(std::size_t size)
  {
    release();
    if(size == 0)
      return;
    data_.reset(static_cast<T*>(allocate_pages(size * sizeof(T))));
    if(data_ == nullptr)
      throw std::bad_alloc();
    size_ = size;
  }

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
  struct Free {
    void operator()(T* memory) const { std::free(memory); }
  };

  std::unique_ptr<T[], Free> data_;
  std::size_t size_ = 0;
};

// A table that does not change any more. Copies share it, so that they take no time.
template <class T>
class Shared_table {
public:
  using value_type = T;
  using const_iterator = const T*;
  using iterator = const_iterator;

  Shared_table() = default;
  Shared_table(Host_buffer<T>&& table) : table_(std::make_shared<const Host_buffer<T>>(std::move(table))) {}

  const T* data() const { return table_ ? table_->data() : nullptr; }
  std::size_t size() const { return table_ ? table_->size() : 0; }
  bool empty() const { return size() == 0; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size(); }
  const T& operator[](std::size_t i) const { return (*table_)[i]; }

private:
  std::shared_ptr<const Host_buffer<T>> table_;
};

// Keys with the index that each belongs to, as a back end sorts them.
class Host_sort_table {
public:
  struct Entry {
    std::uint64_t key;
    std::uint32_t index;
  };

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

#endif // CGAL_TANDEM_INTERNAL_BACKEND_HOST_BUFFER_H
