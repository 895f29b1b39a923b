// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_UPWARD_DIRECTION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_UPWARD_DIRECTION_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Tandem/internal/base/angles.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>
#include <CGAL/Tandem/internal/regularity/given_directions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief What `upward_direction()` returns.
*/
struct Upward_direction {
  /// a unit vector
  std::array<double, 3> direction = {0, 0, 1};
  /// of the points of shapes, the fraction in level shapes
  double level = 0;
  /// of the points of shapes, the fraction in upright shapes
  double upright = 0;
  /// whether the shapes show the direction; otherwise it is the expected one
  bool is_found = false;
};

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief returns the direction that is upward at a place by the convention of its coordinates, a unit vector: z, or the
normal of the earth's ellipsoid (WGS 84) if the place is in geocentric coordinates (ECEF, in meters).

Coordinates are taken for geocentric if they are within a few kilometers of the earth's surface, and |z| is above 30 km,
which no height is.
*/
inline std::array<double, 3> expected_upward_direction(const std::array<double, 3>& place)
{
  constexpr double smallest_radius = 6.35e6, largest_radius = 6.39e6, largest_height = 3e4;
  constexpr double squared_ratio_of_axes = 1.00673949674;
  const internal::Vector p = {place[0], place[1], place[2]};
  const double radius = internal::length(p);
  if(!(radius >= smallest_radius && radius <= largest_radius && std::fabs(p.z) > largest_height))
    return {0, 0, 1};
  const internal::Vector n = internal::unit({p.x, p.y, p.z * squared_ratio_of_axes});
  return {n.x, n.y, n.z};
}

namespace internal {

// How the directions of a result lie to an axis.
class Axis_measure {
public:
  explicit Axis_measure(const Shapes_data& data) : sine(sine_deg(data.parameters.angle_tolerance))
  {
    for(const Vector& normal : group_directions(data.parallel_group, data.coefficients))
      directions.push_back({normal, 0, {0, 0, 0}});
    for(std::size_t s = 0; s < data.size.size(); ++s) {
      Direction& d = directions[std::size_t(data.parallel_group[s])];
      const auto& c = data.uncertainty[s].centroid;
      d.points += double(data.size[s]);
      d.sum = add_scaled(d.sum, double(data.size[s]), {c[0], c[1], c[2]});
      points += double(data.size[s]);
    }
    std::stable_sort(directions.begin(), directions.end(),
                     [](const Direction& a, const Direction& b) { return a.points > b.points; });
  }

  struct Fractions {
    double level = 0, upright = 0; // of the points of shapes
    double across = 0;             // upright, of other directions than the one with most points
    double climb = 0;              // from the mean height of level points to that of upright ones, if there are both

    bool are_most() const { return level + upright >= .5; }
    bool have_level() const { return level >= least; }
    bool have_corner() const { return across >= least; }
  };

  Fractions operator()(const Vector& axis) const
  {
    Fractions f;
    double level_sum = 0, upright_sum = 0;
    const Direction* first = nullptr;
    for(const Direction& d : directions)
      if(std::fabs(dot(d.normal, axis)) <= sine) {
        first = first != nullptr ? first : &d;
        f.across += length(cross(d.normal, first->normal)) > sine ? d.points : 0;
        f.upright += d.points;
        upright_sum += dot(d.sum, axis);
      } else if(length(cross(d.normal, axis)) <= sine) {
        f.level += d.points;
        level_sum += dot(d.sum, axis);
      }
    f.climb = upright_sum / (std::max)(f.upright, 1.) - level_sum / (std::max)(f.level, 1.);
    for(double* fraction : {&f.level, &f.upright, &f.across})
      *fraction /= (std::max)(points, 1.);
    return f;
  }

  // The normals that may be upward: those of the directions with enough points.
  std::vector<Vector> candidates() const
  {
    std::vector<Vector> normals;
    for(const Direction& d : directions)
      if(d.points >= least * points)
        normals.push_back(d.normal);
    return normals;
  }

private:
  static constexpr double least = .05; // of the points of shapes: fewer may be aligned by chance

  struct Direction {
    Vector normal;
    double points;
    Vector sum; // of the points
  };

  double sine; // of the angle tolerance
  double points = 0;
  std::vector<Direction> directions; // the one with most points first
};

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief finds the direction upward: that to which most points are level, as floors are, or upright, as walls are, up to
the `angle_tolerance` of the detection.

The result is `expected` if at least half of the points of shapes are level or upright to it, among them level ones, or
upright ones of two directions. (A row of gabled houses has more points upright to its ridges than to z.) Otherwise it is
the normal of a direction to which at least half of the points are so, among them level ones and upright ones of two
directions. If there are several, as in a room, it is the one near y or z with many of such points, as cameras are rarely
turned by more than 45 degrees; of its two ends, the one at which upright points are, on average, higher than level ones,
as walls stand on floors. Otherwise the direction is not found, and the result is `expected`.

With `Mpi_tag`, all processes get the same result, without a message.

\param shapes the result of a detection
\param expected a unit vector, as `expected_upward_direction()` returns it
*/
template <class GeomTraits>
Upward_direction upward_direction(const Planar_shapes_3<GeomTraits>& shapes,
                                  const std::array<double, 3>& expected = {0, 0, 1})
{
  using internal::Vector;
  const internal::Axis_measure measure(shapes.data());
  const auto result = [](const Vector& up, const internal::Axis_measure::Fractions& f, bool is_found) { // no -0
    return Upward_direction{{up.x + 0., up.y + 0., up.z + 0.}, f.level, f.upright, is_found};
  };
  const Vector by_convention = {expected[0], expected[1], expected[2]};
  const auto of_convention = measure(by_convention);
  Upward_direction best =
    result(by_convention, of_convention,
           of_convention.are_most() && (of_convention.have_level() || of_convention.have_corner()));
  double largest = 0;
  if(!best.is_found)
    for(const Vector& axis : measure.candidates())
      if(const auto f = measure(axis); f.are_most() && f.have_level() && f.have_corner()) {
        const double value = (f.level + f.upright) * (std::max)(std::fabs(axis.y), std::fabs(axis.z));
        if(value > largest)
          best = result(f.climb < 0 ? -axis : axis, f, true);
        largest = (std::max)(largest, value);
      }
  return best;
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_UPWARD_DIRECTION_H
