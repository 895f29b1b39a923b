// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The border on the way in: the caller's range is read once into doubles.

#ifndef CGAL_TANDEM_INTERNAL_IMPORT_CLOUD_H
#define CGAL_TANDEM_INTERNAL_IMPORT_CLOUD_H

#include <CGAL/Tandem/internal/Import.h>

#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Reads one item at a time through the maps of the traits.
template <class Traits>
class Item_reader {
public:
  Item_reader(const Traits& traits, typename Traits::Point_map point_map, typename Traits::Normal_map normal_map)
    : x_(traits.compute_x_3_object()), y_(traits.compute_y_3_object()), z_(traits.compute_z_3_object()),
      point_map_(point_map), normal_map_(normal_map)
  {}

  template <class Item>
  void read_point(const Item& item, double* out) const
  {
    const typename Traits::Point_3& p = get(point_map_, item);
    convert(p, out);
  }

  template <class Item>
  void read_normal(const Item& item, double* out) const
  {
    const typename Traits::Vector_3& v = get(normal_map_, item);
    convert(v, out);
  }

private:
  template <class Geometry>
  void convert(const Geometry& g, double* out) const
  {
    out[0] = CGAL::to_double(x_(g));
    out[1] = CGAL::to_double(y_(g));
    out[2] = CGAL::to_double(z_(g));
  }

  typename Traits::Compute_x_3 x_;
  typename Traits::Compute_y_3 y_;
  typename Traits::Compute_z_3 z_;
  typename Traits::Point_map point_map_;
  typename Traits::Normal_map normal_map_;
};

inline void start_import(Import& in, std::size_t size, bool has_normals)
{
  if(size > maximum_number_of_points)
    throw std::length_error("the range has " + to_text(size) + " points, at most " + to_text(maximum_number_of_points) +
                            " (2^31) can be handled");
  in.number_of_items = size;
  in.has_normals = has_normals;
  in.coordinates.reset(3 * size);
  if(has_normals)
    in.normals.reset(3 * size);
}

// From the first item that is left out, positions have to be kept.
inline void skip_item(Import& in, std::size_t read, std::size_t kept)
{
  if(!in.item.empty() || kept != read)
    return;
  in.item.reserve(in.number_of_items);
  for(std::size_t i = 0; i < kept; ++i)
    in.item.push_back(std::uint32_t(i));
}

// The caller's range as doubles, the normals of any length, without the points that cannot be used: a
// coordinate is not finite, or the normal is null or not finite.
template <class Traits>
Import read_points(const typename Traits::Point_range& points, typename Traits::Point_map point_map,
                   typename Traits::Normal_map normal_map, const Traits& traits)
{
  Import in;
  start_import(in, std::size_t(points.end() - points.begin()), Traits::has_normal_map);
  const Item_reader<Traits> reader(traits, point_map, normal_map);
  std::size_t read = 0, kept = 0;
  for(auto it = points.begin(); it != points.end(); ++it, ++read) {
    const auto& item = *it;
    double* p = in.coordinates.data() + 3 * kept;
    reader.read_point(item, p);
    const bool has_position = is_finite(p);
    bool is_valid = has_position;
    if constexpr(Traits::has_normal_map) {
      double* n = in.normals.data() + 3 * kept;
      reader.read_normal(item, n);
      is_valid = has_position && is_finite(n) && largest_component(n) > 0;
    }
    if(is_valid) {
      if(kept != read)
        in.item.push_back(std::uint32_t(read));
      ++kept;
    } else {
      skip_item(in, read, kept);
      ++(has_position ? in.number_of_ignored_normals : in.number_of_ignored_coordinates);
    }
  }
  in.count = kept;
  return in;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_IMPORT_CLOUD_H
