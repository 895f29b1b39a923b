// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether one plane fits two shapes as well as their own planes, by their moments alone.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_JOINT_FIT_CRITERION_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_JOINT_FIT_CRITERION_H

#include <CGAL/Tandem/internal/base/Tuning.h>
#include <CGAL/Tandem/internal/shapes/Shape.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {

// How much the sum of squared distances grows when the shape gives up its local plane.
inline double excess(const Scatter& scatter, const Fit& fit, const Regular_plane& plane)
{
  const double e = dot(plane.normal, scatter.centroid) - plane.offset;
  return std::fma(scatter.count * e, e, quadratic_form(scatter.matrix, plane.normal)) - fit.smallest;
}

// Of moments only: no point is looked at.
struct Joint_fit_criterion {
  double squared_cosine;
  double maximum_distance;

  bool are_aligned(const Fitted_moments& a, const Fitted_moments& b) const
  {
    const double cosine = dot(a.fit.normal, b.fit.normal);
    return (std::min)(a.moments.count, b.moments.count) <= tuning::merging::reliable_normal_size ||
           cosine * cosine >= squared_cosine;
  }

  bool is_tolerable(const Fitted_moments& m, const Regular_plane& plane) const
  {
    return excess(m.scatter, m.fit, plane) <= maximum_excess(m);
  }

  bool operator()(const Fitted_moments& a, const Fitted_moments& b, Fitted_moments& joint) const
  {
    return !are_apart(a, b) && fit(a, b, joint);
  }

  // Whether it is certain, at less cost, that fit() refuses them and that neither tolerates the plane of the other.
  // Otherwise the sum of squared distances of all points to one plane, and so the smallest eigenvalue of their scatter
  // matrix, would be at most `most`. The margins, relative to that and to the extent, are for rounding.
  bool are_apart(const Fitted_moments& a, const Fitted_moments& b) const
  {
    const Symmetric_matrix joint = joint_matrix(a.scatter, b.scatter);
    const double maximum = a.fit.smallest + maximum_excess(a) + b.fit.smallest + maximum_excess(b);
    return has_eigenvalues_above(joint, std::fma(1e-8, joint.xx + joint.yy + joint.zz, 1.000001 * maximum));
  }

  bool fit(const Fitted_moments& a, const Fitted_moments& b, Fitted_moments& joint) const
  {
    joint.moments = a.moments;
    joint.moments += b.moments;
    refit(joint);
    return is_tolerable(a, joint.local) && is_tolerable(b, joint.local);
  }

private:
  // How much the sum of squared distances may grow.
  double maximum_excess(const Fitted_moments& m) const
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
