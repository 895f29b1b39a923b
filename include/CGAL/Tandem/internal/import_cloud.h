// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The border on the way in: the caller's range is read once.

#ifndef CGAL_TANDEM_INTERNAL_IMPORT_CLOUD_H
#define CGAL_TANDEM_INTERNAL_IMPORT_CLOUD_H

#include <CGAL/Tandem/internal/Import.h>

#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Reads one item at a time through the maps of the traits.
template <class Traits>
class Item_reader {
public:
  // What keeps all that a coordinate has.
  using Value = typename std::conditional<std::is_same<typename Traits::FT, float>::value, float, double>::type;

  Item_reader(const Traits& traits, typename Traits::Point_map point_map, typename Traits::Normal_map normal_map)
    : x_(traits.compute_x_3_object()), y_(traits.compute_y_3_object()), z_(traits.compute_z_3_object()),
      point_map_(point_map), normal_map_(normal_map)
  {}

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
};

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

// Reads the items [first, last) to the places of the same numbers.
template <class Traits>
void read_items(const Item_reader<Traits>& reader, const typename Traits::Point_range& points, std::size_t first,
                std::size_t last, Import& in)
{
  using Value = typename Item_reader<Traits>::Value;
  Value* p = in.coordinates.data<Value>();
  Value* n = in.normals.data<Value>();
  for(std::size_t i = first; i < last; ++i) {
    const auto& item = *(points.begin() + std::ptrdiff_t(i));
    reader.read_point(item, p + 3 * i);
    if constexpr(Traits::has_normal_map)
      reader.read_normal(item, n + 3 * i);
  }
}

// These three have no branches, so that they run on wide instructions. All take n values, three of each point.
template <class Value>
bool are_finite(const Value* v, std::size_t n)
{
  int is_other = 0;
  for(std::size_t i = 0; i < n; ++i)
    is_other |= !(std::fabs(v[i]) <= (std::numeric_limits<Value>::max)());
  return is_other == 0;
}

template <class Value>
bool has_null(const Value* v, std::size_t n)
{
  int is_null = 0;
  for(std::size_t i = 0; i < n; i += 3)
    is_null |= int(v[i] == 0) & int(v[i + 1] == 0) & int(v[i + 2] == 0);
  return is_null != 0;
}

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
  Coordinate_box box;
  for(std::size_t k = 0; k < lanes; ++k) {
    box.low[k % 3] = (std::min)(box.low[k % 3], double(low[k]));
    box.high[k % 3] = (std::max)(box.high[k % 3], double(high[k]));
  }
  return box;
}

// Whether the points [first, last) can be used, with their normals.
template <class Value>
bool are_usable(Import& in, std::size_t first, std::size_t last)
{
  const std::size_t n = 3 * (last - first);
  if(!are_finite(in.coordinates.data<Value>() + 3 * first, n))
    return false;
  const Value* const normals = in.normals.data<Value>();
  return !in.has_normals || (are_finite(normals + 3 * first, n) && !has_null(normals + 3 * first, n));
}

// The box around those of the points [first, last) that can be used. False if some cannot.
template <class Value>
bool inspect_points(Import& in, std::size_t first, std::size_t last, Coordinate_box& box)
{
  const Value* const points = in.coordinates.data<Value>();
  const bool is_complete = are_usable<Value>(in, first, last);
  if(is_complete)
    box.add(box_around(points + 3 * first, 3 * (last - first)));
  for(std::size_t i = first; i < last && !is_complete; ++i)
    if(are_usable<Value>(in, i, i + 1))
      box.add(in.position(i));
  return is_complete;
}

// Closes the gaps, and notes where the points that are left come from.
template <class Value>
void drop_invalid(Import& in)
{
  std::size_t kept = 0;
  in.uploaded.reset();
  for(std::size_t i = 0; i < in.count; ++i) {
    if(!are_usable<Value>(in, i, i + 1)) {
      const bool has_position = are_finite(in.coordinates.data<Value>() + 3 * i, 3);
      ++(has_position ? in.number_of_ignored_normals : in.number_of_ignored_coordinates);
      continue;
    }
    in.coordinates.move(i, kept);
    if(in.has_normals)
      in.normals.move(i, kept);
    in.item.push_back(std::uint32_t(i));
    ++kept;
  }
  in.count = kept;
}

// The caller's range without the points that cannot be used: a coordinate is not finite, or the normal is
// null or not finite. What has been read is uploaded while the rest is read.
template <class Traits, class Backend, class Upload = No_upload>
Import read_points(Backend& backend, const typename Traits::Point_range& points, typename Traits::Point_map point_map,
                   typename Traits::Normal_map normal_map, const Traits& traits, Upload upload = Upload())
{
  using Reader = Item_reader<Traits>;
  Import in;
  start_import<typename Reader::Value>(in, std::size_t(points.end() - points.begin()), Traits::has_normal_map);
  upload.start(in.coordinates, in.normals, in.count);
  const Reader reader(traits, point_map, normal_map);
  // Number types that compute lazily are not meant to be read by several threads.
  constexpr bool is_plain = std::is_floating_point<typename Traits::FT>::value;
  const std::size_t grain = is_plain ? 65536 : in.count + 1;
  std::vector<Coordinate_box> boxes((in.count + grain - 1) / grain);
  std::atomic<bool> is_complete(true);
  backend.for_each_piece(in.count, grain, [&](std::size_t first, std::size_t last) {
    constexpr std::size_t batch = 512; // stays in the first cache
    for(std::size_t i = first; i < last; i += batch) {
      const std::size_t end = (std::min)(i + batch, last);
      read_items(reader, points, i, end, in);
      if(!inspect_points<typename Reader::Value>(in, i, end, boxes[first / grain]))
        is_complete = false;
    }
    upload.send(first, last);
  });
  for(const Coordinate_box& box : boxes)
    in.box.add(box);
  in.uploaded = upload.finish();
  if(!is_complete)
    drop_invalid<typename Reader::Value>(in);
  return in;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_IMPORT_CLOUD_H
