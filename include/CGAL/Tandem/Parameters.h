// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_PARAMETERS_H
#define CGAL_TANDEM_PARAMETERS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL::Tandem {

/// \ingroup PkgShapeRegularizationTandemRef
/// the plane a x + b y + c z + d = 0 as the four numbers (a, b, c, d), in double for every kernel
using Coefficients = std::array<double, 4>;

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
  /// angle within which shapes are made parallel or orthogonal where that pays (beta), in [0, 45); none is turned by
  /// more
  double angle_tolerance = 8;
  /// largest offset between parallel planes that are made coplanar where that pays (sigma); none is moved by more
  double maximum_offset = 0;
  /// smallest number of points of a shape
  std::size_t minimum_region_size = 0;
  /// what the size of a shape is worth (mu of the score), in [0, 1]: from every layer and detail to few, large planes
  double simplicity = .08;
  /// what a degree of freedom is worth, in minimum sizes, in [0, 10]: from planes that follow their points to many
  /// relations
  double regularity = .1;
  /// width of the cubes whose points are one surfel while shapes grow, as a fraction of `maximum_distance`, in [0,
  /// 0.55]; 0: each point is a surfel
  double surfel_size = .55;
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
  /// parallel or orthogonal to them where their points allow it, before they are compared with each other. Of
  /// directions that are opposite, or that make an angle of less than 1e-9 radians, only the first counts.
  std::vector<std::array<double, 3>> fixed_directions;
  /// what a degree of freedom is worth that a fixed direction takes, if that is more than `regularity`, in [0, 10]: with 2,
  /// hardly any shape within `angle_tolerance` keeps a direction of its own
  double fixed_regularity = 0;
  /// whether shapes that make nearly the same angle with `symmetry_direction` get exactly the same. Then
  /// `symmetry_direction` is also a fixed direction, unless one of `fixed_directions` is the same direction: that one
  /// takes its place.
  bool regularize_axis_symmetry = false;
  /// the axis of symmetry, of any length
  std::array<double, 3> symmetry_direction = {0, 0, 1};

  /// \cond SKIP_IN_MANUAL
  // For experiments on the alternation: rounds of growth from one regularity step to the next. 1 is the method; with
  // more than there are rounds, shapes are detected first and regularized afterwards.
  std::size_t regularity_period = 1;
  /// \endcond
};

/*!
\ingroup PkgShapeRegularizationTandemRef

is thrown where a parameter is outside of its range. With `Mpi_tag`, all processes throw the same one.
*/
class Parameter_error : public std::invalid_argument {
public:
  /// makes the message "NAME is VALUE, allowed is RANGE".
  Parameter_error(const std::string& name, const std::string& value, const std::string& range)
    : std::invalid_argument(name + " is " + value + ", allowed is " + range), name_(name), value_(value), range_(range)
  {}

  /// returns the name of the named parameter that is outside of its range, such as `maximum_angle`.
  const std::string& name() const { return name_; }
  /// returns the value that was passed, as text.
  const std::string& value() const { return value_; }
  /// returns the allowed values, such as `[0, 45) degrees`.
  const std::string& range() const { return range_; }

private:
  std::string name_, value_, range_;
};

/// \ingroup PkgShapeRegularizationTandemRef
/// a function that gets the progress of a detection, in [0, 1], and cancels the detection by returning `false`
using Callback = std::function<bool(double)>;

/*!
\ingroup PkgShapeRegularizationTandemRef

The stages of a detection, in their order.
*/
enum class Detection_stage {
  sort,      ///< the points are sorted into cells
  neighbors, ///< the neighbors of each point are found
  normals,   ///< normals are estimated where none are given
  seeds,     ///< seeds of growth are chosen
  rounds,    ///< shapes grow, merge and are regularized, round after round
  end_game,  ///< points and shapes move by the score, relations are final, points are verified
  done       ///< the result is complete
};

/// \ingroup PkgShapeRegularizationTandemRef
/// returns the progress, in [0, 1], that a detection reports when it begins the given stage: a constant
inline double first_progress(Detection_stage stage)
{
  constexpr double first[] = {0, .1, .2, .35, .4, .8, 1, 1};
  return first[int(stage)];
}

/// \ingroup PkgShapeRegularizationTandemRef
/// returns the stage that a detection is in when it reports this progress to the callback
inline Detection_stage stage_at(double progress)
{
  int stage = 0;
  while(stage < int(Detection_stage::done) && progress >= first_progress(Detection_stage(stage + 1)))
    ++stage;
  return Detection_stage(stage);
}

/*!
\ingroup PkgShapeRegularizationTandemRef

A note on a `maximum_distance` that `estimate_parameters()` estimated: \ref Tandem_parameters_estimated.
*/
struct Distance_estimate {
  /// a sentence that says why one distance for all points is a compromise; empty if it is none
  std::string note;
  /// whether the reason is that the noise varies over the cloud. Then `estimate_local_distances()` fits better.
  bool noise_varies = false;
};

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

// `place`: which one of several it is, or nothing.
inline void check_direction(const char* name, const std::array<double, 3>& d, const std::string& place = "")
{
  const bool is_finite = std::isfinite(d[0]) && std::isfinite(d[1]) && std::isfinite(d[2]);
  if(!is_finite || (d[0] == 0 && d[1] == 0 && d[2] == 0))
    throw_out_of_range(name, "(" + to_text(d[0]) + ", " + to_text(d[1]) + ", " + to_text(d[2]) + ")" + place,
                       "a finite vector that is not null");
}

inline void check_directions(const Parameters& p)
{
  for(std::size_t i = 0; i < p.fixed_directions.size(); ++i)
    check_direction("fixed_directions", p.fixed_directions[i], " at index " + to_text(i));
  if(p.regularize_axis_symmetry)
    check_direction("symmetry_direction", p.symmetry_direction);
}

// What is to be said of an angle that is also the cosine of an allowed one, as others take it. Otherwise empty.
inline std::string cosine_note(const char* name, double degrees, double largest)
{
  const double meant = std::acos(degrees) * (180 / std::acos(-1.)); // NaN above 1
  if(!(degrees > 0 && meant >= smallest_angle_deg && meant < largest))
    return {};
  return std::string("the ") + name + " is " + to_text(degrees) + " degrees: if that was meant as a cosine, pass " +
         to_text(std::round(10 * meant) / 10);
}

// Those of all angles.
inline std::string angle_note(const Parameters& p)
{
  const std::string of_normals = cosine_note("maximum angle", p.maximum_angle, 90);
  const std::string of_planes = cosine_note("angle tolerance", p.angle_tolerance, 45);
  return of_normals + (of_normals.empty() || of_planes.empty() ? "" : "; ") + of_planes;
}

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemRef

throws `Parameter_error` if one of the parameters is outside of its range. A `maximum_distance` or `minimum_region_size`
of 0, which other functions estimate, is outside of it.
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
  internal::check_weight("simplicity", p.simplicity, internal::largest_simplicity);
  internal::check_weight("regularity", p.regularity, internal::largest_regularity);
  internal::check_weight("fixed_regularity", p.fixed_regularity, internal::largest_regularity);
  internal::check_weight("surfel_size", p.surfel_size, internal::largest_surfel_size);
  internal::check_count(internal::k_neighbors_range, p.k_neighbors);
  internal::check_count(internal::cell_size_range, p.cell_size);
  internal::check_count(internal::regularity_period_range, p.regularity_period);
  internal::check_directions(p);
}

} // namespace CGAL::Tandem

#endif // CGAL_TANDEM_PARAMETERS_H
