// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the union of two shapes gains, see score/Score.h, by their moments and samples. Changes nothing, and reads no
// other point. By a group of lanes, which share the points of a sample. See the manual, "Unions".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_UNION_GAIN_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_UNION_GAIN_H

#include <CGAL/Tandem/internal/base/tuning/exactness.h>
#include <CGAL/Tandem/internal/rounds/Shape_sample.h>
#include <CGAL/Tandem/internal/score/Score.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/Shape.h>

#include <cmath>

namespace CGAL {
namespace Tandem {
namespace internal {

// How much the sum of squared distances of a shape grows if this plane replaces its local one.
CGAL_TANDEM_HD inline double excess(const Scatter& scatter, const Fit& fit, const Regular_plane& plane)
{
  const double e = dot(plane.normal, scatter.centroid) - plane.offset;
  return std::fma(scatter.count * e, e, quadratic_form(scatter.matrix, plane.normal)) - fit.smallest;
}

// What is known of a shape, or of a union of shapes. The sample is one of its points.
struct Sampled_shape {
  const Fitted_moments& fitted;
  const Shape_sample& sample;

  CGAL_TANDEM_HD std::int64_t size() const { return fitted.moments.count; }
};

struct Verdict {
  bool is_accepted = false;
  bool is_taken = false; // the smaller one joins the plane of the larger one as it is
  double gain = 0;       // in units of the score
};

// Within moments, the worth of a shape is 1 - d^2 / epsilon^2, also of points that do not fit and are worth nothing.
// How much that counts wrong is estimated from the sample, as a difference of both planes for the same points, so that
// most of the error of a sample cancels out. A union has to gain more than the standard deviation of the rest.
class Union_gain {
public:
  explicit Union_gain(const Options& options)
    : score_(options.score), tolerance_(options.growth.tolerance),
      per_square_(double(Score::unit) / (options.maximum_distance * options.maximum_distance))
  {
    const double twice = std::fma(2., options.squared_cosine, -1.);
    squared_cosine_of_twice_ = twice > 0 ? twice * twice : 0;
  }

  // Not where cheap tests, by one lane, reject the pair. The first shape is the larger one. links: between both.
  CGAL_TANDEM_HD bool may_gain(const Fitted_moments& a, const Fitted_moments& b, std::uint32_t links) const
  {
    const double cosine = dot(a.fit.normal, b.fit.normal);
    return !(cosine * cosine < squared_cosine_of_twice_) && (is_much_larger(a, b) || !are_apart(a, b, saved(links)));
  }

  // The verdict where it may gain.
  CGAL_TANDEM_HD Verdict near_verdict(const Sampled_shape& a, const Sampled_shape& b, std::uint32_t links) const
  {
    if(is_much_larger(a.fitted, b.fitted)) {
      const Verdict verdict = taking_verdict(a, b, saved(links));
      if(verdict.is_accepted || are_apart(a.fitted, b.fitted, saved(links)))
        return verdict;
    }
    return joint_verdict(a, b, saved(links));
  }

private:
  CGAL_TANDEM_HD static bool is_much_larger(const Fitted_moments& a, const Fitted_moments& b)
  {
    return tuning::moves::much_larger * b.moments.count < a.moments.count;
  }

  // By a union of two shapes.
  CGAL_TANDEM_HD double saved(std::uint32_t links) const { return -double(score_.price() + score_.links(links)); }

  // How the worth of a part changes with its plane, beside the squares, and which of its points do not fit.
  struct Part {
    double change, variance;
    std::int64_t misfits, misfits_before;
    bool has_misfits; // more than a union may have, or it is not known: the rest is not computed then
  };

  // Of one point: how its worth changes beside the squares, without and with that of the size.
  struct Change {
    double change, of_all;
  };

  // The second shape takes the plane of the first one.
  CGAL_TANDEM_HD Verdict taking_verdict(const Sampled_shape& a, const Sampled_shape& b, double saved) const
  {
    const Part part = compare(b, a.fitted.local);
    if(part.has_misfits)
      return {};
    const double squares = excess(b.fitted.scatter, b.fitted.fit, a.fitted.local);
    const double gain = std::fma(-per_square(b), squares, saved) + part.change +
                        bonus(a.size(), b.size() - part.misfits, b.size() - part.misfits_before);
    return is_accepted(gain, part.variance, b) ? Verdict{true, true, gain} : Verdict();
  }

  CGAL_TANDEM_HD Verdict joint_verdict(const Sampled_shape& a, const Sampled_shape& b, double saved) const
  {
    Fitted_moments joint;
    joint.moments = a.fitted.moments;
    joint.moments += b.fitted.moments;
    refit(joint);
    const Part of_b = compare(b, joint.local);
    if(of_b.has_misfits)
      return {};
    const Part of_a = compare(a, joint.local);
    if(of_a.has_misfits)
      return {};
    const double squares = std::fma(per_square(a), excess(a.fitted.scatter, a.fitted.fit, joint.local),
                                    per_square(b) * excess(b.fitted.scatter, b.fitted.fit, joint.local));
    const std::int64_t na = a.size() - of_a.misfits, nb = b.size() - of_b.misfits;
    const double size = double(score_.size_bonus(na + nb) - score_.size_bonus(a.size() - of_a.misfits_before) -
                               score_.size_bonus(b.size() - of_b.misfits_before));
    const double gain = saved - squares + of_a.change + of_b.change + size;
    return is_accepted(gain, of_a.variance + of_b.variance, b) ? Verdict{true, false, gain} : Verdict();
  }

  // Of the size: na points stay, nb points join, and were n of a shape of their own.
  CGAL_TANDEM_HD double bonus(std::int64_t na, std::int64_t nb, std::int64_t n) const
  {
    return double(score_.size_bonus(na + nb) - score_.size_bonus(na) - score_.size_bonus(n));
  }

  CGAL_TANDEM_HD Part compare(const Sampled_shape& s, const Regular_plane& candidate) const
  {
    const Plane before = rounded(s.fitted.local), after = rounded(candidate);
    const double bonus = s.size() > 0 ? double(score_.point_bonus(s.size())) : 0, per_own_square = per_square(s);
    double sum = 0, squares = 0;
    constexpr tuning::Share most = tuning::moves::misfits_of_union;
    std::int64_t misfits = 0, misfits_before = 0;
    bool has_misfits = s.sample.size == 0;
    for(std::uint32_t first = 0; first < s.sample.size && !has_misfits; first += Lane_group::size()) {
      const std::uint32_t i = first + Lane_group::rank();
      const bool is_point = i < s.sample.size;
      const Sampled_point& q = s.sample.item[is_point ? i : 0];
      const Tolerance own = tolerance_.at(std::uint8_t(q.level));
      const bool is_misfit = is_point && !fits(after, q.point, own),
                 was_misfit = is_point && !fits(before, q.point, own);
      misfits += Lane_group::count(is_misfit);
      has_misfits = most.is_exceeded(misfits, std::int64_t(s.sample.size));
      misfits_before += Lane_group::count(was_misfit);
      const double change = (is_misfit ? surplus(after, q.point, per_own_square) : 0) -
                            (was_misfit ? surplus(before, q.point, per_own_square) : 0);
      const double of_size = is_misfit == was_misfit ? 0 : is_misfit ? -bonus : bonus;
      // In the order of the sample, as sums are of doubles. Points that fit both planes change nothing.
      Lane_group::for_each_in_order(is_misfit || was_misfit, Change{change, change + of_size}, [&](const Change& c) {
        sum += c.change;
        squares = std::fma(c.of_all, c.of_all, squares);
      });
    }
    const bool is_whole = std::int64_t(s.sample.size) >= s.size();
    const double scale = s.sample.size > 0 ? double(s.size()) / double(s.sample.size) : 1;
    return {scale * sum, is_whole ? 0 : scale * scale * squares, std::int64_t(scale * double(misfits)),
            std::int64_t(scale * double(misfits_before)), has_misfits};
  }

  // By how much the squares count a point too low that is worth nothing.
  CGAL_TANDEM_HD static double surplus(const Plane& plane, const Grid_point& p, double per_square)
  {
    const double e = double(signed_distance(plane, p)) / normal_scale;
    return std::fma(e * e, per_square, -double(Score::unit));
  }

  // Units of the score for a squared grid step, by the tolerances of its points.
  CGAL_TANDEM_HD double per_square(const Sampled_shape& s) const
  {
    return per_square_ / s.fitted.scatter.squared_tolerance;
  }

  // Whether the gain is certain, and the larger one gains as well: otherwise the smaller one would only be dissolved.
  CGAL_TANDEM_HD bool is_accepted(double gain, double variance, const Sampled_shape& b) const
  {
    return gain > 0 && gain * gain > variance && gain + worth(b) + double(score_.price()) > 0;
  }

  // Without its price and links.
  CGAL_TANDEM_HD double worth(const Sampled_shape& s) const
  {
    return std::fma(-per_square(s), s.fitted.fit.smallest, double(Score::unit) * double(s.size())) +
           double(score_.size_bonus(s.size()));
  }

  // A cheap test for pairs that gain nothing: the sum of squares of a union exceeds what it could save. Not where both
  // together are worth less than that. Points that would not fit count by their squares here, too.
  CGAL_TANDEM_HD bool are_apart(const Fitted_moments& a, const Fitted_moments& b, double saved) const
  {
    const double squares = a.fit.smallest / a.scatter.squared_tolerance + b.fit.smallest / b.scatter.squared_tolerance;
    const std::int64_t na = a.moments.count, nb = b.moments.count;
    const double most = saved - double(score_.price()) + bonus(na, nb, nb);
    if(std::fma(-per_square_, squares, double(Score::unit) * double(na + nb)) < most)
      return false;
    const Symmetric_matrix joint = joint_matrix(weighted(a.scatter), weighted(b.scatter));
    const double rounding = tuning::exactness::eigenvalue_margin * (joint.xx + joint.yy + joint.zz);
    return has_eigenvalues_above(joint,
                                 std::fma(tuning::exactness::bound_factor, squares + most / per_square_, rounding));
  }

  Score score_;
  Tolerance tolerance_;
  double per_square_; // units of the score for a squared grid step, at epsilon
  double squared_cosine_of_twice_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_UNION_GAIN_H
