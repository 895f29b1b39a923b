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

namespace CGAL {
namespace Tandem {
namespace internal {

// The last count of misfits of a shape: the share of its points that fits the local plane, but not the candidate. Kept,
// so that nearly the same planes are not counted again.
struct Misfit_record {
  Regular_plane local = {}, candidate = {};
  std::int64_t points = 0;
  double misfit_share = 0;
};

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

// The moments are right between two passes; what is fitted to them is older while is_dirty is set. `plane`
// follows the relations, `local` only the points. The box is a bound: it does not shrink when points are detached.
struct Shape : Fitted_moments {
  Box box;
  Regular_plane plane = {};       // local or regular
  Regular_plane checked = {};     // the plane when the points were last checked against it
  Regular_plane restarted = {};   // the plane when the whole shape was last put on the frontier
  std::int64_t retry_count = 0;   // not regularized before it has this many points ...
  std::int64_t layered_count = 0; // points when it was last examined for layers
  std::int64_t regular_count = 0; // points when its relations were found; 0 if it has none yet
  Misfit_record last_misfits;
  int retry_round = 0; // ... or before this round
  int age = 0;         // passes of growth since it began
  int rollbacks = 0;
  int entry = 0;          // its place in the relations when it last had some
  int plane_number = -1;  // of `plane` in the relations; -1 if it has none
  bool is_active = false; // the last pass of growth has added points
  bool is_changed = true; // its points or its plane have changed since its links were collected
  bool is_dirty = true;   // its points have changed since it was fitted
  bool gap = false;       // fills the padding, so that all bytes are defined where shapes are copied

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
CGAL_TANDEM_HD inline void refit_if_dirty(Shape& shape)
{
  if(shape.is_dirty)
    refit(shape);
  shape.is_dirty = false;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_H
