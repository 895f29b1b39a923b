// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_INTERNAL_MEMORY_UNSET_VECTOR_H
#define CGAL_TANDEM_INTERNAL_MEMORY_UNSET_VECTOR_H

#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Leaves the items that a vector makes without a value as they are. Boost.Container's `default_init` does not: it runs
// the initializers of members, in one thread. Nor could tests fill such memory with a pattern.
template <class T>
struct Unset_allocator : std::allocator<T> {
  Unset_allocator() = default;
  template <class U>
  Unset_allocator(const Unset_allocator<U>&) noexcept
  {}

  template <class U>
  struct rebind {
    using other = Unset_allocator<U>;
  };

  void construct(T* item) noexcept
  {
    static_assert(std::is_trivially_copyable<T>::value, "plain data");
#ifdef CGAL_TANDEM_POISONS_MEMORY
    std::memset(static_cast<void*>(item), 0xa5, sizeof(T)); // so that tests see who reads it
#else
    static_cast<void>(item);
#endif
  }

  template <class... Values>
  void construct(T* item, Values&&... values)
  {
    ::new(static_cast<void*>(item)) T(std::forward<Values>(values)...);
  }
};

// For tables of the host that all threads fill, and what is handed on with them: what one thread had written first, the
// others would fetch from its cache, a line at a time.
template <class T>
using Unset_vector = std::vector<T, Unset_allocator<T>>;

using Ids = Unset_vector<std::uint32_t>;

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MEMORY_UNSET_VECTOR_H
