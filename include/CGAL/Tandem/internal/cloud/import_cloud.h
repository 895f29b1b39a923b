// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads the caller's range once, through its property maps and traits, into an Import. Invalid points are dropped and
// counted here; all later stages rely on finite coordinates and normals that are not null. No other file of the
// engine depends on types of the caller.

#ifndef CGAL_TANDEM_INTERNAL_CLOUD_IMPORT_CLOUD_H
#define CGAL_TANDEM_INTERNAL_CLOUD_IMPORT_CLOUD_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/backend/Host_memory.h>
#include <CGAL/Tandem/internal/cloud/Import.h>

#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- Which of the points that have just been read are valid, and their bounds.

// Consecutive points in memory: three values a point, and as many of normals.
template <class Value>
struct Values {
  Value* point;
  Value* normal; // null: there are none

  // The points from the i-th on.
  Values from(std::size_t i) const { return {point + 3 * i, normal != nullptr ? normal + 3 * i : nullptr}; }
};

// The next three functions take n values, three of each point. They have no branches, so that they vectorize.

// Whether no value is infinite or NaN. The comparison is false for NaN.
template <class Value>
bool are_finite(const Value* v, std::size_t n)
{
  int is_other = 0;
  for(std::size_t i = 0; i < n; ++i)
    is_other |= !(std::fabs(v[i]) <= (std::numeric_limits<Value>::max)());
  return is_other == 0;
}

// Whether a vector is null.
template <class Value>
bool has_null(const Value* v, std::size_t n)
{
  int is_null = 0;
  for(std::size_t i = 0; i < n; i += 3)
    is_null |= int(v[i] == 0) & int(v[i + 1] == 0) & int(v[i + 2] == 0);
  return is_null != 0;
}

// The bounds of finite values. Element k of the tables belongs to axis k % 3.
template <class Value>
Coordinate_box box_around(const Value* v, std::size_t n)
{
  constexpr std::size_t lanes = 24; // a multiple of three; of fewer, g++ unrolls the loops instead
  Value low[lanes], high[lanes];
  std::fill_n(low, lanes, std::numeric_limits<Value>::infinity());
  std::fill_n(high, lanes, -std::numeric_limits<Value>::infinity());
  std::size_t i = 0;
  for(; i + lanes <= n; i += lanes) {
    for(std::size_t k = 0; k < lanes; ++k)
      low[k] = v[i + k] < low[k] ? v[i + k] : low[k];
    for(std::size_t k = 0; k < lanes; ++k)
      high[k] = high[k] < v[i + k] ? v[i + k] : high[k];
  }
  for(; i < n; ++i) {
    low[i % 3] = (std::min)(low[i % 3], v[i]);
    high[i % 3] = (std::max)(high[i % 3], v[i]);
  }
  // Minima and maxima are the same in any order.
  Coordinate_box box;
  for(std::size_t k = 0; k < lanes; ++k) {
    box.low[k % 3] = (std::min)(box.low[k % 3], double(low[k]));
    box.high[k % 3] = (std::max)(box.high[k % 3], double(high[k]));
  }
  return box;
}

// Whether all points are valid: finite coordinates, and finite normals that are not null.
template <class Value>
bool are_usable(const Values<Value>& values, std::size_t points)
{
  const std::size_t n = 3 * points;
  return are_finite(values.point, n) &&
         (values.normal == nullptr || (are_finite(values.normal, n) && !has_null(values.normal, n)));
}

// Adds the valid points to the box. Returns false if some are invalid. The points are tested one by one only then.
template <class Value>
bool inspect_points(const Values<Value>& values, std::size_t points, Coordinate_box& box)
{
  const bool is_complete = are_usable(values, points);
  if(is_complete)
    box.add(box_around(values.point, 3 * points));
  for(std::size_t i = 0; i < points && !is_complete; ++i)
    if(are_usable(values.from(i), 1))
      box.add(box_around(values.from(i).point, 3));
  return is_complete;
}

// Converts one item at a time, through the maps and functors of the traits, to three numbers.
template <class Traits>
class Item_reader {
public:
  // float for float, as it takes half the memory; double for all other number types.
  using Value = typename std::conditional<std::is_same<typename Traits::FT, float>::value, float, double>::type;

  // The tolerance of an item, by its position in the range.
  using Tolerance_of = std::function<double(std::size_t)>;

  Item_reader(const Traits& traits, typename Traits::Point_map point_map, typename Traits::Normal_map normal_map,
              Tolerance_of tolerance_of = nullptr)
    : x_(traits.compute_x_3_object()), y_(traits.compute_y_3_object()), z_(traits.compute_z_3_object()),
      point_map_(point_map), normal_map_(normal_map), tolerance_of_(std::move(tolerance_of))
  {}

  // Null if all points have the tolerance of the detection.
  const Tolerance_of& tolerance_of() const { return tolerance_of_; }

  template <class Item>
  void read_point(const Item& item, Value* out) const
  {
    const typename Traits::Point_3& p = get(point_map_, item);
    convert(p, out);
  }

  template <class Item>
  void read_normal(const Item& item, Value* out) const
  {
    const typename Traits::Vector_3& v = get(normal_map_, item);
    convert(v, out);
  }

private:
  template <class Geometry>
  void convert(const Geometry& g, Value* out) const
  {
    out[0] = value(x_(g));
    out[1] = value(y_(g));
    out[2] = value(z_(g));
  }

  // Exact numbers become the nearest doubles, or close to them: see CGAL::to_double().
  static Value value(const typename Traits::FT& x)
  {
    if constexpr(std::is_same<typename Traits::FT, Value>::value)
      return x;
    else
      return CGAL::to_double(x);
  }

  typename Traits::Compute_x_3 x_;
  typename Traits::Compute_y_3 y_;
  typename Traits::Compute_z_3 z_;
  typename Traits::Point_map point_map_;
  typename Traits::Normal_map normal_map_;
  Tolerance_of tolerance_of_;
};

// Allocates the tables for `size` points. Positions of points are below 2^31: see no_index.
template <class Value>
void start_import(Import& in, std::size_t size, bool has_normals)
{
  if(size > maximum_number_of_points)
    throw std::length_error("the range has " + to_text(size) + " points, at most " + to_text(maximum_number_of_points) +
                            " (2^31) can be handled");
  in.count = in.number_of_items = size;
  in.has_normals = has_normals;
  in.coordinates.reset<Value>(size);
  if(has_normals)
    in.normals.reset<Value>(size);
}

// Reads the items [first, last) to the beginning of `values`.
template <class Traits, class Value>
void read_items(const Item_reader<Traits>& reader, const typename Traits::Point_range& points, std::size_t first,
                std::size_t last, Values<Value> values)
{
  for(std::size_t i = first; i < last; ++i) {
    const auto it = points.begin() + std::ptrdiff_t(i); // kept: some iterators hold the item themselves
    const auto& item = *it;
    reader.read_point(item, values.point + 3 * (i - first));
    if constexpr(Traits::has_normal_map)
      reader.read_normal(item, values.normal + 3 * (i - first));
  }
}

// Leaves out invalid points, which are counted by reason. It runs on one thread of the host.
template <class Value>
void drop_invalid(Import& in)
{
  in.drop_upload();
  const Values<Value> values = {in.coordinates.data<Value>(), in.normals.data<Value>()};
  in.keep_if([&](std::size_t i) {
    const bool is_usable = are_usable(values.from(i), 1);
    if(!is_usable)
      ++(are_finite(values.from(i).point, 3) ? in.number_of_ignored_normals : in.number_of_ignored_coordinates);
    else if(in.has_tolerances && !(in.tolerances[i] > 0))
      ++in.number_of_ignored_tolerances;
    return is_usable && (!in.has_tolerances || in.tolerances[i] > 0);
  });
}

// Reads the tolerances of all points. Returns whether all are positive; NaN is not.
template <class Traits, class Backend>
bool read_tolerances(Backend& backend, const Item_reader<Traits>& reader, Import& in)
{
  in.has_tolerances = true;
  in.tolerances.resize(in.count);
  std::atomic<bool> are_positive(true);
  backend.for_each_on_host(in.count, [&](std::size_t i) {
    in.tolerances[i] = reader.tolerance_of()(i);
    if(!(in.tolerances[i] > 0))
      are_positive = false;
  });
  return are_positive;
}

// The box and the numbers of points become those of all ranks. Ranks without points follow the others: an empty point
// set may have no normals.
template <class Ranks>
void join_imports(const Ranks& ranks, Import& in)
{
  struct Part {
    Coordinate_box box;
    Import_counts count;
    std::uint64_t has_normals, has_tolerances;
    double smallest_tolerance, largest_tolerance;
  };
  bool are_given = false, are_missing = false, have_tolerances = false, lack_tolerances = false;
  in.total = Import_counts();
  const Import_counts own = {in.count,
                             in.number_of_items,
                             in.number_of_ignored_coordinates,
                             in.number_of_ignored_normals,
                             in.number_of_ignored_tolerances,
                             in.number_of_far_points};
  double smallest = HUGE_VAL, largest = 0;
  for(const double t : in.tolerances) {
    smallest = (std::min)(smallest, t);
    largest = (std::max)(largest, t);
  }
  in.smallest_tolerance = HUGE_VAL;
  in.largest_tolerance = 0;
  for(const Part& part :
      ranks.gather(std::vector<Part>{{in.box, own, in.has_normals, in.has_tolerances, smallest, largest}})) {
    in.box.add(part.box);
    in.total.points += part.count.points;
    in.total.items += part.count.items;
    in.total.ignored_coordinates += part.count.ignored_coordinates;
    in.total.ignored_normals += part.count.ignored_normals;
    in.total.ignored_tolerances += part.count.ignored_tolerances;
    in.total.far_points += part.count.far_points;
    in.smallest_tolerance = (std::min)(in.smallest_tolerance, part.smallest_tolerance);
    in.largest_tolerance = (std::max)(in.largest_tolerance, part.largest_tolerance);
    (part.has_normals ? are_given : are_missing) |= part.count.points > 0;
    (part.has_tolerances ? have_tolerances : lack_tolerances) |= part.count.points > 0;
  }
  if(are_given && are_missing)
    throw std::invalid_argument("normal_map is given on some ranks only");
  if(have_tolerances && lack_tolerances)
    throw std::invalid_argument("maximum_distance_map is given on some ranks only");
  in.has_tolerances = have_tolerances || (in.has_tolerances && !lack_tolerances);
  in.has_normals = are_given || (in.has_normals && !are_missing);
}

// The valid points of the caller's range. They are read in parallel, in batches that are inspected while they are in
// the cache. Each piece goes to the memory that `upload` supplies, else to the tables. Threads write different points
// and one box a grain. is_complete is shared, but only ever set to false.
template <class Traits, class Backend, class Upload = No_upload>
Import read_points(Backend& backend, const typename Traits::Point_range& points, const Item_reader<Traits>& reader,
                   Upload upload = Upload())
{
  static_assert(std::is_base_of<Host_memory, Backend>::value, "the range is read on the host");
  using Value = typename Item_reader<Traits>::Value;
  Import in;
  start_import<Value>(in, std::size_t(points.end() - points.begin()), Traits::has_normal_map);
  upload.start(in.coordinates, in.normals, in.count);
  // Number types that compute lazily are not safe to read from several threads: one piece, one thread.
  constexpr bool is_plain = std::is_floating_point<typename Traits::FT>::value;
  const std::size_t grain = is_plain ? 65536 : in.count + 1;
  std::vector<Coordinate_box> boxes((in.count + grain - 1) / grain);
  std::atomic<bool> is_complete(true);
  const Values<Value> tables = {in.coordinates.data<Value>(), in.normals.data<Value>()};
  // The items [first, last), to the memory of `values`.
  const auto read = [&](std::size_t first, std::size_t last, const Values<Value>& values, Coordinate_box& box) {
    constexpr std::size_t batch = 512; // stays in the first cache
    for(std::size_t i = first; i < last; i += batch) {
      const std::size_t end = (std::min)(i + batch, last);
      read_items(reader, points, i, end, values.from(i - first));
      if(!inspect_points(values.from(i - first), end - i, box))
        is_complete = false;
    }
  };
  backend.for_each_piece(in.count, grain, [&](std::size_t first, std::size_t last) {
    for(std::size_t i = first; i < last;) {
      // An upload may have room for a part of the range only.
      const typename Upload::Piece piece = upload.begin(last - i);
      Values<Value> values = tables.from(i);
      if(piece.values != nullptr) {
        values.point = reinterpret_cast<Value*>(piece.values);
        values.normal = in.has_normals ? values.point + 3 * piece.size : nullptr;
      }
      read(i, i + piece.size, values, boxes[first / grain]);
      upload.end(piece, i);
      i += piece.size;
    }
  });
  for(const Coordinate_box& box : boxes)
    in.box.add(box);
  in.uploaded = upload.finish();
  if(reader.tolerance_of() && !read_tolerances(backend, reader, in))
    is_complete = false;
  if(!is_complete)
    drop_invalid<Value>(in);
  join_imports(Ranks<Backend>(backend), in);
  return in;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CLOUD_IMPORT_CLOUD_H
