// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Groups of parallel shapes, and what it costs to turn them.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTION_GROUP_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTION_GROUP_H

#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/tuning/exactness.h>
#include <CGAL/Tandem/internal/regularity/directions.h>
#include <CGAL/Tandem/internal/regularity/constrained_fit.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Shapes that share one direction, and the moments that decide on it. Right angles to other groups are considered
// within the angle whose sine is given.
struct Direction_group {
  std::vector<int> members; // shapes, ascending; never empty between steps, but for given directions
  double sine = 0;
  Symmetric_matrix matrix = {}; // sum of the members' scatter
  double weight = 0;            // of the points, by their tolerances
  double largest = 0;           // points of the largest member, which set the price of a degree of freedom
  Eigen_system eigen = {};      // of the matrix
  Vector fitted = {};           // least squares, unconstrained
  Vector rounded = {};          // the same on the grid: see rounded_normal()
  double minimum = 0;           // sum of squared distances of the fit
  Vector direction = {};        // the result
  bool is_given = false;        // its direction is given: it stays, and other groups are made orthogonal to it first
  bool has_changed = true;      // its members, since the last fit

  // The fit of the members. A given direction stays.
  void fit(const Shape_fits& shapes)
  {
    has_changed = false;
    matrix = {};
    weight = largest = 0;
    for(int i : members) {
      matrix = matrix + shapes[i].scatter.matrix;
      weight += shapes[i].scatter.weight();
      largest = (std::max)(largest, shapes[i].scatter.count);
    }
    if(is_given)
      return;
    if(members.size() != 1)
      return fit();
    const Shape_fit& own = shapes[members.front()];
    const bool is_computed = dot(own.eigen.vector[0], own.eigen.vector[0]) > 0;
    eigen = is_computed ? own.eigen : eigen_system(matrix);
    set_fit(canonical(own.fit.normal)); // its bits, from which it is seen whether a shape has been turned
  }

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

  // A bound on the sine of the angle by which the group can turn at this cost.
  double bearable_sine(double allowed) const
  {
    const double gap = (std::max)(eigen.value[1] - eigen.value[0], 1e-300);
    const double rounding = tuning::exactness::squared_distance_margin * eigen.value[2];
    const double most = allowed + rounding + (std::max)(minimum - eigen.value[0], 0.);
    return std::sqrt(most / gap) + length(cross(eigen.vector[0], fitted)) + tuning::exactness::rounded_dot_margin;
  }
};

// Given directions in their order, then groups by falling number of points; ties are broken by the first member, which is
// in no other group.
inline bool is_heavier(const std::vector<Direction_group>& groups, int a, int b)
{
  if(groups[a].is_given || groups[b].is_given)
    return groups[a].is_given && (!groups[b].is_given || a < b);
  if(groups[a].weight != groups[b].weight)
    return groups[a].weight > groups[b].weight;
  return groups[a].members.front() < groups[b].members.front();
}

inline Direction_group direction_group(std::vector<int> members, double sine)
{
  Direction_group g;
  g.members = std::move(members);
  g.sine = sine;
  return g;
}

inline Direction_group given_direction_group(const Vector& direction, double sine)
{
  Direction_group g;
  g.sine = sine;
  g.fitted = g.direction = direction;
  g.rounded = rounded_normal(direction);
  g.is_given = true;
  return g;
}

// Removes groups without members, but for given directions.
inline void drop_empty(std::vector<Direction_group>& groups)
{
  const auto is_empty = [](const Direction_group& g) { return g.members.empty() && !g.is_given; };
  groups.erase(std::remove_if(groups.begin(), groups.end(), is_empty), groups.end());
}

// What a rotation of the normal costs at least, in steps^2 by the squared angle.
inline double smallest_gap(const Eigen_system& e) { return (std::max)(e.value[1] - e.value[0], 1e-300); }

// The least cost (steps^2) of making the normal of a scatter orthogonal to x, to first order in the rotation. Rotating
// about an axis costs the gap of two eigenvalues times the squared angle.
inline double cost_of_right_angle(const Eigen_system& e, const Vector& x)
{
  const double gap1 = smallest_gap(e);
  const double gap2 = (std::max)(e.value[2] - e.value[0], 1e-300);
  const double d0 = dot(e.vector[0], x), d1 = dot(e.vector[1], x), d2 = dot(e.vector[2], x);
  const double ease = d1 * d1 / gap1 + d2 * d2 / gap2;
  return ease > 0 ? d0 * d0 / ease : (d0 == 0 ? 0 : 1e300);
}

// The square of the unused share of what a right angle may cost, in [0, 1]. 0: it costs too much.
inline double score_of_cost(double cost, double allowed)
{
  const double left = cost <= 0 ? 1 : cost < allowed ? 1 - cost / allowed : 0;
  return left * left;
}

// A bound on what it costs a group to be made orthogonal to a direction d, and to `other` unless that is null: at least
// base + gap (axis . d)^2 / |other x d|^2, in steps^2. The denominator is 1 without another one.
struct Least_cost {
  Vector axis, other;
  double base, gap;
};

// That of cost_of_right_angle().
inline Least_cost least_cost(const Direction_group& g)
{
  return {g.eigen.vector[0], {0, 0, 0}, 0, smallest_gap(g.eigen)};
}

// That of Direction_group::cost() of a normal that is also orthogonal to p.
inline Least_cost least_cost_beside(const Direction_group& g, const Vector& p)
{
  const Plane_basis basis(p);
  const Symmetric_matrix_2 m = restricted(g.matrix, basis);
  double c = 1, s = 0;
  smallest_eigenvector(m, c, s);
  const double delta = (m.p - m.r) * 0.5, root = std::sqrt(std::fma(delta, delta, m.q * m.q));
  return {unit(basis.lifted(c, s)), p, (m.p + m.r) * 0.5 - root - g.minimum, 2 * root};
}

// The numbers of the groups in this order.
inline std::vector<int> by_weight(const std::vector<Direction_group>& groups)
{
  std::vector<int> order(groups.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return is_heavier(groups, a, b); });
  return order;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTION_GROUP_H
