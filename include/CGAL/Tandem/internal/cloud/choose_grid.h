// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The grid of a cloud: as fine as the tolerances of its points need, or as its extent permits. And the points on it. See
// the manual, "Grid and Units".

#ifndef CGAL_TANDEM_INTERNAL_CLOUD_CHOOSE_GRID_H
#define CGAL_TANDEM_INTERNAL_CLOUD_CHOOSE_GRID_H

#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/internal/base/tuning/cloud.h>
#include <CGAL/Tandem/internal/cloud/Import.h>

#include <algorithm>
#include <cmath>

namespace CGAL::Tandem::internal {

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
  throw_out_of_range("maximum_distance", epsilon,
                     "at least " + to_text(std::ldexp(box.extent(), -24)) + ": the extent of the points, " +
                       to_text(box.extent()) + ", divided by 2^24");
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

// By how many octaves the smallest tolerance is smaller than epsilon: as far as the grid is not coarser for it, and cells
// of surfels are not too many.
inline int octaves_of_tolerances(const Import& in, double epsilon)
{
  int octaves = 0;
  while(octaves < tuning::grid::maximum_octaves && std::ldexp(epsilon, -octaves) > in.smallest_tolerance &&
        in.box.extent() < std::ldexp(epsilon, tuning::grid::fine_extent_bits - octaves - 1))
    ++octaves;
  return in.has_tolerances ? octaves : 0;
}

// Fills in.grid and the corners of the box on the grid. Rounding is monotone, so all points lie between them.
// surfel_size: a fraction of epsilon; 0: each point is a surfel.
inline void choose_grid(Import& in, double epsilon, double surfel_size = 0)
{
  if(!(in.box.extent() >= 0))
    return; // there is no point
  const Coordinate_box& box = in.box;
  const int octaves = octaves_of_tolerances(in, epsilon);
  in.grid = make_grid(box, std::ldexp(epsilon, -octaves));
  in.epsilon = epsilon;
  in.surfel_cells = {surfel_size * epsilon / in.grid.step, octaves};
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

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CLOUD_CHOOSE_GRID_H
