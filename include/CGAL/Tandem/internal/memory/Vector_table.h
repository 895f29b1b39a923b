// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The caller's coordinates and normals: three numbers a point. They are floats where the caller's are, which halves the
// memory and the copy to a device. Conversion to double is exact, so results do not depend on the type.

#ifndef CGAL_TANDEM_INTERNAL_MEMORY_VECTOR_TABLE_H
#define CGAL_TANDEM_INTERNAL_MEMORY_VECTOR_TABLE_H

#include <CGAL/Tandem/internal/memory/Host_buffer.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>

#include <algorithm>
#include <type_traits>

namespace CGAL {
namespace Tandem {
namespace internal {

// Read access for functors of any back end; entry i belongs to imported point i.
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

// Owns the numbers, of one of the two types at a time.
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

  // To be filled after reset<T>(): x, y and z of each vector in turn.
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

  // The numbers as bytes, for copies to a device; null if there are none.
  char* bytes()
  {
    return is_float() ? reinterpret_cast<char*>(floats_.data()) : reinterpret_cast<char*>(doubles_.data());
  }

  Vector operator[](std::size_t i) const { return view()[i]; }
  std::size_t vector_bytes() const { return 3 * (is_float() ? sizeof(float) : sizeof(double)); }

  // Copies a vector to an earlier place: the import closes the gaps that invalid points have left.
  void move(std::size_t from, std::size_t to)
  {
    if(is_float())
      std::copy_n(floats_.data() + 3 * from, 3, floats_.data() + 3 * to);
    else
      std::copy_n(doubles_.data() + 3 * from, 3, doubles_.data() + 3 * to);
  }

  // Makes the tables give their memory at their end to Kept_pages: see Host_buffer.
  void keep_pages()
  {
    floats_.keep_pages();
    doubles_.keep_pages();
  }

private:
  // Whether the numbers are floats. Also false for an empty table, whose view has a null pointer either way.
  bool is_float() const { return floats_.size() > 0; }

  template <class T>
  Host_buffer<T>& values()
  {
    if constexpr(std::is_same<T, float>::value)
      return floats_;
    else
      return doubles_;
  }

  // At least one of them is empty.
  Host_buffer<float> floats_;
  Host_buffer<double> doubles_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MEMORY_VECTOR_TABLE_H
