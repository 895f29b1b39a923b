// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Groups of parallel shapes: their fits, and what it costs to turn them.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTION_GROUP_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTION_GROUP_H

#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>
#include <CGAL/Tandem/internal/base/tuning/exactness.h>
#include <CGAL/Tandem/internal/regularity/Great_circle_index.h>
#include <CGAL/Tandem/internal/regularity/relations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace CGAL::Tandem::internal {

// --- Least-squares normals under constraints. Results are orthogonal up to the last bit (|dot| <= 1e-15). All are
// closed forms: no iteration.

// The unit vector orthogonal to the unit vector x that is closest to v. The second
// step removes what the rounding of the first one left.
inline Vector made_orthogonal(const Vector& v, const Vector& x)
{
  const Vector r = unit(add_scaled(v, -dot(v, x), x));
  return unit(add_scaled(r, -dot(r, x), x));
}

// The same for two unit vectors, which may be far from a right angle to each other.
inline Vector orthogonal_to_both(const Vector& a, const Vector& b)
{
  const Vector t = made_orthogonal(b, a);
  Vector r = unit(cross(a, t));
  for(int step = 0; step < 2; ++step) {
    r = add_scaled(r, -dot(r, a), a);
    r = unit(add_scaled(r, -dot(r, t), t));
  }
  return r;
}

// An orthonormal basis of the plane orthogonal to the unit vector x. It begins with the axis farthest from x, where
// rounding is smallest.
struct Plane_basis {
  Vector u, v;

  explicit Plane_basis(const Vector& x)
  {
    u = made_orthogonal(farthest_axis(x), x);
    v = unit(cross(x, u));
  }

  // The vector of coordinates (c, s) in space.
  Vector lifted(double c, double s) const { return add_scaled(c * u, s, v); }
};

// The matrix [p q; q r].
struct Symmetric_matrix_2 {
  double p, q, r;
};

// The quadratic form of m on the plane of the basis.
inline Symmetric_matrix_2 restricted(const Symmetric_matrix& m, const Plane_basis& b)
{
  const Vector mu = m * b.u, mv = m * b.v;
  return {dot(b.u, mu), dot(b.u, mv), dot(b.v, mv)};
}

// Eigenvector (not unit) of the smallest eigenvalue; false if any vector is one. Of two formulas, the one without
// cancellation is used.
inline bool smallest_eigenvector(const Symmetric_matrix_2& m, double& c, double& s)
{
  const double delta = (m.p - m.r) * 0.5;
  const double root = std::sqrt(fused(delta, delta, m.q * m.q));
  if(!(root > 0))
    return false;
  c = delta >= 0 ? m.q : delta - root;
  s = delta >= 0 ? -(delta + root) : m.q;
  return true;
}

// The best normal of the scatter m that is orthogonal to x. If all are equally good, it is the one closest to `now`.
inline Vector fit_orthogonal(const Symmetric_matrix& m, const Vector& x, const Vector& now)
{
  const Plane_basis basis(x);
  double c, s;
  if(!smallest_eigenvector(restricted(m, basis), c, s))
    return made_orthogonal(now, x);
  return made_orthogonal(basis.lifted(c, s), x);
}

// --- Groups of parallel shapes, and what it costs to turn them.

// One or two groups to which another one is orthogonal; -1 stands for none, the first one last.
using Partners = std::array<int, 2>;

// Shapes that share one direction, and the moments that decide on it.
struct Direction_group {
  std::vector<int> members;     // shapes, ascending; none for given directions that no shape has
  Symmetric_matrix matrix = {}; // sum of the members' scatter
  double weight = 0;            // of the points, by their tolerances
  double largest = 0;           // points of the largest member, which set the price of a degree of freedom
  Eigen_system eigen = {};      // of the matrix
  Vector fitted = {};           // least squares, unconstrained
  double minimum = 0;           // sum of squared distances of the fit
  Vector direction = {};        // the result
  bool is_given = false;        // its direction is given: it stays
  Partners partners = {-1, -1};
  std::vector<int> followers; // groups of which this is a partner

  // The fit of the members. A given direction stays.
  void fit(const Shape_fits& shapes)
  {
    matrix = {};
    weight = largest = 0;
    for(int i : members) {
      matrix = matrix + shapes[i].scatter.matrix;
      weight += shapes[i].scatter.weight();
      largest = (std::max)(largest, shapes[i].scatter.count);
    }
    if(is_given)
      return;
    const Shape_fit* own = members.size() == 1 ? &shapes[members.front()] : nullptr;
    const bool is_computed = own && dot(own->eigen.vector[0], own->eigen.vector[0]) > 0;
    eigen = is_computed ? own->eigen : eigen_system(matrix);
    // The bits of a single shape, from which it is seen whether it has been turned.
    fitted = canonical(own ? own->fit.normal : eigen.vector[0]);
    minimum = quadratic_form(matrix, fitted);
  }

  // By how much a direction exceeds the sum of squared distances of the fit (steps^2).
  double cost(const Vector& n) const { return quadratic_form(matrix, n) - minimum; }

  // A bound on the sine of the angle by which the group can turn at this cost.
  double admissible_sine(double allowed) const
  {
    const double gap = (std::max)(eigen.value[1] - eigen.value[0], 1e-300);
    const double rounding = tuning::exactness::squared_distance_margin * eigen.value[2];
    const double most = allowed + rounding + (std::max)(minimum - eigen.value[0], 0.);
    return std::sqrt(most / gap) + length(cross(eigen.vector[0], fitted)) + tuning::exactness::dot_margin;
  }
};

// Given directions in their order, then groups by falling number of points; ties are broken by the first member, which
// is in no other group.
inline bool is_heavier(const std::vector<Direction_group>& groups, int a, int b)
{
  if(groups[a].is_given || groups[b].is_given)
    return groups[a].is_given && (!groups[b].is_given || a < b);
  if(groups[a].weight != groups[b].weight)
    return groups[a].weight > groups[b].weight;
  return groups[a].members.front() < groups[b].members.front();
}

inline Direction_group single_group(int shape)
{
  Direction_group g;
  g.members = {shape};
  return g;
}

inline Direction_group given_direction_group(const Vector& direction)
{
  Direction_group g;
  g.fitted = g.direction = direction;
  g.is_given = true;
  return g;
}

// What it costs to make the normal of a scatter orthogonal to some direction p, and perhaps to q as well, in steps^2,
// to first order: this times the squared dot product of the normal and p. Rotating about an axis costs the gap of two
// eigenvalues times the squared angle.
struct Stiffness {
  Vector normal, u, v; // eigenvectors
  double gap_u, gap_v;

  explicit Stiffness(const Eigen_system& e)
    : normal(e.vector[0]), u(e.vector[1]), v(e.vector[2]), gap_u(e.value[1] - e.value[0]),
      gap_v(e.value[2] - e.value[0])
  {}

  double operator()(const Vector& p) const { return ratio(gap_u * gap_v, softness(p)); }
  double operator()(const Vector& p, const Vector& q) const
  {
    const double volume = dot(normal, cross(p, q));
    return ratio(softness(q), volume * volume);
  }
  // An fma, so that no compiler contracts the product with a sum that it enters.
  double cost(const Vector& p) const
  {
    const double d = dot(normal, p);
    return fused(d * d, (*this)(p), 0.);
  }

private:
  double softness(const Vector& x) const
  {
    const double a = dot(u, x), b = dot(v, x);
    return fused(a * a, gap_v, b * b * gap_u);
  }

  static double ratio(double a, double b) { return b > 0 ? a / b : 0; }
};

// The numbers of the groups in this order.
inline std::vector<int> by_weight(const std::vector<Direction_group>& groups)
{
  std::vector<int> order(groups.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return is_heavier(groups, a, b); });
  return order;
}

// The directions within an angle of a unit direction.
class Near_direction_region {
public:
  Near_direction_region(const Vector& direction, double sine)
    : width(sine <= largest_sine ? stretch * sine : std::numeric_limits<double>::infinity())
  {
    const double c[5] = {direction.x, direction.y, direction.z, direction.x, direction.y};
    for(int face = 0; face < 3; ++face) {
      u[face] = c[face + 1] / c[face];
      v[face] = c[face + 2] / c[face];
    }
  }

  // Of faces on which the direction does not lie, one coordinate may be infinite, and the other one undefined.
  bool meets(const Direction_cell& cell, double) const
  {
    return !(std::fabs(u[cell.face] - cell.u) > cell.half_width + width) &&
           !(std::fabs(v[cell.face] - cell.v) > cell.half_width + width);
  }

private:
  // Up to this sine the projection stretches by less than 4. Beyond it, all cells are met.
  static constexpr double largest_sine = .2, stretch = 4;

  double width;
  double u[3], v[3];
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTION_GROUP_H
