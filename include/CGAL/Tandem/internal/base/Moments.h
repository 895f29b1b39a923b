// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Integer moments of a set of grid points, and the least-squares plane that follows from them.
// Sums are exact: they do not depend on the order of the points, and points can be taken out again. Only the step from
// moments to a scatter matrix rounds, in a fixed order.

#ifndef CGAL_TANDEM_INTERNAL_BASE_MOMENTS_H
#define CGAL_TANDEM_INTERNAL_BASE_MOMENTS_H

#include <CGAL/Tandem/internal/base/linear_algebra.h>

#include <vector>

namespace CGAL::Tandem::internal {

// __extension__ keeps -Wpedantic silent about a type that is not standard.
__extension__ typedef __int128 Int128;

// Number, sum and products of points. Product has 64 bits within a cell, 128 bits in the whole grid. The other sums
// fit 64 bits up to 2^35 points of coordinates up to 2^28.
template <class Product>
struct Moment_sums {
  std::int64_t count = 0;
  std::int64_t sum[3] = {0, 0, 0};
  Product product[6] = {0, 0, 0, 0, 0, 0}; // xx xy xz yy yz zz
  Product squared_tolerances = 0;          // sum of squared_level(); as wide as that, so that there is no padding

  // Takes a point out with sign -1.
  CGAL_TANDEM_HD void add(std::int64_t x, std::int64_t y, std::int64_t z, int sign = 1, std::uint8_t level = 0)
  {
    count += sign;
    squared_tolerances += sign * squared_level(level);
    sum[0] += sign * x;
    sum[1] += sign * y;
    sum[2] += sign * z;
    product[0] += sign * (x * x);
    product[1] += sign * (x * y);
    product[2] += sign * (x * z);
    product[3] += sign * (y * y);
    product[4] += sign * (y * z);
    product[5] += sign * (z * z);
  }

  CGAL_TANDEM_HD void operator+=(const Moment_sums& m)
  {
    count += m.count;
    squared_tolerances += m.squared_tolerances;
    for(int i = 0; i < 3; ++i)
      sum[i] += m.sum[i];
    for(int i = 0; i < 6; ++i)
      product[i] += m.product[i];
  }

  CGAL_TANDEM_HD void operator-=(const Moment_sums& m)
  {
    count -= m.count;
    squared_tolerances -= m.squared_tolerances;
    for(int i = 0; i < 3; ++i)
      sum[i] -= m.sum[i];
    for(int i = 0; i < 6; ++i)
      product[i] -= m.product[i];
  }
};

// Moments of points of one cell, relative to one of them: see cell_extent_bits for why 64 bits suffice.
using Cell_moments = Moment_sums<std::int64_t>;

// Moments of any points, in grid coordinates: products of up to 2^56 times 2^35 points need 128 bits.
struct Moments : Moment_sums<Int128> {
  CGAL_TANDEM_HD void add(const Grid_point& p, int sign = 1, std::uint8_t level = 0)
  {
    Moment_sums::add(p.x, p.y, p.z, sign, level);
  }
};

// Moments about (ox, oy, oz) as moments about the origin of the grid. There those of all cells of a shape can be added.
// Exact: products of q = p + o are expanded as pp' + op' + po' + oo'.
CGAL_TANDEM_HD inline Moments shifted(const Cell_moments& m, std::int64_t ox, std::int64_t oy, std::int64_t oz)
{
  const std::int64_t o[3] = {ox, oy, oz};
  Moments r;
  r.count = m.count;
  r.squared_tolerances = m.squared_tolerances;
  for(int i = 0, k = 0; i < 3; ++i) {
    r.sum[i] = m.sum[i] + m.count * o[i];
    for(int j = i; j < 3; ++j, ++k)
      r.product[k] =
        Int128(m.product[k]) + Int128(o[i]) * m.sum[j] + Int128(o[j]) * m.sum[i] + Int128(o[i]) * o[j] * m.count;
  }
  return r;
}

// The mean squared tolerance of the points, in epsilons: 1 where all have that of the detection.
CGAL_TANDEM_HD inline double squared_tolerance(const Moments& m)
{
  return m.squared_tolerances > 0 ? double(m.squared_tolerances) / (double(m.count) * double(squared_level_unit)) : 1;
}

// Centroid (grid steps) and scatter matrix (steps^2), the sum of (p - centroid)(p - centroid)' over count points.
struct Scatter {
  double count;
  Vector centroid;
  Symmetric_matrix matrix;
  double squared_tolerance = 1; // see above

  // In sums of squared distances of several shapes: points count less where they have large tolerances.
  CGAL_TANDEM_HD double weight() const { return count / squared_tolerance; }
};

CGAL_TANDEM_HD inline Symmetric_matrix operator/(const Symmetric_matrix& m, double divisor)
{
  return {m.xx / divisor, m.xy / divisor, m.xz / divisor, m.yy / divisor, m.yz / divisor, m.zz / divisor};
}

// With distances in units of the tolerance of the points, in epsilons.
CGAL_TANDEM_HD inline Scatter weighted(const Scatter& s)
{
  return {s.weight(), s.centroid, s.matrix / s.squared_tolerance};
}

// Far from the origin, products are huge against the scatter. So they are moved to the rounded centroid as integers,
// before anything becomes a double. Null moments give a null matrix.
CGAL_TANDEM_HD inline Scatter make_scatter(const Moments& m)
{
  Scatter s;
  s.count = double(m.count);
  s.squared_tolerance = squared_tolerance(m);
  const std::int64_t n = m.count > 0 ? m.count : 1;
  std::int64_t o[3]; // the centroid, rounded: sums about it are small and exact
  double rest[3];    // centroid - o, times count; below count
  for(int i = 0; i < 3; ++i) {
    o[i] = m.sum[i] / n;
    rest[i] = double(m.sum[i] - o[i] * n);
  }
  double c[6];
  for(int i = 0, k = 0; i < 3; ++i)
    for(int j = i; j < 3; ++j, ++k) {
      const Int128 about = m.product[k] - Int128(o[i]) * m.sum[j] - Int128(o[j]) * m.sum[i] + Int128(o[i]) * o[j] * n;
      c[k] = fused(-rest[i], rest[j] / double(n), double(about));
    }
  s.matrix = {c[0], c[1], c[2], c[3], c[4], c[5]};
  s.centroid = {double(o[0]) + rest[0] / double(n), double(o[1]) + rest[1] / double(n),
                double(o[2]) + rest[2] / double(n)};
  return s;
}

// The scatter matrix of two disjoint sets of points together. It is the sum of both and n m / (n + m) dd', where
// d is the difference of the centroids.
CGAL_TANDEM_HD inline Symmetric_matrix joint_matrix(const Scatter& a, const Scatter& b)
{
  const Vector d = b.centroid - a.centroid;
  const Vector e = a.count * b.count / (a.count + b.count) * d;
  const Symmetric_matrix s = a.matrix + b.matrix;
  return {fused(e.x, d.x, s.xx), fused(e.x, d.y, s.xy), fused(e.x, d.z, s.xz),
          fused(e.y, d.y, s.yy), fused(e.y, d.z, s.yz), fused(e.z, d.z, s.zz)};
}

// Least-squares plane of a set of points; it passes through their centroid.
struct Fit {
  Vector normal;   // unit; its sign is arbitrary
  double smallest; // smallest eigenvalue of the scatter: the sum of squared distances, in steps^2
  double largest;  // largest eigenvalue; divided by the count, the variance along the longest axis
};

// Eigenvalues that rounding has made negative count as 0.
CGAL_TANDEM_HD inline Fit fit_plane(const Scatter& s)
{
  const Eigen_system e = eigen_system(s.matrix);
  return {e.vector[0], e.value[0] > 0 ? e.value[0] : 0, e.value[2] > 0 ? e.value[2] : 0};
}

// A shape: its scatter and its local least-squares plane, which passes through the centroid and has a unit normal.
struct Shape_fit {
  Scatter scatter;
  Fit fit;
  Eigen_system eigen = {}; // of the scatter, where somebody has computed it; null vectors stand for none
};

using Shape_fits = std::vector<Shape_fit>;

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_MOMENTS_H
