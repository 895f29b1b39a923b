// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Groups of parallel shapes, and the directions that they were given so far. A new
// one is turned onto at most two of those before, so that it is never over-constrained.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_FIXED_DIRECTIONS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_FIXED_DIRECTIONS_H

#include <CGAL/Tandem/internal/regularity/cluster_directions.h>
#include <CGAL/Tandem/internal/regularity/constrained_fit.h>

#include <map>

namespace CGAL {
namespace Tandem {
namespace internal {

// Shapes that share one direction. They are tied to others only within the angle
// whose sine is given, which is smaller for shapes that were refused before.
struct Direction_group {
  std::vector<int> members;
  double sine;
  Symmetric_matrix matrix; // sum of the members' scatter
  double weight;           // points
  Eigen_system eigen;      // of the matrix
  Vector fitted;           // least squares, unconstrained
  Vector rounded;          // the same on the grid of the Gauss map
  double minimum;          // sum of squared distances of the fit
  Vector direction;        // the result
  bool is_frozen;          // keeps its direction, others may be tied to it

  // From the matrix alone.
  void fit()
  {
    eigen = eigen_system(matrix);
    set_fit(canonical(eigen.vector[0]));
  }

  void set_fit(const Vector& n)
  {
    fitted = n;
    rounded = rounded_normal(n);
    minimum = quadratic_form(matrix, n);
  }

  // Sum of squared distances that a direction adds to the best one.
  double cost(const Vector& n) const { return quadratic_form(matrix, n) - minimum; }
};

// The least cost of turning the normal of a scatter orthogonal to x, to first order.
inline double cost_of_right_angle(const Eigen_system& e, const Vector& x)
{
  const double gap1 = (std::max)(e.value[1] - e.value[0], 1e-300);
  const double gap2 = (std::max)(e.value[2] - e.value[0], 1e-300);
  const double d0 = dot(e.vector[0], x), d1 = dot(e.vector[1], x), d2 = dot(e.vector[2], x);
  const double ease = d1 * d1 / gap1 + d2 * d2 / gap2;
  return ease > 0 ? d0 * d0 / ease : (d0 == 0 ? 0 : 1e300);
}

class Fixed_directions {
public:
  // squared_rms: what a constraint may add to the mean squared distance of the points.
  explicit Fixed_directions(double squared_rms) : squared_rms(squared_rms) {}

  // What is placed until the next call is not used for chaining: the directions of one star.
  void begin_star() { known = fixed.size(); }

  // The direction of a scatter (of a star) that is best by its own, orthogonal to one or two
  // placed ones if that is cheap.
  Vector chained(const Direction_group& star) const
  {
    const double allowed = squared_rms * star.weight;
    const std::size_t p = best_partner(
      star.rounded, star.sine, [&](const Vector& d) { return worth(cost_of_right_angle(star.eigen, d), allowed); });
    if(p == known)
      return star.fitted;
    const Vector n = fit_orthogonal(star.matrix, fixed[p].direction, star.fitted);
    if(star.cost(n) > allowed)
      return star.fitted;
    Vector both = n;
    return chain(star, fixed[p].direction, rounded_normal(n), both) ? both : n;
  }

  // A direction orthogonal to p and to a placed one, if there is one that is cheap enough.
  bool chain(const Direction_group& group, const Vector& p, const Vector& rounded_fit, Vector& result) const
  {
    const double allowed = squared_rms * group.weight;
    const std::size_t q = best_partner(rounded_fit, group.sine, [&](const Vector& d) {
      const Vector c = cross(p, d);
      return dot(c, c) > tuning::directions::minimum_squared_sine ? worth(group.cost(unit(c)), allowed) : 0;
    });
    if(q < known)
      result = orthogonal_to_both(p, fixed[q].direction);
    return q < known;
  }

  // Gives a group its direction; one that equals a placed direction up to rounding
  // becomes the same bits, if it stays orthogonal to its master.
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

  // In [0, 1]; 0 means that it costs too much.
  static double worth(double cost, double allowed)
  {
    const double left = cost < allowed ? 1 - cost / allowed : (cost <= 0 ? 1 : 0);
    return left * left;
  }

  // The one of the known directions within the angle that is worth most. A cheap right angle to a large
  // group is no coincidence, while some small group is found at any angle. (Of six clouds,
  // the root of the weight left more right angles exact on each than the least cost.)
  template <class Worth>
  std::size_t best_partner(const Vector& rounded_fit, double sine, Worth worth_of) const
  {
    std::size_t best = known;
    double maximum = 0;
    for(std::size_t i = 0; i < known; ++i) {
      const Fixed_direction& p = fixed[i];
      if(!(std::fabs(rounded_dot(p.rounded, rounded_fit)) < (std::min)(p.sine, sine)))
        continue;
      const double value = std::sqrt(p.weight) * worth_of(p.direction);
      if(value > maximum) {
        maximum = value;
        best = i;
      }
    }
    return best;
  }

  double squared_rms;
  std::size_t known = 0;
  std::vector<Fixed_direction> fixed;
  std::multimap<double, std::size_t> by_x;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_FIXED_DIRECTIONS_H
