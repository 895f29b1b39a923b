// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The border on the way in: the caller's range is read once into doubles.

#ifndef CGAL_TANDEM_INTERNAL_IMPORT_CLOUD_H
#define CGAL_TANDEM_INTERNAL_IMPORT_CLOUD_H

#include <CGAL/Tandem/internal/Import.h>

#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <atomic>
#include <type_traits>
#include <vector>

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

enum class Item_state : char { valid, bad_position, bad_normal };

// Reads item i to place i.
template <class Traits>
Item_state read_item(Import& in, std::size_t i, const Item_reader<Traits>& reader,
                     const typename Traits::Point_range& points)
{
  const auto& item = *(points.begin() + std::ptrdiff_t(i));
  double* p = in.coordinates.data() + 3 * i;
  reader.read_point(item, p);
  if(!is_finite(p))
    return Item_state::bad_position;
  if constexpr(Traits::has_normal_map) {
    double* n = in.normals.data() + 3 * i;
    reader.read_normal(item, n);
    if(!is_finite(n) || !(largest_component(n) > 0))
      return Item_state::bad_normal;
  }
  return Item_state::valid;
}

// Closes the gaps, and notes where the points that are left come from.
inline void drop_invalid(Import& in, const std::vector<Item_state>& state)
{
  std::size_t kept = 0;
  for(std::size_t i = 0; i < state.size(); ++i) {
    in.number_of_ignored_coordinates += state[i] == Item_state::bad_position;
    in.number_of_ignored_normals += state[i] == Item_state::bad_normal;
    if(state[i] != Item_state::valid)
      continue;
    std::copy_n(in.coordinates.data() + 3 * i, 3, in.coordinates.data() + 3 * kept);
    if(in.has_normals)
      std::copy_n(in.normals.data() + 3 * i, 3, in.normals.data() + 3 * kept);
    in.item.push_back(std::uint32_t(i));
    ++kept;
  }
  in.count = kept;
}

// The caller's range as doubles, the normals of any length, without the points that cannot be used: a
// coordinate is not finite, or the normal is null or not finite.
template <class Traits, class Backend>
Import read_points(Backend& backend, const typename Traits::Point_range& points, typename Traits::Point_map point_map,
                   typename Traits::Normal_map normal_map, const Traits& traits)
{
  Import in;
  in.count = std::size_t(points.end() - points.begin());
  start_import(in, in.count, Traits::has_normal_map);
  const Item_reader<Traits> reader(traits, point_map, normal_map);
  std::vector<Item_state> state(in.count);
  std::atomic<bool> is_complete(true);
  // Number types that compute lazily are not meant to be read by several threads.
  constexpr bool is_plain = std::is_floating_point<typename Traits::FT>::value;
  backend.for_each_piece(in.count, is_plain ? 16384 : in.count + 1, [&](std::size_t first, std::size_t last) {
    for(std::size_t i = first; i < last; ++i) {
      state[i] = read_item(in, i, reader, points);
      if(state[i] != Item_state::valid)
        is_complete = false;
    }
  });
  if(!is_complete)
    drop_invalid(in, state);
  return in;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_IMPORT_CLOUD_H
