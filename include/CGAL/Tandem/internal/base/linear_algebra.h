// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vectors and symmetric 3x3 matrices of double, with the same bits from every compiler and on every device. Only
// + - * / sqrt and fma are used, which round correctly. Every product that enters a sum is an explicit fma, so that
// nothing is left for a compiler to contract.

#ifndef CGAL_TANDEM_INTERNAL_BASE_LINEAR_ALGEBRA_H
#define CGAL_TANDEM_INTERNAL_BASE_LINEAR_ALGEBRA_H

#include <CGAL/Tandem/internal/base/tuning/regularity.h>
#include <CGAL/Tandem/internal/base/types.h>

#include <cmath>

namespace CGAL::Tandem::internal {

struct Vector {
  double x, y, z;
};

CGAL_TANDEM_HD inline double dot(const Vector& a, const Vector& b)
{
  return fused(a.x, b.x, fused(a.y, b.y, a.z * b.z));
}

CGAL_TANDEM_HD inline bool operator==(const Vector& a, const Vector& b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z;
}
CGAL_TANDEM_HD inline Vector operator-(const Vector& a) { return {-a.x, -a.y, -a.z}; }
CGAL_TANDEM_HD inline Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
CGAL_TANDEM_HD inline Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
CGAL_TANDEM_HD inline Vector operator*(double s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }

// a + s b
CGAL_TANDEM_HD inline Vector add_scaled(const Vector& a, double s, const Vector& b)
{
  return {fused(s, b.x, a.x), fused(s, b.y, a.y), fused(s, b.z, a.z)};
}

CGAL_TANDEM_HD inline Vector cross(const Vector& a, const Vector& b)
{
  return {fused(a.y, b.z, -(a.z * b.y)), fused(a.z, b.x, -(a.x * b.z)), fused(a.x, b.y, -(a.y * b.x))};
}

CGAL_TANDEM_HD inline double length(const Vector& a) { return std::sqrt(dot(a, a)); }

// The vector of length 1. The null vector stays null: it stands for a direction that does not exist.
CGAL_TANDEM_HD inline Vector unit(const Vector& a)
{
  const double l = length(a);
  return l > 0 ? Vector{a.x / l, a.y / l, a.z / l} : a;
}

// The axis of coordinates that is farthest from a direction, the first one of equal ones.
inline Vector farthest_axis(const Vector& n)
{
  const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
  return x <= y && x <= z ? Vector{1, 0, 0} : y <= z ? Vector{0, 1, 0} : Vector{0, 0, 1};
}

// Whether two unit normals are orthogonal: the one definition, in the engine and in the result. See the manual,
// "Directions".
CGAL_TANDEM_HD inline bool are_orthogonal(const Vector& a, const Vector& b)
{
  return std::fabs(dot(a, b)) <= tuning::relations::orthogonal_dot;
}

struct Symmetric_matrix {
  double xx, xy, xz, yy, yz, zz;
};

CGAL_TANDEM_HD inline Symmetric_matrix operator+(const Symmetric_matrix& a, const Symmetric_matrix& b)
{
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}

// m + s v v'
CGAL_TANDEM_HD inline Symmetric_matrix add_square(const Symmetric_matrix& m, double s, const Vector& v)
{
  const Vector w = s * v;
  return {fused(w.x, v.x, m.xx), fused(w.x, v.y, m.xy), fused(w.x, v.z, m.xz),
          fused(w.y, v.y, m.yy), fused(w.y, v.z, m.yz), fused(w.z, v.z, m.zz)};
}

CGAL_TANDEM_HD inline Vector operator*(const Symmetric_matrix& m, const Vector& v)
{
  return {fused(m.xx, v.x, fused(m.xy, v.y, m.xz * v.z)), fused(m.xy, v.x, fused(m.yy, v.y, m.yz * v.z)),
          fused(m.xz, v.x, fused(m.yz, v.y, m.zz * v.z))};
}

// v' M v. For a scatter matrix and a unit v: the sum of squared distances to the plane of normal v.
CGAL_TANDEM_HD inline double quadratic_form(const Symmetric_matrix& m, const Vector& v) { return dot(v, m * v); }

// Whether all eigenvalues are larger, within rounding: m - value I is positive definite. All pivots of an elimination
// are then positive. This costs a few divisions instead of an eigensystem.
CGAL_TANDEM_HD inline bool has_eigenvalues_above(const Symmetric_matrix& m, double value)
{
  const double p = m.xx - value;
  if(!(p > 0))
    return false;
  const double q = fused(-m.xy / p, m.xy, m.yy - value);
  if(!(q > 0))
    return false;
  const double r = fused(-m.xy / p, m.xz, m.yz);
  return fused(-r / q, r, fused(-m.xz / p, m.xz, m.zz - value)) > 0;
}

struct Eigen_system {
  double value[3];  // ascending
  Vector vector[3]; // unit, vector[i] belongs to value[i]; signs are arbitrary
};

namespace jacobi {

// Annihilates a[p][q] and applies the rotation to the columns of v. Of the two possible angles the smaller one is
// taken, which makes the sweeps converge. An entry far below the rounding of its diagonal is set to 0 at once.
CGAL_TANDEM_HD inline void rotate(double a[3][3], double v[3][3], int p, int q)
{
  if(std::fabs(a[p][q]) <= 1e-20 * (std::fabs(a[p][p]) + std::fabs(a[q][q]))) {
    a[p][q] = a[q][p] = 0;
    return;
  }
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double root = std::sqrt(fused(theta, theta, 1.0));
  const double t = theta >= 0 ? 1 / (theta + root) : 1 / (theta - root);
  const double c = 1 / std::sqrt(fused(t, t, 1.0));
  const double s = t * c;
  const int r = 3 - p - q;
  const double arp = a[r][p], arq = a[r][q];
  a[p][p] = fused(-t, a[p][q], a[p][p]);
  a[q][q] = fused(t, a[p][q], a[q][q]);
  a[p][q] = a[q][p] = 0;
  a[r][p] = a[p][r] = fused(c, arp, -(s * arq));
  a[r][q] = a[q][r] = fused(s, arp, c * arq);
  for(int k = 0; k < 3; ++k) {
    const double vp = v[k][p], vq = v[k][q];
    v[k][p] = fused(c, vp, -(s * vq));
    v[k][q] = fused(s, vp, c * vq);
  }
}

} // namespace jacobi

// Cyclic Jacobi: accurate also for null, isotropic and rank-one matrices. It converges quadratically, so 12 sweeps are
// only a bound. The fixed order of rotations and exchanges makes vectors of equal values the same everywhere.
CGAL_TANDEM_HD inline Eigen_system eigen_system(const Symmetric_matrix& m)
{
  double a[3][3] = {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}};
  double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for(int sweep = 0; sweep < 12; ++sweep) {
    if(a[0][1] == 0 && a[0][2] == 0 && a[1][2] == 0)
      break;
    jacobi::rotate(a, v, 0, 1);
    jacobi::rotate(a, v, 0, 2);
    jacobi::rotate(a, v, 1, 2);
  }
  int order[3] = {0, 1, 2};
  auto sort_pair = [&](int i, int j) {
    if(a[order[j]][order[j]] < a[order[i]][order[i]]) {
      const int swapped = order[i];
      order[i] = order[j];
      order[j] = swapped;
    }
  };
  sort_pair(0, 1);
  sort_pair(1, 2);
  sort_pair(0, 1);
  Eigen_system e;
  for(int i = 0; i < 3; ++i) {
    const int c = order[i];
    e.value[i] = a[c][c];
    e.vector[i] = unit({v[0][c], v[1][c], v[2][c]});
  }
  return e;
}

// The integer plane through `point` (grid steps) with the unit normal `n`. Its offset belongs to the rounded normal, so
// it is most accurate near the point. At the far end of the grid, rounding may move it by about a step.
CGAL_TANDEM_HD inline Plane make_plane(const Vector& n, const Vector& point)
{
  Plane s;
  s.nx = std::int32_t(llrint(n.x * normal_scale));
  s.ny = std::int32_t(llrint(n.y * normal_scale));
  s.nz = std::int32_t(llrint(n.z * normal_scale));
  s.d = -llrint(dot({double(s.nx), double(s.ny), double(s.nz)}, point));
  return s;
}

// Octahedral code of a direction of any length: the octahedron |x| + |y| + |z| = 1, its lower half folded outward.
// Opposite directions decode to opposite vectors, so tests that ignore the sign of a normal cannot depend on it.
// Components are within +-32767, so no code equals no_normal. Vectors that are null or not finite become no_normal.
CGAL_TANDEM_HD inline std::uint32_t encode_normal(const Vector& n)
{
  const double sum = std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z);
  if(!(sum > 0) || sum > 1e300)
    return no_normal;
  const double sign = n.z < 0 ? -1 : 1;
  std::int32_t u = std::int32_t(llrint(sign * n.x / sum * 32767));
  std::int32_t v = std::int32_t(llrint(sign * n.y / sum * 32767));
  std::int32_t au = u < 0 ? -u : u;
  std::int32_t av = v < 0 ? -v : v;
  if(au + av > 32767 || n.z == 0) { // both were rounded up, or the direction lies on the border
    av = 32767 - au;
    v = n.y < 0 ? -av : av;
    v = sign < 0 ? -v : v;
  }
  if(sign < 0) { // the opposite of the upper direction (u, v)
    const std::int32_t fu = 32767 - av, fv = 32767 - au;
    u = u > 0 ? -fu : fu;
    v = v > 0 ? -fv : fv;
  }
  return std::uint32_t(std::uint16_t(std::int16_t(u))) | std::uint32_t(std::uint16_t(std::int16_t(v))) << 16;
}

// The vector that a packed normal stands for, of unit length; null for no_normal. It is rounded to float, so that
// files can hold exactly the normal that was used.
inline Vector unpacked_normal(std::uint32_t code)
{
  const Int_vector m = decode_normal(code);
  const Vector n = unit({double(m.x), double(m.y), double(m.z)});
  return {double(to_float(n.x)), double(to_float(n.y)), double(to_float(n.z))};
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_LINEAR_ALGEBRA_H
