// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_INTERNAL_UNSET_VECTOR_H
#define CGAL_TANDEM_INTERNAL_UNSET_VECTOR_H

#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Leaves the items that a vector makes without a value as they are.
template <class T>
struct Unset_allocator : std::allocator<T> {
  static_assert(std::is_trivially_copyable<T>::value, "plain data");

  template <class U>
  struct rebind {
    using other = Unset_allocator<U>;
  };

  void construct(T*) noexcept {}

  template <class... Values>
  void construct(T* item, Values&&... values)
  {
    ::new(static_cast<void*>(item)) T(std::forward<Values>(values)...);
  }
};

// For tables of the host that all threads fill: what one thread had written first, the others would fetch from its
// cache, a line at a time.
template <class T>
using Unset_vector = std::vector<T, Unset_allocator<T>>;

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_UNSET_VECTOR_H
