// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Least-squares normals under constraints. One is orthogonal to a given direction, or two are orthogonal to it and to
// each other. Results are orthogonal up to the last bit (|dot| <= 1e-15). All are closed forms: no iteration.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_CONSTRAINED_FIT_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_CONSTRAINED_FIT_H

#include <CGAL/Tandem/internal/base/linear_algebra.h>

namespace CGAL {
namespace Tandem {
namespace internal {

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

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_CONSTRAINED_FIT_H
