// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Groups of parallel shapes, and the directions that are fixed so far. A new direction is made orthogonal to at most
// two of those, so that it is never over-determined. Only Direction_group::direction is written. See the manual,
// "Orthogonality: Stars and Frames", chains.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_FIXED_DIRECTIONS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_FIXED_DIRECTIONS_H

#include <CGAL/Tandem/internal/regularity/cluster_directions.h>
#include <CGAL/Tandem/internal/regularity/constrained_fit.h>

#include <map>

namespace CGAL {
namespace Tandem {
namespace internal {

// Shapes that share one direction, and the moments that decide on it. Right angles to other groups are considered
// within the angle whose sine is given. It is smaller for shapes that were rejected before.
struct Direction_group {
  std::vector<int> members; // shapes, ascending; never empty between steps
  double sine;
  Symmetric_matrix matrix; // sum of the members' scatter
  double weight;           // points
  Eigen_system eigen;      // of the matrix
  Vector fitted;           // least squares, unconstrained
  Vector rounded;          // the same on the grid of the Gauss map
  double minimum;          // sum of squared distances of the fit
  Vector direction;        // the result
  bool is_frozen;          // keeps its direction, others may be made orthogonal to it

  // The unconstrained fit, from the matrix alone.
  void fit()
  {
    eigen = eigen_system(matrix);
    set_fit(canonical(eigen.vector[0]));
  }

  // Sets what follows from a fitted normal.
  void set_fit(const Vector& n)
  {
    fitted = n;
    rounded = rounded_normal(n);
    minimum = quadratic_form(matrix, n);
  }

  // By how much a direction exceeds the sum of squared distances of the fit (steps^2).
  double cost(const Vector& n) const { return quadratic_form(matrix, n) - minimum; }
};

// The least cost (steps^2) of making the normal of a scatter orthogonal to x, to first order in the rotation. Rotating
// about an axis costs the gap of two eigenvalues times the squared angle.
inline double cost_of_right_angle(const Eigen_system& e, const Vector& x)
{
  const double gap1 = (std::max)(e.value[1] - e.value[0], 1e-300);
  const double gap2 = (std::max)(e.value[2] - e.value[0], 1e-300);
  const double d0 = dot(e.vector[0], x), d1 = dot(e.vector[1], x), d2 = dot(e.vector[2], x);
  const double ease = d1 * d1 / gap1 + d2 * d2 / gap2;
  return ease > 0 ? d0 * d0 / ease : (d0 == 0 ? 0 : 1e300);
}

// Fixed directions in the order in which they were added. Two that are equal up to rounding become one, of the sum of
// their weights.
class Fixed_directions {
public:
  // squared_rms: what a chain may add to the mean squared distance of the points (steps^2).
  explicit Fixed_directions(double squared_rms) : squared_rms(squared_rms) {}

  // Begins a star. Directions that are fixed until the next call are those of one star, and are not used for its chain.
  void begin_star() { known = fixed.size(); }

  // The direction of a star. It is its own fit, or a fit orthogonal to one or two fixed directions if that is cheap.
  Vector chained(const Direction_group& star) const
  {
    const double allowed = squared_rms * star.weight;
    const std::size_t p = best_partner(
      star.rounded, star.sine, [&](const Vector& d) { return score(cost_of_right_angle(star.eigen, d), allowed); });
    if(p == known)
      return star.fitted;
    const Vector n = fit_orthogonal(star.matrix, fixed[p].direction, star.fitted);
    if(star.cost(n) > allowed)
      return star.fitted;
    Vector both = n;
    return chain(star, fixed[p].direction, rounded_normal(n), both) ? both : n;
  }

  // Sets `result` to a direction orthogonal to p and to a fixed one, if one is cheap enough. Returns whether it did.
  // Two that are nearly parallel determine no third one.
  bool chain(const Direction_group& group, const Vector& p, const Vector& rounded_fit, Vector& result) const
  {
    const double allowed = squared_rms * group.weight;
    const std::size_t q = best_partner(rounded_fit, group.sine, [&](const Vector& d) {
      const Vector c = cross(p, d);
      return dot(c, c) > tuning::directions::minimum_squared_sine ? score(group.cost(unit(c)), allowed) : 0;
    });
    if(q < known)
      result = orthogonal_to_both(p, fixed[q].direction);
    return q < known;
  }

  // Sets the direction of a group. If it equals a fixed one up to rounding, it becomes the same bits. It must stay
  // orthogonal to its master then; a null master means none. Groups of equal bits are parallel in the result.
  Vector fix(Direction_group& group, const Vector& n, const Vector& master)
  {
    group.direction = canonical(n);
    const double x = group.direction.x, reach = tuning::relations::same_direction;
    for(double side : {x, -x}) // the sign is arbitrary on the equator
      for(auto i = by_x.lower_bound(side - reach); i != by_x.end() && i->first <= side + reach; ++i) {
        Fixed_direction& d = fixed[i->second];
        if(Direction_index::squared_distance(d.direction, group.direction) < reach * reach &&
           are_orthogonal(d.direction, master)) {
          d.weight += group.weight;
          return group.direction = d.direction;
        }
      }
    add(group);
    return group.direction;
  }

  // Adds the direction of a group as it is.
  void add(const Direction_group& group)
  {
    by_x.insert({group.direction.x, fixed.size()});
    fixed.push_back({group.direction, rounded_normal(group.direction), group.sine, group.weight});
  }

private:
  struct Fixed_direction {
    Vector direction, rounded;
    double sine, weight;
  };

  // The square of the unused share of what is allowed, in [0, 1]. 0: it costs too much.
  static double score(double cost, double allowed)
  {
    const double left = cost < allowed ? 1 - cost / allowed : (cost <= 0 ? 1 : 0);
    return left * left;
  }

  // Of the directions of earlier stars within the angle, the one that is worth most; `known` if none is. A cheap right
  // angle to a large group is no coincidence, while some small group is found at any angle. Measured: the root of the
  // weight keeps more right angles than the least cost. Linear in the number of directions, which is small.
  template <class Score>
  std::size_t best_partner(const Vector& rounded_fit, double sine, Score score_of) const
  {
    std::size_t best = known;
    double maximum = 0;
    for(std::size_t i = 0; i < known; ++i) {
      const Fixed_direction& p = fixed[i];
      if(!(std::fabs(rounded_dot(p.rounded, rounded_fit)) < (std::min)(p.sine, sine)))
        continue;
      const double value = std::sqrt(p.weight) * score_of(p.direction);
      if(value > maximum) {
        maximum = value;
        best = i;
      }
    }
    return best;
  }

  double squared_rms;
  std::size_t known = 0; // directions of earlier stars
  std::vector<Fixed_direction> fixed;
  std::multimap<double, std::size_t> by_x; // finds equal directions by their first coordinate
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_FIXED_DIRECTIONS_H
