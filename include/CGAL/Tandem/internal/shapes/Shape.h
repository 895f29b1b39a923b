// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A shape: its points by their moments, its planes, and its history. All lengths are grid steps. The points themselves
// are found by their labels only.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_H
#define CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_H

#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/tuning/growth.h>
#include <CGAL/Tandem/internal/base/tuning/regularity.h>
#include <CGAL/Tandem/internal/base/planes.h>

#include <cstddef>
#include <cstdint>

namespace CGAL::Tandem::internal {

// Shapes that are worth a thread: what is done for one is a fit, at most.
constexpr std::size_t shapes_per_thread = 32;

// Points, with the plane that fits them best. The moments are exact, so the fit is the same for any order of the
// points.
struct Fitted_moments {
  Moments moments;
  Scatter scatter;          // of moments, with ...
  Fit fit;                  // ... its local plane
  Regular_plane local = {}; // the local plane again
};

// The fit has to be that of the scatter.
CGAL_TANDEM_HD inline void set_fit(Fitted_moments& m, const Fit& fit)
{
  m.fit = fit;
  m.local = plane_through(fit.normal, m.scatter.centroid);
}

// Makes all that follows from the moments.
CGAL_TANDEM_HD inline void refit(Fitted_moments& m)
{
  m.scatter = make_scatter(m.moments);
  set_fit(m, fit_plane(m.scatter));
}

// Of the points, where these have tolerances of their own: the root of the mean square.
CGAL_TANDEM_HD inline Tolerance mean_tolerance(const Fitted_moments& m, const Tolerance& t)
{
  const std::int64_t distance = std::int64_t(double(t.distance) * std::sqrt(m.scatter.squared_tolerance));
  return {distance > 1 ? distance : 1, t.squared_cosine};
}

// What the stages have noted of a shape, to tell later whether it has moved or grown since.
struct Shape_history {
  Regular_plane checked = {};   // against which its surfels were checked last, and ...
  Regular_plane restarted = {}; // ... with which the shape grew from all of its surfels last
  std::int32_t is_fitted = 0;   // its plane is fitted to the points that it has
  std::int32_t is_linked = 0;   // its links are those of its points and plane; wide, so that all bytes are defined

  // Whether its plane has moved since its surfels were checked against it. Then they are checked again, and linked.
  CGAL_TANDEM_HD bool check_again(const Box& box, const Regular_plane& plane, double maximum_distance_steps)
  {
    if(!(bound_motion(box, checked, plane) > tuning::motion::negligible * maximum_distance_steps))
      return false;
    checked = plane;
    is_linked = false;
    return true;
  }

  // Whether its plane has moved far since it grew from all of its surfels.
  CGAL_TANDEM_HD bool restart_again(const Box& box, const Regular_plane& plane, double maximum_distance_steps)
  {
    if(!(bound_motion(box, restarted, plane) > tuning::motion::restart * maximum_distance_steps))
      return false;
    restarted = plane;
    return true;
  }
};

// `plane` follows the relations, `local` only the points. The box is a bound: it does not shrink when points are
// detached.
struct Shape : Fitted_moments {
  Box box;
  Regular_plane plane = {}; // local or regular
  Shape_history history;
  std::int32_t age = 0;           // passes of growth since it began
  std::int32_t plane_number = -1; // of `plane` in the relations; -1 if it has none
  std::int32_t is_active = 0;     // the last pass of growth has added points

  // The mean tolerance of its points, where these have tolerances of their own, in steps.
  CGAL_TANDEM_HD double mean_distance_steps(double maximum_distance_steps) const
  {
    return maximum_distance_steps * std::sqrt(squared_tolerance(moments));
  }

  // Ids without points are out of use.
  CGAL_TANDEM_HD bool is_live() const { return moments.count > 0; }
};

// The order by falling number of points, then by id. ids of a table of shapes.
CGAL_TANDEM_HD inline bool is_before(const Shape* shape, std::uint32_t a, std::uint32_t b)
{
  const std::int64_t na = shape[a].moments.count, nb = shape[b].moments.count;
  return na > nb || (na == nb && a < b);
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_H
