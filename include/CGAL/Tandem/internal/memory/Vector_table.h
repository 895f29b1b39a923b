// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The caller's coordinates and normals: three numbers a point, floats where those of
// the caller are, which takes half the memory and half the way to a device.

#ifndef CGAL_TANDEM_INTERNAL_MEMORY_VECTOR_TABLE_H
#define CGAL_TANDEM_INTERNAL_MEMORY_VECTOR_TABLE_H

#include <CGAL/Tandem/internal/memory/Host_buffer.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>

#include <algorithm>
#include <type_traits>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Vectors_view {
  const void* data; // null: there are none
  bool is_float;

  CGAL_TANDEM_HD Vector operator[](std::size_t i) const { return is_float ? read<float>(i) : read<double>(i); }

private:
  template <class T>
  CGAL_TANDEM_HD Vector read(std::size_t i) const
  {
    const T* v = static_cast<const T*>(data) + 3 * i;
    return {double(v[0]), double(v[1]), double(v[2])};
  }
};

class Vector_table {
public:
  // T is float or double. Discards the contents.
  template <class T>
  void reset(std::size_t size)
  {
    floats_.release();
    doubles_.release();
    values<T>().reset(3 * size);
  }

  template <class T>
  T* data()
  {
    return values<T>().data();
  }

  Vectors_view view() const
  {
    if(is_float())
      return {floats_.data(), true};
    return {doubles_.data(), false};
  }

  // Null if there are none.
  char* bytes()
  {
    return is_float() ? reinterpret_cast<char*>(floats_.data()) : reinterpret_cast<char*>(doubles_.data());
  }

  Vector operator[](std::size_t i) const { return view()[i]; }
  std::size_t vector_bytes() const { return 3 * (is_float() ? sizeof(float) : sizeof(double)); }

  // To a place before that.
  void move(std::size_t from, std::size_t to)
  {
    if(is_float())
      std::copy_n(floats_.data() + 3 * from, 3, floats_.data() + 3 * to);
    else
      std::copy_n(doubles_.data() + 3 * from, 3, doubles_.data() + 3 * to);
  }

  // See Host_buffer.
  void keep_pages()
  {
    floats_.keep_pages();
    doubles_.keep_pages();
  }

private:
  bool is_float() const { return floats_.size() > 0; }

  template <class T>
  Host_buffer<T>& values()
  {
    if constexpr(std::is_same<T, float>::value)
      return floats_;
    else
      return doubles_;
  }

  Host_buffer<float> floats_; // one of them is empty
  Host_buffer<double> doubles_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MEMORY_VECTOR_TABLE_H
