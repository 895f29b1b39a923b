// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mean and covariance of a neighborhood in float, and the plane through it. Half the memory of double, since there is
// one for each point while normals are estimated.
//
// Products of two floats are computed in double, where they are exact. So sums of them are the same whether or not a
// compiler contracts them. std::fma would be a slow call where the processor is not known to have it.

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_NEIGHBORHOOD_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_NEIGHBORHOOD_H

#include <CGAL/Tandem/internal/base/tuning/normals.h>
#include <CGAL/Tandem/internal/base/types.h>

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

// The product of two floats. It has at most 48 bits, so it never rounds.
CGAL_TANDEM_HD inline double exact_product(float a, float b) { return double(a) * double(b); }

CGAL_TANDEM_HD inline double exact_dot(const Float_vector& a, const Float_vector& b)
{
  return exact_product(a.x, b.x) + exact_product(a.y, b.y) + exact_product(a.z, b.z);
}

// The vector from p to q, rounded where they are more than 2^24 steps apart.
CGAL_TANDEM_HD inline Float_vector difference(const Grid_point& q, const Grid_point& p)
{
  return {to_float(q.x - p.x), to_float(q.y - p.y), to_float(q.z - p.z)};
}

// Mean (grid steps) and covariance (steps^2). The mean is relative to the point whose neighborhood it is.
// Floats suffice, since neighborhoods are small against the cloud.
struct Neighborhood {
  Float_vector mean;
  float xx, xy, xz, yy, yz, zz;
};

// The union of equally weighted points and neighborhoods. The order of the calls matters for the last bits. It is that
// of the rows of neighbors, which is the same on all back ends.
struct Neighborhood_sum {
  double x = 0, y = 0, z = 0;
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  int size = 0;

  CGAL_TANDEM_HD void add(const Float_vector& m)
  {
    x += m.x;
    y += m.y;
    z += m.z;
    xx += exact_product(m.x, m.x);
    xy += exact_product(m.x, m.y);
    xz += exact_product(m.x, m.z);
    yy += exact_product(m.y, m.y);
    yz += exact_product(m.y, m.z);
    zz += exact_product(m.z, m.z);
    ++size;
  }

  // Adds a neighborhood of another point, which lies at `offset` from this one.
  CGAL_TANDEM_HD void add(const Float_vector& offset, const Neighborhood& h)
  {
    add(offset + h.mean);
    xx += h.xx;
    xy += h.xy;
    xz += h.xz;
    yy += h.yy;
    yz += h.yz;
    zz += h.zz;
  }

  // The neighborhood, of at least one part. Rounding to float costs 1e-7 of the length of the mean. This matters only
  // for a point a hundred times farther away than its neighbors are from each other.
  CGAL_TANDEM_HD Neighborhood mean() const
  {
    const double weight = 1.0 / size;
    const Float_vector s = {to_float(x), to_float(y), to_float(z)};
    const Float_vector m = {to_float(x * weight), to_float(y * weight), to_float(z * weight)};
    return {m,
            to_float((xx - exact_product(s.x, m.x)) * weight),
            to_float((xy - exact_product(s.x, m.y)) * weight),
            to_float((xz - exact_product(s.x, m.z)) * weight),
            to_float((yy - exact_product(s.y, m.y)) * weight),
            to_float((yz - exact_product(s.y, m.z)) * weight),
            to_float((zz - exact_product(s.z, m.z)) * weight)};
  }
};

// The neighborhood with second moments about the point itself instead of the mean. Its plane is the best one through
// the point.
CGAL_TANDEM_HD inline Neighborhood about_point(const Neighborhood& h)
{
  const Float_vector& m = h.mean;
  return {{0, 0, 0},
          to_float(h.xx + exact_product(m.x, m.x)),
          to_float(h.xy + exact_product(m.x, m.y)),
          to_float(h.xz + exact_product(m.x, m.z)),
          to_float(h.yy + exact_product(m.y, m.y)),
          to_float(h.yz + exact_product(m.y, m.z)),
          to_float(h.zz + exact_product(m.z, m.z))};
}

// The two lower eigenvalues of the covariance, in steps^2. They are the variance across the plane and the least one
// along it. middle is 0 where there is no plane.
struct Thickness {
  float smallest, middle;
};

namespace covariance {

// A symmetric 3x3 matrix.
struct Matrix {
  float xx, xy, xz, yy, yz, zz;
};

// a b - c d, rounded twice at most: see exact_product().
CGAL_TANDEM_HD inline float minor_of(float a, float b, float c, float d)
{
  return to_float(exact_product(a, b) - exact_product(c, d));
}

// The adjugate of m. Its trace is a coefficient of the characteristic polynomial: the sum of products of two
// eigenvalues.
CGAL_TANDEM_HD inline Matrix cofactors(const Matrix& m)
{
  return {minor_of(m.yy, m.zz, m.yz, m.yz), minor_of(m.xz, m.yz, m.xy, m.zz), minor_of(m.xy, m.yz, m.xz, m.yy),
          minor_of(m.xx, m.zz, m.xz, m.xz), minor_of(m.xy, m.xz, m.xx, m.yz), minor_of(m.xx, m.yy, m.xy, m.xy)};
}

// The smallest root of r^3 - t r^2 + q r - d, the characteristic polynomial, whose roots are real and not negative.
// Starts with the first terms of its series in d, then follows Newton's method. Both approach the root from below. It
// ends when the rest is below 1e-5 of the distance to the next root.
CGAL_TANDEM_HD inline float smallest_root(float t, float q, double d)
{
  if(!(q > 0) || !(d > 0))
    return 0;
  const float start = to_float(d / q);
  float r = to_float(start + exact_product(start, to_float(exact_product(t, start) / q)));
  for(int i = 0; i < tuning::normals::variance_steps; ++i) {
    const float r2 = to_float(exact_product(r, r));
    const double value = d - exact_product(r, q) - exact_product(r2, to_float(double(r) - t));
    const double slope = 3 * double(r2) - 2 * exact_product(r, t) + q;
    if(!(slope > 0) || !(value > 0))
      break;
    const float step = to_float(value / slope);
    r += step;
    if(exact_product(step, t) < tuning::normals::last_variance_step * slope)
      break;
  }
  return r;
}

} // namespace covariance

// The two lower eigenvalues from the characteristic polynomial: the smallest root first, then the middle one from sum
// and product of the others. That costs a fraction of an eigensystem, and there are up to five for each point.
CGAL_TANDEM_HD inline Thickness thickness(const Neighborhood& h)
{
  // Below this the second direction is rounding: of the grid (1/12 step^2), or of floats.
  const float minimum_width = tuning::normals::minimum_width2, minimum_ratio = tuning::normals::minimum_width_ratio2;
  const float t = h.xx + h.yy + h.zz;
  if(!(t > minimum_width))
    return {0, 0};
  const covariance::Matrix m = {h.xx, h.xy, h.xz, h.yy, h.yz, h.zz};
  const covariance::Matrix c = covariance::cofactors(m);
  const float q = c.xx + c.yy + c.zz;
  const double d = exact_product(m.xx, c.xx) + exact_product(m.xy, c.xy) + exact_product(m.xz, c.xz);
  const float r = covariance::smallest_root(t, q, d);
  const float sum = to_float(double(t) - r); // of the other two roots
  const double product = q - exact_product(r, sum);
  const double discriminant = exact_product(sum, sum) - 4 * product;
  const float middle = to_float(2 * product / (sum + (discriminant > 0 ? std::sqrt(discriminant) : 0.0)));
  return {r, middle > minimum_width && middle > minimum_ratio * t ? middle : 0};
}

// The normal of the plane: the direction of the smallest eigenvalue, not of unit length. It is the longest column of
// the adjugate of the covariance less that eigenvalue.
CGAL_TANDEM_HD inline Float_vector plane_normal(const Neighborhood& h, float smallest)
{
  const covariance::Matrix m = {to_float(double(h.xx) - smallest), h.xy, h.xz,
                                to_float(double(h.yy) - smallest), h.yz, to_float(double(h.zz) - smallest)};
  const covariance::Matrix c = covariance::cofactors(m);
  if(c.xx >= c.yy && c.xx >= c.zz)
    return {c.xx, c.xy, c.xz};
  return c.yy >= c.zz ? Float_vector{c.xy, c.yy, c.yz} : Float_vector{c.xz, c.yz, c.zz};
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_NEIGHBORHOOD_H
