// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Decides whether one plane fits two shapes as well as their own planes, by their moments alone. Changes nothing. See
// the manual, "Merging by Joint Fit". Lengths are grid steps.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_JOINT_FIT_CRITERION_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_JOINT_FIT_CRITERION_H

#include <CGAL/Tandem/internal/base/tuning/exactness.h>
#include <CGAL/Tandem/internal/base/tuning/merging.h>
#include <CGAL/Tandem/internal/shapes/Shape.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {

// How much the sum of squared distances of a shape grows if this plane replaces its local one.
CGAL_TANDEM_HD inline double excess(const Scatter& scatter, const Fit& fit, const Regular_plane& plane)
{
  const double e = dot(plane.normal, scatter.centroid) - plane.offset;
  return std::fma(scatter.count * e, e, quadratic_form(scatter.matrix, plane.normal)) - fit.smallest;
}

// What the test says of two shapes.
struct Verdict {
  bool is_accepted = false;
  bool is_taken = false; // the smaller one tolerates the plane of the larger one as it is
  double cost = 0;       // how much the sum of squared distances grows by the union
};

// The cost does not depend on the number of points. No point is read.
struct Joint_fit_criterion {
  double squared_cosine;   // of alpha
  double maximum_distance; // epsilon

  // The first shape is the larger one. A much smaller shape that is nearly as close to its plane needs no new fit.
  CGAL_TANDEM_HD Verdict verdict(const Fitted_moments& a, const Fitted_moments& b) const
  {
    if(!are_aligned(a, b))
      return {};
    if(tuning::merging::much_larger * b.moments.count < a.moments.count && is_tolerable(b, a.local))
      return {true, true, excess(b.scatter, b.fit, a.local)};
    Fitted_moments joint;
    if(!(*this)(a, b, joint))
      return {};
    return {true, false, joint.fit.smallest - a.fit.smallest - b.fit.smallest};
  }

  // The normal of a shape of few points is too uncertain to keep it apart.
  CGAL_TANDEM_HD bool are_aligned(const Fitted_moments& a, const Fitted_moments& b) const
  {
    const double cosine = dot(a.fit.normal, b.fit.normal);
    return (std::min)(a.moments.count, b.moments.count) <= tuning::merging::reliable_normal_size ||
           cosine * cosine >= squared_cosine;
  }

  // Whether the points of m are nearly as close to the plane as to their own.
  CGAL_TANDEM_HD bool is_tolerable(const Fitted_moments& m, const Regular_plane& plane) const
  {
    return excess(m.scatter, m.fit, plane) <= maximum_excess(m);
  }

  // Whether they pass the test; then `joint` has moments and plane of both.
  CGAL_TANDEM_HD bool operator()(const Fitted_moments& a, const Fitted_moments& b, Fitted_moments& joint) const
  {
    return !are_apart(a, b) && fit(a, b, joint);
  }

  // Whether it is certain, at less cost, that fit() rejects them and that neither tolerates the plane of the other. If
  // either tolerated it, one plane would have at most `maximum` as the sum of squared distances of all points. Then the
  // smallest eigenvalue of their scatter matrix would be at most that, too. The margins, relative to that and to the
  // extent, are for rounding.
  CGAL_TANDEM_HD bool are_apart(const Fitted_moments& a, const Fitted_moments& b) const
  {
    const Symmetric_matrix joint = joint_matrix(a.scatter, b.scatter);
    const double maximum = a.fit.smallest + maximum_excess(a) + b.fit.smallest + maximum_excess(b);
    const double trace = joint.xx + joint.yy + joint.zz;
    return has_eigenvalues_above(
      joint, std::fma(tuning::exactness::eigenvalue_margin, trace, tuning::exactness::bound_factor * maximum));
  }

  // Without the cheap test before.
  CGAL_TANDEM_HD bool fit(const Fitted_moments& a, const Fitted_moments& b, Fitted_moments& joint) const
  {
    joint.moments = a.moments;
    joint.moments += b.moments;
    refit(joint);
    return is_tolerable(a, joint.local) && is_tolerable(b, joint.local);
  }

private:
  // How much the sum of squared distances may grow: the smaller of both bounds of the manual. The second one keeps a
  // plane from bridging two narrow strips.
  CGAL_TANDEM_HD double maximum_excess(const Fitted_moments& m) const
  {
    const double maximum = tuning::merging::tolerated_rms * maximum_distance;
    const double little = tuning::merging::negligible_rms * maximum_distance;
    return (std::min)(maximum * maximum * m.scatter.count, std::fma(little * little, m.scatter.count, m.fit.smallest));
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_JOINT_FIT_CRITERION_H
