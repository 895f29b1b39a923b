// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_INTERNAL_RESULT_SHARED_TABLE_H
#define CGAL_TANDEM_INTERNAL_RESULT_SHARED_TABLE_H

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace CGAL::Tandem::internal {

// A table that does not change any more. Copies share the items, so a result is copied in constant time.
template <class T>
class Shared_table {
public:
  using value_type = T;
  using const_iterator = const T*;
  using iterator = const_iterator;

  Shared_table() = default;

  // Takes the memory of a vector, or of any other array with data() and size().
  template <class Array, class = typename std::enable_if<!std::is_reference<Array>::value>::type>
  Shared_table(Array&& items)
  {
    const auto owner = std::make_shared<const Array>(std::forward<Array>(items));
    items_ = std::shared_ptr<const T>(owner, owner->data());
    size_ = owner->size();
  }

  const T* data() const { return items_.get(); }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  const T& operator[](std::size_t i) const { return data()[i]; }

private:
  std::shared_ptr<const T> items_;
  std::size_t size_ = 0;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_RESULT_SHARED_TABLE_H
