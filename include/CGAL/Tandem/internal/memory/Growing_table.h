// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A table of the host that grows at its end, for the shapes. It owns its memory, and a device never reads it.

#ifndef CGAL_TANDEM_INTERNAL_MEMORY_GROWING_TABLE_H
#define CGAL_TANDEM_INTERNAL_MEMORY_GROWING_TABLE_H

#include <CGAL/Tandem/internal/memory/Unset_vector.h>
#include <CGAL/Tandem/internal/memory/Host_buffer.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

// Plain items, indexed from 0. New memory has room for a few times as many items, so most calls of resize() copy
// nothing. Untouched pages of it take no physical memory.
template <class T>
class Growing_table {
  static_assert(std::is_trivially_copyable<T>::value, "plain items");

public:
  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return items_[i]; }
  const T& operator[](std::size_t i) const { return items_[i]; }

  // Keeps the items; new ones are T(). References to items hold only until the next call.
  template <class Backend>
  void resize(Backend& backend, std::size_t size)
  {
    if(size > items_.size())
      move(backend, size, size_, [](std::size_t i) { return i; });
    if(size > size_)
      backend.for_each_on_host(size - size_, [&](std::size_t i) { new(&items_[size_ + i]) T(); });
    size_ = size;
  }

  // Keeps the listed items only, in the order of the list: item i is the former item kept[i]. The room stays the same.
  template <class Backend>
  void keep(Backend& backend, const Ids& kept)
  {
    move(backend, items_.size(), kept.size(), [&](std::size_t i) { return kept[i]; });
    size_ = kept.size();
  }

private:
  static constexpr std::size_t room = 4; // times the size that is needed

  // Moves to new memory for at least `size` items: place i gets the former item old(i). Copies instead of moving in
  // place, because all threads copy at the same time.
  template <class Backend, class F>
  void move(Backend& backend, std::size_t size, std::size_t moved, F old)
  {
    Host_buffer<T> items(size > items_.size() ? room * size : items_.size());
    if(Backend::keeps_pages)
      items.keep_pages();
    backend.for_each_on_host(moved, [&](std::size_t i) { new(&items[i]) T(items_[old(i)]); });
    items_ = std::move(items);
  }

  Host_buffer<T> items_; // of the size of the room
  std::size_t size_ = 0; // items in use
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MEMORY_GROWING_TABLE_H
