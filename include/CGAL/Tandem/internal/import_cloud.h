// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The border on the way in: the caller's range is read once into doubles, then
// put on the grid. Only the reading knows CGAL types.

#ifndef CGAL_TANDEM_INTERNAL_IMPORT_CLOUD_H
#define CGAL_TANDEM_INTERNAL_IMPORT_CLOUD_H

#include <CGAL/Shape_regularization_tandem/Parameters.h>
#include <CGAL/Tandem/internal/Cloud.h>
#include <CGAL/Tandem/internal/backend/Host_buffer.h>

#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Import {
  Grid grid;
  std::size_t count = 0; // valid points: those below, in the caller's order
  Host_buffer<Grid_point> point;
  Host_buffer<double> coordinates; // 3 a point, as the caller gave them
  Host_buffer<double> normals;     // 3 a point, of unit length; empty if they are to be estimated
  std::vector<std::uint32_t> item; // position in the caller's range; empty means identity
  bool has_normals = false;

  std::size_t number_of_items = 0; // of the caller's range
  std::size_t number_of_ignored_coordinates = 0;
  std::size_t number_of_ignored_normals = 0;

  std::size_t size() const { return count; }
  const double* position(std::size_t i) const { return coordinates.data() + 3 * i; }
  const double* normal(std::size_t i) const { return normals.data() + 3 * i; }
  std::size_t item_of(std::size_t i) const { return item.empty() ? i : item[i]; }

  // A total order of the points by what the caller gave.
  bool precedes(std::size_t i, std::size_t j) const
  {
    for(const Host_buffer<double>* values : {&coordinates, &normals})
      for(std::size_t c = 0; values->size() > 0 && c < 3; ++c) {
        const double a = (*values)[3 * i + c], b = (*values)[3 * j + c];
        if(a != b)
          return a < b;
      }
    return i < j;
  }
};

inline bool is_finite(const double* v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

inline double largest_component(const double* v)
{
  return (std::max)((std::max)(std::fabs(v[0]), std::fabs(v[1])), std::fabs(v[2]));
}

// To unit length, also where the squares overflow or vanish.
inline void normalize(double* v)
{
  const double largest = largest_component(v);
  if(largest < 1e-100 || largest > 1e100)
    for(int c = 0; c < 3; ++c)
      v[c] /= largest;
  const Vector n = unit({v[0], v[1], v[2]});
  v[0] = n.x;
  v[1] = n.y;
  v[2] = n.z;
}

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

struct Coordinate_box {
  double low[3], high[3];
  double extent() const { return (std::max)((std::max)(high[0] - low[0], high[1] - low[1]), high[2] - low[2]); }
};

// Of at least one point.
inline Coordinate_box bounding_box(const Import& in)
{
  Coordinate_box box;
  for(int c = 0; c < 3; ++c)
    box.low[c] = box.high[c] = in.coordinates[c];
  for(std::size_t i = 0; i < in.size(); ++i)
    for(int c = 0; c < 3; ++c) {
      box.low[c] = (std::min)(box.low[c], in.position(i)[c]);
      box.high[c] = (std::max)(box.high[c], in.position(i)[c]);
    }
  return box;
}

// The origin is the middle of the box, counted in steps and rounded down, so that
// it moves with a cloud that moves by multiples of the step. False if the cloud
// does not fit into +- 2^28 steps.
inline bool place_origin(const Coordinate_box& box, double step, Grid& grid)
{
  double origin[3];
  for(int c = 0; c < 3; ++c) {
    const double low = std::floor(box.low[c] / step);
    const double high = std::floor(box.high[c] / step);
    const double middle = std::floor((low + high) / 2);
    if(!(high - low <= double(1 << 29) - 4) || !std::isfinite(middle * step))
      return false;
    origin[c] = middle * step;
  }
  grid.origin = {origin[0], origin[1], origin[2]};
  grid.step = step;
  return true;
}

// epsilon has 1024 to 2047 steps; at least 16 where the extent asks for a coarser grid.
inline Grid make_grid(const Coordinate_box& box, double epsilon)
{
  const double finest = std::ldexp(1.0, std::ilogb(epsilon) - 10);
  Grid grid;
  for(double step = finest; std::isfinite(box.extent()) && epsilon >= 16 * step; step *= 2) {
    if(place_origin(box, step, grid)) {
      grid.is_coarse = step > finest;
      return grid;
    }
  }
  throw std::range_error("maximum_distance is " + to_text(epsilon) + " while the extent of the points is " +
                         to_text(box.extent()) + ": allowed is an extent of up to 2^24 times maximum_distance");
}

// v rounded to the nearest integer, |v| < 2^31. Adding 1.5 x 2^52 leaves no place for fractions.
inline std::int32_t nearest_integer(double v)
{
  const double magic = 6755399441055744.0;
  const double shifted = v + magic;
  return std::int32_t(shifted - magic);
}

inline Grid_point to_grid(const Grid& grid, double inverse_step, const double* p, std::uint32_t normal)
{
  return {nearest_integer((p[0] - grid.origin.x) * inverse_step),
          nearest_integer((p[1] - grid.origin.y) * inverse_step),
          nearest_integer((p[2] - grid.origin.z) * inverse_step), normal};
}

// Fills in.grid and in.point, and normalizes in.normals.
template <class Backend>
void place_on_grid(Backend& backend, Import& in, double epsilon)
{
  in.point.reset(in.size());
  if(in.size() == 0)
    return;
  in.grid = make_grid(bounding_box(in), epsilon);
  const double inverse_step = 1 / in.grid.step;
  backend.for_each(in.size(), [&in, inverse_step](std::size_t i) {
    std::uint32_t code = no_normal;
    if(in.has_normals) {
      double* m = in.normals.data() + 3 * i;
      normalize(m);
      code = encode_normal({m[0], m[1], m[2]});
    }
    in.point[i] = to_grid(in.grid, inverse_step, in.position(i), code);
  });
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_IMPORT_CLOUD_H
