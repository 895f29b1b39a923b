// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The directions that are fixed so far. A new direction is made orthogonal to at most two of those, so that it is never
// over-determined. Only Direction_group::direction is written. See the manual, "Orthogonality: Stars and Frames", chains.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_FIXED_DIRECTIONS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_FIXED_DIRECTIONS_H

#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>
#include <CGAL/Tandem/internal/base/tuning/exactness.h>
#include <CGAL/Tandem/internal/regularity/Great_circle_index.h>
#include <CGAL/Tandem/internal/regularity/relations.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- Least-squares normals under constraints. One is orthogonal to a given direction, or two are orthogonal to it and to
// each other. Results are orthogonal up to the last bit (|dot| <= 1e-15). All are closed forms: no iteration.

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
// rounding is smallest; the first of equal ones.
struct Plane_basis {
  Vector u, v;

  explicit Plane_basis(const Vector& x)
  {
    const double ax = std::fabs(x.x), ay = std::fabs(x.y), az = std::fabs(x.z);
    const Vector axis = ax <= ay && ax <= az ? Vector{1, 0, 0} : ay <= az ? Vector{0, 1, 0} : Vector{0, 0, 1};
    u = made_orthogonal(axis, x);
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
  const double root = std::sqrt(std::fma(delta, delta, m.q * m.q));
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

// The normal a, orthogonal to x, such that a for one scatter and cross(x, a) for another are best together. The matrix
// of the second is turned by 90 degrees in the plane and added.
inline Vector fit_frame(const Symmetric_matrix& ma, const Symmetric_matrix& mb, const Vector& x, const Vector& now)
{
  const Plane_basis basis(x);
  const Symmetric_matrix_2 a = restricted(ma, basis), b = restricted(mb, basis);
  double c, s;
  if(!smallest_eigenvector({a.p + b.r, a.q - b.q, a.r + b.p}, c, s))
    return made_orthogonal(now, x);
  return made_orthogonal(basis.lifted(c, s), x);
}

// R m R', where R rotates by 90 degrees in the plane of `from` and `to`. These are nearly orthogonal. Followers are
// taken to the direction of their master in this way: equation 1 of the paper.
inline Symmetric_matrix turned(const Symmetric_matrix& m, const Vector& from, const Vector& to)
{
  const Vector a = unit(cross(from, to));
  const Vector row[3] = {{a.x * a.x, std::fma(a.x, a.y, -a.z), std::fma(a.x, a.z, a.y)},
                         {std::fma(a.x, a.y, a.z), a.y * a.y, std::fma(a.y, a.z, -a.x)},
                         {std::fma(a.x, a.z, -a.y), std::fma(a.y, a.z, a.x), a.z * a.z}};
  const Vector m0 = m * row[0], m1 = m * row[1], m2 = m * row[2];
  return {dot(row[0], m0), dot(row[0], m1), dot(row[0], m2), dot(row[1], m1), dot(row[1], m2), dot(row[2], m2)};
}

// --- Groups of parallel shapes, and what it costs to turn them.

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
  double admissible_sine(double allowed) const
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
  const double sum_of_ratios = d1 * d1 / gap1 + d2 * d2 / gap2;
  return sum_of_ratios > 0 ? d0 * d0 / sum_of_ratios : (d0 == 0 ? 0 : 1e300);
}

// The square of the unused part of what a right angle may cost, in [0, 1]. 0: it costs too much.
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

// The fixed directions that may be the best partner of a group. Values of the index are roots of weights.
class Partner_region {
public:
  // rounded_fit: what the angle to a partner is measured from, on the grid.
  Partner_region(const Direction_group& group, const Vector& rounded_fit, const Least_cost& least, double allowed)
    : right_angles(great_circle(rounded_fit)), cheap(great_circle(least.axis)), other(great_circle(least.other)),
      allowed(allowed), gap(least.gap),
      base(least.base - tuning::exactness::squared_distance_margin * group.eigen.value[2])
  {
    const double sine = group.sine + tuning::exactness::rounded_dot_margin;
    squared_sine = sine * sine;
  }

  bool meets(const Direction_cell& cell, double root_of_weight) const
  {
    if(!(right_angles.least_squared_dot(cell) < squared_sine))
      return false;
    const double squared_sine_to_other = 1 - other.least_squared_dot(cell);
    if(squared_sine_to_other < tuning::directions::minimum_squared_sine)
      return false;
    const double cost = base + gap * cheap.least_squared_dot(cell) / squared_sine_to_other;
    const double most = root_of_weight * score_of_cost(cost, allowed);
    return most > 0 && most >= best_value;
  }

  // A good partner that is found early rules out many cells.
  int nearest_quarter(const Direction_cell& cell) const { return cheap.nearest_quarter(cell); }

  // Of equal values the first direction counts.
  void add(std::size_t i, double value)
  {
    if(value > best_value || (value == best_value && value > 0 && i < best)) {
      best_value = value;
      best = i;
    }
  }

  std::size_t best_or(std::size_t none) const { return best_value > 0 ? best : none; }

private:
  Great_circle right_angles, cheap, other;
  double allowed, gap, base, squared_sine;
  double best_value = 0; // of those visited so far
  std::size_t best = 0;
};

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

  int nearest_quarter(const Direction_cell&) const { return 0; }

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

// Fixed directions in the order in which they were added. Two that are equal up to rounding become one, of the sum of
// their weights.
class Fixed_directions {
public:
  // To look at so few directions takes less time than a search.
  static constexpr std::size_t few_directions = 128;

  explicit Fixed_directions(const Regularity_parameters& options, std::size_t few = few_directions)
    : options(options), few(few)
  {}

  // Begins a star. Directions that are fixed until the next call are those of one star, and are not used for its chain.
  void begin_star() { known = fixed.size(); }

  // The direction of a star. It is its own fit, or a fit orthogonal to one or two fixed directions if that is cheap.
  Vector chained(const Direction_group& star) const
  {
    const double allowed = options.price(star.largest);
    const Partner_region region(star, star.rounded, least_cost(star), allowed);
    const std::size_t p = best_partner(star, star.rounded, region, [&](const Vector& d) {
      return score_of_cost(cost_of_right_angle(star.eigen, d), allowed);
    });
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
    const double allowed = options.price(group.largest);
    const Partner_region region(group, rounded_fit, least_cost_beside(group, p), allowed);
    const std::size_t q = best_partner(group, rounded_fit, region, [&](const Vector& d) {
      const Vector c = cross(p, d);
      return dot(c, c) > tuning::directions::minimum_squared_sine ? score_of_cost(group.cost(unit(c)), allowed) : 0;
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
    const std::size_t same = find_same(group.direction, master);
    if(same == fixed.size()) {
      add(group, group.weight);
      return group.direction;
    }
    Fixed_direction& d = fixed[same];
    d.weight += group.weight;
    d.root_of_weight = std::sqrt(d.weight);
    index.raise(int(same), d.root_of_weight);
    return group.direction = d.direction;
  }

  // Adds the direction of a group as it is. Its weight counts as partner.
  void add(const Direction_group& group, double weight)
  {
    const double root = std::sqrt(weight);
    fixed.push_back({group.direction, rounded_normal(group.direction), group.sine, weight, root});
    index.add(group.direction, root);
  }

  // Of the directions of earlier stars within the angle, the one that is worth most; `known` if none is. A cheap right
  // angle to a large group is no coincidence, while some small group is found at any angle. Measured: the root of the
  // weight keeps more right angles than the least cost.
  template <class Score>
  std::size_t best_partner(const Direction_group& group, const Vector& rounded_fit, Partner_region region,
                           Score score_of) const
  {
    if(known == 0 || !(group.sine > 0))
      return known;
    const auto consider = [&](int i) {
      const Fixed_direction& p = fixed[i];
      if(std::size_t(i) < known && std::fabs(rounded_dot(p.rounded, rounded_fit)) < (std::min)(p.sine, group.sine))
        region.add(std::size_t(i), p.root_of_weight * score_of(p.direction));
    };
    if(known <= few)
      for(std::size_t i = 0; i < known; ++i)
        consider(int(i));
    else
      index.search(region, consider);
    return region.best_or(known);
  }

private:
  struct Fixed_direction {
    Vector direction, rounded;
    double sine, weight, root_of_weight;
  };

  // The fixed direction that equals one up to rounding and is orthogonal to the master, or fixed.size(). Of several
  // the first by x, those of the same sign before the opposite ones: the sign is arbitrary on the equator.
  std::size_t find_same(const Vector& direction, const Vector& master) const
  {
    const double x = direction.x, reach = tuning::relations::same_direction;
    const auto is_near = [&](double wanted, const Vector& d) { return d.x >= wanted - reach && d.x <= wanted + reach; };
    std::tuple<int, double, std::size_t> first(2, 0, fixed.size());
    index.search(Near_direction_region(direction, reach), [&](int i) {
      const Vector& d = fixed[i].direction;
      const int order = is_near(x, d) ? 0 : is_near(-x, d) ? 1 : 2;
      if(order < 2 && squared_sine(d, direction) < reach * reach && are_orthogonal(d, master))
        first = (std::min)(first, {order, d.x, std::size_t(i)});
    });
    return std::get<2>(first);
  }

  const Regularity_parameters& options;
  std::size_t few;
  std::size_t known = 0; // directions of earlier stars
  std::vector<Fixed_direction> fixed;
  Great_circle_index index; // of all fixed directions
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_FIXED_DIRECTIONS_H
