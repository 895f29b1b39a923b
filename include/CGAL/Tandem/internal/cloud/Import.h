// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The caller's valid points as read by import_cloud.h, and the choice of the grid they are rounded to. All of it is
// plain data of the host, so back ends share it. A device replaces only the place where the values are kept.

#ifndef CGAL_TANDEM_INTERNAL_CLOUD_IMPORT_H
#define CGAL_TANDEM_INTERNAL_CLOUD_IMPORT_H

#include <CGAL/Tandem/check_parameters.h>
#include <CGAL/Tandem/internal/base/tuning/cloud.h>
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

  // The longest side; -infinity for an empty box.
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
  std::uint64_t points = 0, items = 0, ignored_coordinates = 0, ignored_normals = 0;
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
  Coordinate_box box;

  Grid grid;
  double surfel_edge = 0; // of the cells of surfels, in steps of the grid; 0: each point is a surfel
  Grid_point low = {0, 0, 0, no_normal}, high = {0, 0, 0, no_normal}; // corners of the box on the grid
  Host_buffer<Grid_point> point;                                      // after put_on_grid()

  std::size_t number_of_items = 0; // of the caller's range
  std::size_t number_of_ignored_coordinates = 0;
  std::size_t number_of_ignored_normals = 0;
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

  // Bytes of the values of a point and its normal.
  std::size_t value_bytes() const { return coordinates.vector_bytes() * (has_normals ? 2 : 1); }

  // A total order by coordinates, then normals, for points that are equal on the grid. Their order in the caller's
  // range matters only for exact duplicates, which are interchangeable.
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

// Sets the origin to the middle of the box, counted in steps and rounded down. So it moves with a cloud that moves by
// multiples of the step. Coordinates that are too large to be counted are such multiples. Returns false if the cloud
// does not fit into +-2^28 steps; 4 are kept for rounding.
inline bool place_origin(const Coordinate_box& box, double step, Grid& grid)
{
  double origin[3];
  for(int c = 0; c < 3; ++c) {
    const double low = std::floor(box.low[c] / step);
    const double high = std::floor(box.high[c] / step);
    const double middle = std::floor((low + high) / 2);
    if(box.low[c] == box.high[c] && !std::isfinite(middle)) {
      origin[c] = box.low[c];
      continue;
    }
    if(!(high - low <= double(1 << 29) - 4) || !std::isfinite(middle * step))
      return false;
    origin[c] = middle * step;
  }
  grid.origin = {origin[0], origin[1], origin[2]};
  grid.step = step;
  return true;
}

// The grid of a cloud: epsilon has as many steps as it should, or less where the extent needs a coarser grid. Throws if
// it had less than the fewest, or would have for every epsilon. See the manual, "Grid and Units".
inline Grid make_grid(const Coordinate_box& box, double epsilon)
{
  const double largest = std::ldexp(largest_length, 24);
  if(!(box.extent() <= largest))
    throw std::range_error("the extent of the points is " + to_text(box.extent()) + ": allowed is up to " +
                           to_text(largest) + ", which is 2^24 times the largest maximum_distance");
  const double finest = std::ldexp(1.0, std::ilogb(epsilon) - tuning::grid::steps_per_distance_bits);
  Grid grid;
  for(double step = finest; epsilon >= tuning::grid::minimum_steps_per_distance * step; step *= 2) {
    if(place_origin(box, step, grid)) {
      grid.is_coarse = step > finest;
      return grid;
    }
  }
  throw std::range_error("maximum_distance is " + to_text(epsilon) + " while the extent of the points is " +
                         to_text(box.extent()) + ": allowed is an extent of up to 2^24 times maximum_distance");
}

// v rounded to the nearest integer, |v| < 2^31. Next to 1.5 * 2^52 doubles are integers, so the addition rounds. It
// vectorizes, unlike llrint().
CGAL_TANDEM_HD inline std::int32_t nearest_integer(double v)
{
  const double magic = 6755399441055744.0;
  const double shifted = v + magic;
  return std::int32_t(shifted - magic);
}

// A point in steps of the grid. The step is a power of two, so the products are exact, and contraction to fma cannot
// change a bit.
CGAL_TANDEM_HD inline Grid_point to_grid(const Grid& grid, double inverse_step, const Vector& p, std::uint32_t normal)
{
  return {nearest_integer((p.x - grid.origin.x) * inverse_step), nearest_integer((p.y - grid.origin.y) * inverse_step),
          nearest_integer((p.z - grid.origin.z) * inverse_step), normal};
}

// Fills in.grid and the corners of the box on the grid. Rounding is monotone, so all points lie between them.
// surfel_size: a share of epsilon; 0: each point is a surfel.
inline void choose_grid(Import& in, double epsilon, double surfel_size = 0)
{
  if(!(in.box.extent() >= 0))
    return; // there is no point
  const Coordinate_box& box = in.box;
  in.grid = make_grid(box, epsilon);
  in.surfel_edge = surfel_size * epsilon / in.grid.step;
  in.low = to_grid(in.grid, 1 / in.grid.step, {box.low[0], box.low[1], box.low[2]}, no_normal);
  in.high = to_grid(in.grid, 1 / in.grid.step, {box.high[0], box.high[1], box.high[2]}, no_normal);
}

// The same by the parameters, which are complete. Where all points are neighbors of each other, each is a surfel: even
// three are enough for a plane.
inline void choose_grid(Import& in, const Parameters& p)
{
  choose_grid(in, p.maximum_distance, in.total.points > p.k_neighbors + 1 ? p.surfel_size : 0);
}

// Writes point[i], the imported point i on the grid that has been chosen, with its packed normal. Hosts and devices run
// the same functor, so that their bits are the same.
struct Place_on_grid {
  Grid grid;
  double inverse_step;
  Vectors_view coordinates;
  Vectors_view normals; // of any length; without data where they are to be estimated
  Grid_point* point;

  CGAL_TANDEM_HD Grid_point at(std::size_t i) const
  {
    const std::uint32_t normal = normals.data != nullptr ? encode_normal(normalized(normals[i])) : no_normal;
    return to_grid(grid, inverse_step, coordinates[i], normal);
  }
  CGAL_TANDEM_HD void operator()(std::size_t i) const { point[i] = at(i); }
};

inline Place_on_grid place_on_grid(const Import& in, Grid_point* point)
{
  return {in.grid, 1 / in.grid.step, in.coordinates.view(), in.normals.view(), point};
}

// Fills in.grid and in.point, for callers that need the points of the host in their order.
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
