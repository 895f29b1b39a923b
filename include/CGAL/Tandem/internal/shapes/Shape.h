// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A shape: its points by their moments, its planes, and its history. All lengths are grid steps. The points themselves
// are found by their labels only.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_H
#define CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_H

#include <CGAL/Tandem/internal/base/Box.h>
#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/planes.h>
#include <CGAL/Tandem/internal/shapes/Shape_history.h>

namespace CGAL {
namespace Tandem {
namespace internal {

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

// `plane` follows the relations, `local` only the points. The box is a bound: it does not shrink when points are
// detached.
struct Shape : Fitted_moments {
  Box box;
  Regular_plane plane = {}; // local or regular
  Shape_history history;
  std::int32_t age = 0;           // passes of growth since it began
  std::int32_t entry = 0;         // its place in the relations when it last had some
  std::int32_t plane_number = -1; // of `plane` in the relations; -1 if it has none
  std::int32_t is_active = 0;     // the last pass of growth has added points

  // Ids without points are out of use.
  CGAL_TANDEM_HD bool is_live() const { return moments.count > 0; }
};

// The order by falling number of points, then by id. ids of a table of shapes.
CGAL_TANDEM_HD inline bool is_before(const Shape* shape, std::uint32_t a, std::uint32_t b)
{
  const std::int64_t na = shape[a].moments.count, nb = shape[b].moments.count;
  return na > nb || (na == nb && a < b);
}

// A fit costs an eigenvalue problem, and most shapes do not change in late rounds.
CGAL_TANDEM_HD inline void fit_if_changed(Shape& shape)
{
  if(!shape.history.is_fitted())
    refit(shape);
  shape.history.set_fitted(true);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_H
