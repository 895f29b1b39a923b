// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mean and covariance of a neighborhood in float, and the plane through it.
//
// Products are taken of two floats in double, where they are exact: sums of them
// come out the same whether or not a compiler contracts them, without the price
// of std::fma where the processor is not known to have it.

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORHOOD_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORHOOD_H

#include <CGAL/Tandem/internal/types.h>

#include <cmath>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Float_vector {
  float x, y, z;
};

CGAL_TANDEM_HD inline Float_vector operator+(const Float_vector& a, const Float_vector& b)
{
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

CGAL_TANDEM_HD inline Float_vector operator-(const Float_vector& a, const Float_vector& b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

CGAL_TANDEM_HD inline double exact_product(float a, float b) { return double(a) * double(b); }

CGAL_TANDEM_HD inline double exact_dot(const Float_vector& a, const Float_vector& b)
{
  return exact_product(a.x, b.x) + exact_product(a.y, b.y) + exact_product(a.z, b.z);
}

// From p to q, rounded to float where they are more than 2^24 steps apart.
CGAL_TANDEM_HD inline Float_vector difference(const Grid_point& q, const Grid_point& p)
{
  return {float(q.x - p.x), float(q.y - p.y), float(q.z - p.z)};
}

// In grid steps; the mean is relative to the point whose neighborhood it is.
struct Neighborhood {
  Float_vector mean;
  float xx, xy, xz, yy, yz, zz;
};

// The plane of least squares of a neighborhood; `normal` is unit up to rounding,
// null where the points are equal or collinear.
struct Neighborhood_plane {
  Float_vector normal;
  float smallest, middle; // eigenvalues of the covariance, in steps^2
};

namespace neighborhood_solver {

// Symmetric with trace 1; the cofactors are those of matrix - value.
struct Matrix {
  float xx, xy, xz, yy, yz, zz;
};

CGAL_TANDEM_HD inline float minor_of(float a, float b, float c, float d)
{
  return float(exact_product(a, b) - exact_product(c, d));
}

CGAL_TANDEM_HD inline Matrix cofactors(const Matrix& m)
{
  return {minor_of(m.yy, m.zz, m.yz, m.yz), minor_of(m.xz, m.yz, m.xy, m.zz), minor_of(m.xy, m.yz, m.xz, m.yy),
          minor_of(m.xx, m.zz, m.xz, m.xz), minor_of(m.xy, m.xz, m.xx, m.yz), minor_of(m.xx, m.yy, m.xy, m.xy)};
}

// The smallest root of r^3 - r^2 + q r - d, all of whose roots are real and not
// negative: Newton from 0 climbs to it without passing it.
CGAL_TANDEM_HD inline float smallest_root(double q, double d)
{
  float r = 0;
  for(int i = 0; i < 12; ++i) {
    const float quadratic = float(exact_product(r, r - 1) + q);
    const double value = exact_product(quadratic, r) - d;
    const double slope = exact_product(r, float(3 * double(r) - 2)) + q;
    if(!(slope > 0) || !(value < -1e-9 * slope))
      break;
    r = float(r - value / slope);
  }
  return r;
}

// The longest column of the adjugate of matrix - smallest root is the normal.
CGAL_TANDEM_HD inline Float_vector longest_column(const Matrix& c)
{
  if(c.xx >= c.yy && c.xx >= c.zz)
    return {c.xx, c.xy, c.xz};
  return c.yy >= c.zz ? Float_vector{c.xy, c.yy, c.yz} : Float_vector{c.xz, c.yz, c.zz};
}

CGAL_TANDEM_HD inline Float_vector unit(const Float_vector& v)
{
  const double length = std::sqrt(exact_dot(v, v));
  return length > 0 ? Float_vector{float(v.x / length), float(v.y / length), float(v.z / length)} : Float_vector{0, 0, 0};
}

} // namespace neighborhood_solver

CGAL_TANDEM_HD inline Neighborhood_plane fit_plane(const Neighborhood& h)
{
  using namespace neighborhood_solver;
  // Below this the second direction is rounding: of the grid (1/12 step^2), or of floats.
  const float least_width = 0.25f;
  const float least_ratio = 1e-6f;
  const float trace = h.xx + h.yy + h.zz;
  if(!(trace > least_width))
    return {{0, 0, 0}, 0, 0};
  const Matrix m = {h.xx / trace, h.xy / trace, h.xz / trace, h.yy / trace, h.yz / trace, h.zz / trace};
  const Matrix c = cofactors(m);
  const double q = double(c.xx) + double(c.yy) + double(c.zz);
  const double d = exact_product(m.xx, c.xx) + exact_product(m.xy, c.xy) + exact_product(m.xz, c.xz);
  const float r = smallest_root(q, d);
  const float rest = 1 - r; // the sum of the other two roots
  const double product = q - exact_product(r, rest);
  const double root = exact_product(rest, rest) - 4 * product;
  const float middle = float(2 * product / (rest + (root > 0 ? std::sqrt(root) : 0.0)));
  if(!(middle > least_ratio) || !(middle * trace > least_width))
    return {{0, 0, 0}, r * trace, 0};
  const Matrix shifted = {m.xx - r, m.xy, m.xz, m.yy - r, m.yz, m.zz - r};
  return {unit(longest_column(cofactors(shifted))), r * trace, middle * trace};
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORHOOD_H
