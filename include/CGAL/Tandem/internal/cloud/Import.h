// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the caller gave, and the grid it is put on. Plain data: all back ends see it.

#ifndef CGAL_TANDEM_INTERNAL_CLOUD_IMPORT_H
#define CGAL_TANDEM_INTERNAL_CLOUD_IMPORT_H

#include <CGAL/Shape_regularization_tandem/Parameters.h>
#include <CGAL/Tandem/internal/base/Tuning.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/memory/Vector_table.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

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

  // Not of no points.
  double extent() const { return (std::max)((std::max)(high[0] - low[0], high[1] - low[1]), high[2] - low[2]); }
};

CGAL_TANDEM_HD inline double largest_component(const Vector& v)
{
  return std::fmax(std::fmax(std::fabs(v.x), std::fabs(v.y)), std::fabs(v.z));
}

// To unit length, also where the squares overflow or vanish.
CGAL_TANDEM_HD inline Vector normalized(const Vector& v)
{
  const double largest = largest_component(v);
  if(largest < 1e-100 || largest > 1e100)
    return unit({v.x / largest, v.y / largest, v.z / largest});
  return unit(v);
}

// The caller's values, where an engine has taken them while they were read.
class Uploaded_values {
public:
  virtual ~Uploaded_values() = default;
  // Fills the tables of the import, once.
  virtual void bring() = 0;
};

// Of an engine that works where the caller's values are: nothing has to go anywhere.
struct No_upload {
  // What is read at a time, by one thread.
  struct Piece {
    std::size_t size;
    char* values = nullptr; // where to: coordinates, then normals; null: to the tables
  };

  // Of so many points; the memory of the tables has to stay.
  void start(Vector_table&, Vector_table&, std::size_t) {}
  // Of at most so many points.
  Piece begin(std::size_t maximum) { return {maximum}; }
  // The piece holds the points from this one on.
  void end(const Piece&, std::size_t) {}
  std::shared_ptr<Uploaded_values> finish() { return nullptr; }
};

struct Import {
  std::size_t count = 0;                     // valid points: those below, in the caller's order
  Vector_table coordinates;                  // as the caller gave them
  Vector_table normals;                      // the same, of any length; empty if they are to be estimated
  std::vector<std::uint32_t> item;           // position in the caller's range; empty means identity
  std::shared_ptr<Uploaded_values> uploaded; // then the values are in the tables only after bring_values()
  bool has_normals = false;
  Coordinate_box box;

  Grid grid;
  Grid_point low = {0, 0, 0, no_normal}, high = {0, 0, 0, no_normal}; // corners of the box on the grid
  Host_buffer<Grid_point> point;                                      // after put_on_grid()

  std::size_t number_of_items = 0; // of the caller's range
  std::size_t number_of_ignored_coordinates = 0;
  std::size_t number_of_ignored_normals = 0;

  std::size_t size() const { return count; }
  Vector position(std::size_t i) const { return coordinates[i]; }
  Vector normal(std::size_t i) const { return normalized(normals[i]); }
  std::size_t item_of(std::size_t i) const { return item.empty() ? i : item[i]; }

  void bring_values() const
  {
    if(uploaded != nullptr)
      uploaded->bring();
  }

  void drop_upload()
  {
    bring_values();
    uploaded.reset();
  }

  // Of a point and its normal.
  std::size_t value_bytes() const { return coordinates.vector_bytes() * (has_normals ? 2 : 1); }

  // A total order of the points by what the caller gave.
  bool precedes(std::size_t i, std::size_t j) const
  {
    const auto values = [](const Vector& v) { return std::make_tuple(v.x, v.y, v.z); };
    const auto p = values(position(i)), q = values(position(j));
    if(p != q)
      return p < q;
    if(!has_normals)
      return i < j;
    const auto m = values(normal(i)), n = values(normal(j));
    return m != n ? m < n : i < j;
  }
};

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
  const double finest = std::ldexp(1.0, std::ilogb(epsilon) - tuning::grid::steps_per_distance_bits);
  Grid grid;
  for(double step = finest; std::isfinite(box.extent()) && epsilon >= tuning::grid::minimum_steps_per_distance * step;
      step *= 2) {
    if(place_origin(box, step, grid)) {
      grid.is_coarse = step > finest;
      return grid;
    }
  }
  throw std::range_error("maximum_distance is " + to_text(epsilon) + " while the extent of the points is " +
                         to_text(box.extent()) + ": allowed is an extent of up to 2^24 times maximum_distance");
}

// v rounded to the nearest integer, |v| < 2^31. Adding 1.5 x 2^52 leaves no place for fractions.
CGAL_TANDEM_HD inline std::int32_t nearest_integer(double v)
{
  const double magic = 6755399441055744.0;
  const double shifted = v + magic;
  return std::int32_t(shifted - magic);
}

// The step is a power of two, so the product is exact and cells nothing to contract.
CGAL_TANDEM_HD inline Grid_point to_grid(const Grid& grid, double inverse_step, const Vector& p, std::uint32_t normal)
{
  return {nearest_integer((p.x - grid.origin.x) * inverse_step), nearest_integer((p.y - grid.origin.y) * inverse_step),
          nearest_integer((p.z - grid.origin.z) * inverse_step), normal};
}

// Fills in.grid and the corners of the box.
inline void choose_grid(Import& in, double epsilon)
{
  if(in.size() == 0)
    return;
  const Coordinate_box& box = in.box;
  in.grid = make_grid(box, epsilon);
  in.low = to_grid(in.grid, 1 / in.grid.step, {box.low[0], box.low[1], box.low[2]}, no_normal);
  in.high = to_grid(in.grid, 1 / in.grid.step, {box.high[0], box.high[1], box.high[2]}, no_normal);
}

// Of the caller's points, to the grid that has been chosen.
struct Place_on_grid {
  Grid grid;
  double inverse_step;
  Vectors_view coordinates;
  Vectors_view normals; // of any length; may be none
  Grid_point* point;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t normal = normals.data != nullptr ? encode_normal(normalized(normals[i])) : no_normal;
    point[i] = to_grid(grid, inverse_step, coordinates[i], normal);
  }
};

inline Place_on_grid place_on_grid(const Import& in, Grid_point* point)
{
  return {in.grid, 1 / in.grid.step, in.coordinates.view(), in.normals.view(), point};
}

// Fills in.grid and in.point.
template <class Backend>
void put_on_grid(Backend& backend, Import& in, double epsilon)
{
  choose_grid(in, epsilon);
  in.point.reset(in.size());
  backend.for_each(in.size(), place_on_grid(in, in.point.data()));
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CLOUD_IMPORT_H
