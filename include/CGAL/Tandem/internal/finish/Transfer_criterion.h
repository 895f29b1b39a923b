// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a shape gives points to a larger one: decided on their planes, scatters and counts of points. See the manual,
// "Transfer to Larger Planes".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_TRANSFER_CRITERION_H
#define CGAL_TANDEM_INTERNAL_FINISH_TRANSFER_CRITERION_H

#include <CGAL/Tandem/internal/base/tuning/finish.h>
#include <CGAL/Tandem/internal/rounds/Joint_fit_criterion.h>

#include <cmath>
#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {

// Two shapes: points of the first may go to the second, which comes before it in the order by falling number of points,
// then by id. So nothing goes in circles. Where planes may change, a shape that may take points has a query with
// itself, too: for the points that its planes keep.
struct Transfer_query {
  std::uint32_t from, to;
  Plane before, after; // the plane of the second one, and its local plane
};

// The tests of a shape against the plane of another one. All lengths are grid steps.
struct Transfer_criterion {
  const Shape* shape;
  double maximum_distance;
  bool may_change; // planes

  // Whether shape s may take points of t: by its plane, or by its local plane if planes may change.
  CGAL_TANDEM_HD bool may_take(std::uint32_t s, std::uint32_t t) const
  {
    const bool are_of_one_plane = shape[t].plane_number >= 0 && shape[t].plane_number == shape[s].plane_number;
    return !are_of_one_plane && (may_explain(t, shape[s].plane) || (may_change && may_explain(t, shape[s].local)));
  }

  // The points that the first shape of a query would give, of so many that fit: none if they are too few, or a layer.
  // after: to the local plane of the second one.
  CGAL_TANDEM_HD std::int64_t explained(const Transfer_query& q, bool after, std::int64_t fitting) const
  {
    if(q.from == q.to)
      return fitting;
    const Regular_plane& plane = after ? shape[q.to].local : shape[q.to].plane;
    constexpr tuning::Share of_layer = tuning::transfer::layer_share, of_other = tuning::transfer::explained_share;
    const tuning::Share least = is_layer(q.from, plane) ? of_layer : of_other;
    return least.is_reached(fitting, shape[q.from].moments.count) ? fitting : 0;
  }

private:
  // Squared distances from the plane: of the centroid, and the variance about it; in steps^2.
  struct Distances {
    double centroid2, variance;
  };

  CGAL_TANDEM_HD Distances distances(std::uint32_t t, const Regular_plane& plane) const
  {
    const Scatter& s = shape[t].scatter;
    const double e = dot(plane.normal, s.centroid) - plane.offset;
    return {e * e, quadratic_form(s.matrix, plane.normal) / s.count};
  }

  // Whether enough points of t may be within epsilon, by Cantelli's inequality: at most v / (v + (e - epsilon)^2) of
  // them are, for a centroid at a distance e > epsilon and a variance v. No point is read.
  CGAL_TANDEM_HD bool may_explain(std::uint32_t t, const Regular_plane& plane) const
  {
    constexpr tuning::Share share = tuning::transfer::explained_share;
    const Distances d = distances(t, plane);
    const double e = std::sqrt(d.centroid2) - maximum_distance;
    const double rest = double(share.denominator - share.numerator);
    return e <= 0 || d.variance * rest * tuning::exactness::bound_factor >= e * e * double(share.numerator);
  }

  // Whether t lies beside the plane, as thin as its local plane has it: then it may be a layer of its own.
  CGAL_TANDEM_HD bool is_layer(std::uint32_t t, const Regular_plane& plane) const
  {
    const double epsilon = tuning::transfer::layer_distance * maximum_distance;
    const Distances d = distances(t, plane);
    return d.centroid2 > epsilon * epsilon &&
           d.variance * shape[t].scatter.count <= tuning::transfer::layer_variance * shape[t].fit.smallest;
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_TRANSFER_CRITERION_H
