// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_PARAMETERS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_PARAMETERS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL {
namespace Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

The resolved parameters of a detection. Lengths are in the units of the input,
angles in degrees.
*/
struct Parameters {
  /// largest distance of a point to the plane of its shape (epsilon of the paper)
  double maximum_distance = 0;
  /// largest angle between the normal of a point and that of its shape (alpha), in [0.05, 90)
  double maximum_angle = 25;
  /// angle within which shapes are made parallel or orthogonal (beta), in [0, 45)
  double angle_tolerance = 8;
  /// largest offset between parallel planes that are made coplanar (sigma)
  double maximum_offset = 0;
  /// smallest number of points of a shape
  std::size_t minimum_region_size = 0;
  /// number of neighbors of a point (k), in [3, 64]
  std::size_t k_neighbors = 12;
  /// largest number of points of an octree cell, in [64, 65536]
  std::size_t cell_size = 8192;
  /// whether shapes of nearly the same direction are made parallel
  bool regularize_parallelism = true;
  /// whether directions at nearly a right angle are made orthogonal
  bool regularize_orthogonality = true;
  /// whether parallel shapes of nearly the same plane are made coplanar
  bool regularize_coplanarity = true;
  /// directions known beforehand, such as the vertical, of any length: shapes within `angle_tolerance` become exactly
  /// parallel or orthogonal to them where their points allow it, before they are compared with each other. Directions
  /// are one, the first of them, if they are opposite or make an angle of less than 1e-9 radians.
  std::vector<std::array<double, 3>> fixed_directions;
  /// whether shapes get the same angle to `symmetry_direction` where they nearly have it. That direction is a fixed
  /// one, too; it is the first of `fixed_directions` that is one with it.
  bool regularize_axis_symmetry = false;
  /// the axis of symmetry, of any length
  std::array<double, 3> symmetry_direction = {0, 0, 1};

  /// \cond SKIP_IN_MANUAL
  // For experiments on the alternation: rounds of growth from one regularity step to the next. 1 is the method; with
  // more than there are rounds, shapes are detected first and regularized afterwards.
  std::size_t regularity_period = 1;
  /// \endcond
};

/// progress in [0, 1]; returning `false` cancels.
using Callback = std::function<bool(double)>;

namespace internal {

// The same text whatever the locale of the program is.
template <class T>
std::string to_text(const T& value)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << value;
  return out.str();
}

template <class T>
[[noreturn]] void throw_out_of_range(const char* name, const T& value, const std::string& range)
{
  throw std::invalid_argument(std::string(name) + " is " + to_text(value) + ", allowed is " + range);
}

// The bounds of lengths. Shorter ones have no grid of normalized doubles.
inline constexpr double smallest_length = 1e-270, largest_length = 1e270;

// Degrees. Normals are packed, which turns them by up to .0037 degrees. The integer test turns them by .0053 more, as
// squared cosines of small angles differ little. The exact test demands a cosine that is larger than that of the angle
// by tuning::exactness::rounded_normal_margin. Below .0363 degrees no cosine is that large.
inline constexpr double smallest_angle_deg = 0.05;

// For estimates, which follow the unit of the points and need not be within the bounds.
inline double bounded_length(double length) { return (std::min)((std::max)(length, smallest_length), largest_length); }

// Written so that NaN is rejected.
inline void check_length(const char* name, double value, double smallest)
{
  if(!(value >= smallest) || value > largest_length)
    throw_out_of_range(name, value,
                       smallest > 0 ? "(0, infinity), and [1e-270, 1e270] in practice"
                                    : "[0, infinity), and at most 1e270 in practice");
}

constexpr std::size_t maximum_number_of_points = std::size_t(1) << 31;

// The allowed values of a number.
struct Count_range {
  const char* name;
  std::size_t smallest, largest;
};

inline constexpr Count_range minimum_region_size_range = {"minimum_region_size", 3, maximum_number_of_points};
inline constexpr Count_range k_neighbors_range = {"k_neighbors", 3, 64};
inline constexpr Count_range cell_size_range = {"cell_size", 64, 65536};
inline constexpr Count_range regularity_period_range = {"regularity_period", 1, maximum_number_of_points};

inline std::string to_text(const Count_range& range)
{
  return "[" + to_text(range.smallest) + ", " + to_text(range.largest) + "]";
}

inline void check_count(const Count_range& range, std::size_t value)
{
  if(value < range.smallest || value > range.largest)
    throw_out_of_range(range.name, value, to_text(range));
}

inline void check_direction(const std::string& name, const std::array<double, 3>& d)
{
  const bool is_finite = std::isfinite(d[0]) && std::isfinite(d[1]) && std::isfinite(d[2]);
  if(!is_finite || (d[0] == 0 && d[1] == 0 && d[2] == 0))
    throw_out_of_range(name.c_str(), "(" + to_text(d[0]) + ", " + to_text(d[1]) + ", " + to_text(d[2]) + ")",
                       "a finite vector that is not null");
}

inline void check_directions(const Parameters& p)
{
  for(std::size_t i = 0; i < p.fixed_directions.size(); ++i)
    check_direction("fixed_directions[" + to_text(i) + "]", p.fixed_directions[i]);
  if(p.regularize_axis_symmetry)
    check_direction("symmetry_direction", p.symmetry_direction);
}

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemRef

throws `std::invalid_argument`, which names the parameter, its value and the allowed range, if one of
the parameters is outside of it. Estimated parameters must be resolved before.
*/
inline void check_parameters(const Parameters& p)
{
  internal::check_length("maximum_distance", p.maximum_distance, internal::smallest_length);
  if(!(p.maximum_angle >= internal::smallest_angle_deg && p.maximum_angle < 90))
    internal::throw_out_of_range("maximum_angle", p.maximum_angle,
                                 "[" + internal::to_text(internal::smallest_angle_deg) +
                                   ", 90) degrees: smaller angles are below the rounding of normals");
  if(!(p.angle_tolerance >= 0 && p.angle_tolerance < 45))
    internal::throw_out_of_range("angle_tolerance", p.angle_tolerance, "[0, 45) degrees");
  internal::check_length("maximum_offset", p.maximum_offset, 0);
  internal::check_count(internal::minimum_region_size_range, p.minimum_region_size);
  internal::check_count(internal::k_neighbors_range, p.k_neighbors);
  internal::check_count(internal::cell_size_range, p.cell_size);
  internal::check_count(internal::regularity_period_range, p.regularity_period);
  internal::check_directions(p);
}

} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_PARAMETERS_H
