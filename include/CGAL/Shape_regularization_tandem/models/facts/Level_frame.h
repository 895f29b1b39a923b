// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How planes lie to the level: inclination, and direction of the compass.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_LEVEL_FRAME_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_LEVEL_FRAME_H

#include <CGAL/Tandem/internal/base/angles.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace facts {

inline double degrees(double radians) { return radians / angles::radians_per_degree; }

// In degrees.
struct Slope {
  double tilt, dip, azimuth;
};

// The upward direction, and north and east: the axes z, y and x after the smallest rotation that takes z upward.
class Level_frame {
public:
  explicit Level_frame(const Vector& up) : up(up)
  {
    const double share = up.z > -1 ? up.y / (1 + up.z) : 0;
    north = unit(Vector{-share * up.x, 1 - share * up.y, -up.y});
    east = cross(north, up);
  }

  double height(const Vector& p) const { return dot(up, p); }

  // Of a plane whose outward unit normal this is. Planes that were made level or vertical are so up to rounding, which
  // must not choose their azimuth.
  Slope slope(const Vector& normal) const
  {
    const double cosine = dot(up, normal);
    const Vector level = add_scaled(normal, -cosine, up);
    const double sine = length(level);
    if(sine <= rounding)
      return {cosine < 0 ? 180. : 0., 0, 0};
    if(std::fabs(cosine) <= rounding)
      return {90, 90, azimuth(level)};
    const double tilt = degrees(std::atan2(sine, cosine));
    return {tilt, (std::min)(tilt, 180 - tilt), azimuth(cosine > 0 ? level : -level)};
  }

private:
  static constexpr double rounding = 1e-12; // of a cosine

  double azimuth(const Vector& direction) const
  {
    const double angle = degrees(std::atan2(dot(east, direction), dot(north, direction)));
    const double turned = angle < 0 ? angle + 360 : angle;
    return turned < 360 ? turned + 0. : 0; // no -0
  }

  Vector up, north, east;
};

} // namespace facts
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_LEVEL_FRAME_H
