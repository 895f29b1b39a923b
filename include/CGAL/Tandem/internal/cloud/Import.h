// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The caller's valid points as read by import_cloud.h. All of it is plain data of the host, so back ends share it. A
// device replaces only the place where the values are kept.

#ifndef CGAL_TANDEM_INTERNAL_CLOUD_IMPORT_H
#define CGAL_TANDEM_INTERNAL_CLOUD_IMPORT_H

#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>
#include <CGAL/Tandem/internal/base/tuning/cloud.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/memory/Host_buffer.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- The caller's coordinates and normals: three numbers a point. They are floats where the caller's are, which halves the
// memory and the copy to a device. Conversion to double is exact, so results do not depend on the type.

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

// --- The import itself.

// Bounds in the caller's coordinates. Like Box it starts empty and only grows.
struct Coordinate_box {
  double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

  void add(const Vector& p)
  {
    const double v[3] = {p.x, p.y, p.z};
    for(int c = 0; c < 3; ++c) {
      low[c] = (std::min)(low[c], v[c]);
      high[c] = (std::max)(high[c], v[c]);
    }
  }

  void add(const Coordinate_box& box)
  {
    for(int c = 0; c < 3; ++c) {
      low[c] = (std::min)(low[c], box.low[c]);
      high[c] = (std::max)(high[c], box.high[c]);
    }
  }

  // The largest width along an axis; -infinity for an empty box.
  double extent() const { return (std::max)((std::max)(high[0] - low[0], high[1] - low[1]), high[2] - low[2]); }
};

CGAL_TANDEM_HD inline double largest_component(const Vector& v)
{
  return std::fmax(std::fmax(std::fabs(v.x), std::fabs(v.y)), std::fabs(v.z));
}

// The vector of unit length, also where squares would overflow or vanish: then it is divided by the largest component
// before. The null vector gives NaN in that case; valid normals are never null.
CGAL_TANDEM_HD inline Vector normalized(const Vector& v)
{
  const double largest = largest_component(v);
  if(largest < 1e-100 || largest > 1e100)
    return unit({v.x / largest, v.y / largest, v.z / largest});
  return unit(v);
}

// Coordinates and normals that were sent to a device while they were read. The tables of the import are not filled yet.
class Uploaded_values {
public:
  virtual ~Uploaded_values() = default;
  // Fills the tables of the import. Further calls have no effect.
  virtual void download() = 0;
};

// The upload of an engine that runs on the host: values are read into the tables and stay there. Other engines supply
// a class with the same functions.
struct No_upload {
  // A number of consecutive points that one thread reads.
  struct Piece {
    std::size_t size;
    char* values = nullptr; // destination of coordinates, then normals; null: the tables of the import
  };

  // Called once, with the tables and the number of points. The memory of the tables must stay where it is.
  void start(Vector_table&, Vector_table&, std::size_t) {}
  // The next piece of a thread, of at most `maximum` points.
  Piece begin(std::size_t maximum) { return {maximum}; }
  // Takes a piece that has been read. The number is the position of its first point.
  void end(const Piece&, std::size_t) {}
  // Called once, after all pieces. Null: the values are in the tables.
  std::shared_ptr<Uploaded_values> finish() { return nullptr; }
};

// Numbers of points of an import: valid ones, items of the range, and those that are left out.
struct Import_counts {
  std::uint64_t points = 0, items = 0, ignored_coordinates = 0, ignored_normals = 0, ignored_tolerances = 0,
                far_points = 0;
};

// The valid points of the caller's range, in its order. Tables of points are indexed by this order until the cloud is
// sorted. Points with a value that is not finite, or with a null normal, are left out and counted.
struct Import {
  std::size_t count = 0;                     // of valid points
  Vector_table coordinates;                  // of the valid points, as they were read
  Vector_table normals;                      // the same, of any length; empty if they are to be estimated
  std::vector<std::uint32_t> item;           // position in the caller's range; empty means identity
  std::shared_ptr<Uploaded_values> uploaded; // if set, the tables are filled only after download_values()
  bool has_normals = false;
  bool has_tolerances = false;
  std::vector<double> tolerances; // of the valid points; empty if all have that of the detection
  Coordinate_box box;

  Grid grid;
  double epsilon = 0;                                          // of which the grid was chosen
  double smallest_tolerance = HUGE_VAL, largest_tolerance = 0; // of all ranks
  Surfel_cells surfel_cells;
  Grid_point low = {0, 0, 0, no_normal}, high = {0, 0, 0, no_normal}; // corners of the box on the grid
  Host_buffer<Grid_point> point;                                      // after put_on_grid()

  std::size_t number_of_items = 0; // of the caller's range
  std::size_t number_of_ignored_coordinates = 0;
  std::size_t number_of_ignored_normals = 0;
  std::size_t number_of_ignored_tolerances = 0;
  std::size_t number_of_far_points = 0;
  Import_counts total; // of all ranks, as is the box

  std::size_t size() const { return count; }
  Vector position(std::size_t i) const { return coordinates[i]; }
  Vector normal(std::size_t i) const { return normalized(normals[i]); }
  std::size_t item_of(std::size_t i) const { return item.empty() ? i : item[i]; }

  // Copies values from a device to the tables, if they are there.
  void download_values() const
  {
    if(uploaded != nullptr)
      uploaded->download();
  }

  // Copies values from a device as download_values(), and frees the memory there.
  void drop_upload()
  {
    download_values();
    uploaded.reset();
  }

  // Leaves out the points without is_kept(i), and keeps the order of the others. The values have to be in the tables.
  template <class F>
  void keep_if(F is_kept)
  {
    std::vector<std::uint32_t> kept;
    for(std::size_t i = 0; i < count; ++i) {
      if(!is_kept(i))
        continue;
      coordinates.move(i, kept.size());
      if(has_normals)
        normals.move(i, kept.size());
      if(has_tolerances)
        tolerances[kept.size()] = tolerances[i];
      kept.push_back(std::uint32_t(item_of(i)));
    }
    item = std::move(kept);
    count = item.size();
    tolerances.resize(has_tolerances ? count : 0);
  }

  // Bytes of the values of a point and its normal.
  std::size_t value_bytes() const
  {
    return coordinates.vector_bytes() * (has_normals ? 2 : 1) + (has_tolerances ? sizeof(double) : 0);
  }

  // A total order by coordinates, then normals, then tolerances, for points that are equal on the grid. Their order in the caller's
  // range matters only for exact duplicates, which are interchangeable.
  bool precedes(std::size_t i, std::size_t j) const
  {
    const auto values = [](const Vector& v) { return std::make_tuple(v.x, v.y, v.z); };
    const auto p = values(position(i)), q = values(position(j));
    if(p != q)
      return p < q;
    if(has_normals) {
      const auto m = values(normal(i)), n = values(normal(j));
      if(m != n)
        return m < n;
    }
    if(has_tolerances && tolerances[i] != tolerances[j])
      return tolerances[i] < tolerances[j];
    return i < j;
  }
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CLOUD_IMPORT_H
