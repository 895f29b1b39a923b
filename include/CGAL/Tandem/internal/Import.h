// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The caller's points as doubles, and on the grid. Plain data: all back ends see it.

#ifndef CGAL_TANDEM_INTERNAL_IMPORT_H
#define CGAL_TANDEM_INTERNAL_IMPORT_H

#include <CGAL/Shape_regularization_tandem/Parameters.h>
#include <CGAL/Tandem/internal/Cloud.h>
#include <CGAL/Tandem/internal/backend/Host_buffer.h>

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
  Grid_point low = {0, 0, 0, no_normal}, high = {0, 0, 0, no_normal}; // corners of the box around them
  Host_buffer<double> coordinates;                                    // 3 a point, as the caller gave them
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

struct Coordinate_box {
  double low[3], high[3];
  double extent() const { return (std::max)((std::max)(high[0] - low[0], high[1] - low[1]), high[2] - low[2]); }
};

inline Coordinate_box box_of(const Import& in, std::size_t first, std::size_t last)
{
  Coordinate_box box;
  for(int c = 0; c < 3; ++c)
    box.low[c] = box.high[c] = in.position(first)[c];
  for(std::size_t i = first; i < last; ++i)
    for(int c = 0; c < 3; ++c) {
      box.low[c] = (std::min)(box.low[c], in.position(i)[c]);
      box.high[c] = (std::max)(box.high[c], in.position(i)[c]);
    }
  return box;
}

// Of at least one point.
template <class Backend>
Coordinate_box bounding_box(Backend& backend, const Import& in)
{
  constexpr std::size_t grain = 65536;
  std::vector<Coordinate_box> boxes((in.size() + grain - 1) / grain);
  backend.for_each_piece(in.size(), grain,
                         [&](std::size_t first, std::size_t last) { boxes[first / grain] = box_of(in, first, last); });
  for(const Coordinate_box& b : boxes)
    for(int c = 0; c < 3; ++c) {
      boxes[0].low[c] = (std::min)(boxes[0].low[c], b.low[c]);
      boxes[0].high[c] = (std::max)(boxes[0].high[c], b.high[c]);
    }
  return boxes[0];
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

// Fills in.grid and the corners of the box.
template <class Backend>
void choose_grid(Backend& backend, Import& in, double epsilon)
{
  if(in.size() == 0)
    return;
  const Coordinate_box box = bounding_box(backend, in);
  in.grid = make_grid(box, epsilon);
  in.low = to_grid(in.grid, 1 / in.grid.step, box.low, no_normal);
  in.high = to_grid(in.grid, 1 / in.grid.step, box.high, no_normal);
}

// Point i on the grid that has been chosen; brings its normal to unit length.
class Place_on_grid {
public:
  explicit Place_on_grid(Import& in) : in_(in), inverse_step_(1 / in.grid.step) {}

  Grid_point operator()(std::size_t i) const
  {
    std::uint32_t code = no_normal;
    if(in_.has_normals) {
      double* m = in_.normals.data() + 3 * i;
      normalize(m);
      code = encode_normal({m[0], m[1], m[2]});
    }
    return to_grid(in_.grid, inverse_step_, in_.position(i), code);
  }

private:
  Import& in_;
  double inverse_step_;
};

// Fills in.grid and in.point, and normalizes in.normals.
template <class Backend>
void place_on_grid(Backend& backend, Import& in, double epsilon)
{
  choose_grid(backend, in, epsilon);
  in.point.reset(in.size());
  const Place_on_grid place(in);
  backend.for_each_on_host(in.size(), [&](std::size_t i) { in.point[i] = place(i); });
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_IMPORT_H
