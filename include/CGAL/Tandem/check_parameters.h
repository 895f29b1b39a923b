// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ranges of the parameters, and exceptions for values outside of them.

#ifndef CGAL_TANDEM_CHECK_PARAMETERS_H
#define CGAL_TANDEM_CHECK_PARAMETERS_H

#include <CGAL/Tandem/Parameter_error.h>
#include <CGAL/Tandem/Parameters.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <locale>
#include <sstream>
#include <string>

namespace CGAL::Tandem {

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
  throw Parameter_error(name, to_text(value), range);
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
                       smallest > 0 ? "a length above 0 (from 1e-270 to 1e270)" : "a length from 0 to 1e270");
}

// Written so that NaN is rejected.
inline void check_weight(const char* name, double value, double largest)
{
  if(!(value >= 0 && value <= largest))
    throw_out_of_range(name, value, "[0, " + to_text(largest) + "]");
}

// A shape that is twice as large is worth as much more for each of its points as the point is by its fit at best ...
inline constexpr double largest_simplicity = 1;
// ... and a degree of freedom as much as all points of its largest shape.
inline constexpr double largest_regularity = 10;

// Two layers 1.1 epsilon apart then share no surfel: its points are within one cell, whose diagonal is .96 epsilon, or
// within .55 epsilon of its center.
inline constexpr double largest_surfel_size = .55;

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

/*!
\ingroup PkgShapeRegularizationTandemRef

throws `Parameter_error` if one of the parameters is outside of its range. Estimated parameters must be resolved before.
*/
inline void check_parameters(const Parameters& p)
{
  check_length("maximum_distance", p.maximum_distance, smallest_length);
  if(!(p.maximum_angle >= smallest_angle_deg && p.maximum_angle < 90))
    throw_out_of_range("maximum_angle", p.maximum_angle,
                       "[" + to_text(smallest_angle_deg) +
                         ", 90) degrees: smaller angles are below the rounding of normals");
  if(!(p.angle_tolerance >= 0 && p.angle_tolerance < 45))
    throw_out_of_range("angle_tolerance", p.angle_tolerance, "[0, 45) degrees");
  check_length("maximum_offset", p.maximum_offset, 0);
  check_count(minimum_region_size_range, p.minimum_region_size);
  check_weight("simplicity", p.simplicity, largest_simplicity);
  check_weight("regularity", p.regularity, largest_regularity);
  check_weight("surfel_size", p.surfel_size, largest_surfel_size);
  check_count(k_neighbors_range, p.k_neighbors);
  check_count(cell_size_range, p.cell_size);
  check_count(regularity_period_range, p.regularity_period);
  check_directions(p);
}

// What is to be said of an angle that is also the cosine of an allowed one, as others take it. Otherwise empty.
inline std::string cosine_note(const char* name, double degrees, double largest)
{
  const double meant = std::acos(degrees) * (180 / std::acos(-1.)); // NaN above 1
  if(!(degrees > 0 && meant >= smallest_angle_deg && meant < largest))
    return {};
  return std::string(name) + " is " + to_text(degrees) + " degrees: if that was meant as a cosine, pass " +
         to_text(std::round(10 * meant) / 10);
}

// Those of all angles.
inline std::string angle_note(const Parameters& p)
{
  const std::string of_normals = cosine_note("maximum_angle", p.maximum_angle, 90);
  const std::string of_planes = cosine_note("angle_tolerance", p.angle_tolerance, 45);
  return of_normals + (of_normals.empty() || of_planes.empty() ? "" : "; ") + of_planes;
}

} // namespace CGAL::Tandem

#endif // CGAL_TANDEM_CHECK_PARAMETERS_H
