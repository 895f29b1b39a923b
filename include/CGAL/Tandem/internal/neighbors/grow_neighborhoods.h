// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The best plane of each surfel from its own neighborhood. The neighborhood grows, by averaging with those of its
// neighbors, until the expected angular error is small. Neither surfels nor neighbors change; the result is a table of
// candidates. See the manual, "Normals".

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_GROW_NEIGHBORHOODS_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_GROW_NEIGHBORHOODS_H

#include <CGAL/Tandem/internal/base/tuning/normals.h>
#include <CGAL/Tandem/internal/base/types.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>

#include <cmath>

namespace CGAL {
namespace Tandem {
namespace internal {

// --- Mean and covariance of a neighborhood in float, and the plane through it. Half the memory of double, since there is
// one for each surfel while normals are estimated.
//
// Products of two floats are computed in double, where they are exact. So sums of them are the same whether or not a
// compiler contracts them, without a fused multiply-add.

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

// Mean (grid steps) and covariance (steps^2). The mean is relative to the surfel whose neighborhood it is.
// Floats suffice, since neighborhoods are small against the cloud.
struct Neighborhood {
  Float_vector mean;
  float xx, xy, xz, yy, yz, zz;
};

// The union of equally weighted surfels and neighborhoods. The order of the calls matters for the last bits. It is that
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

  // Adds a neighborhood of another surfel, which lies at `offset` from this one.
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
  // for a surfel a hundred times farther away than its neighbors are from each other.
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

// The neighborhood with second moments about the surfel itself instead of the mean. Its plane is the best one through
// the surfel.
CGAL_TANDEM_HD inline Neighborhood about_surfel(const Neighborhood& h)
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

// How many neighbors of a row of k count.
CGAL_TANDEM_HD inline int used_neighbors(int k)
{
  return k < tuning::normals::maximum_neighbors ? k : tuning::normals::maximum_neighbors;
}

// The neighborhood of surfel i and its k nearest neighbors.
CGAL_TANDEM_HD inline Neighborhood nearest_neighborhood(const Cloud_view& cloud, std::uint32_t i, int k)
{
  const Grid_point p = cloud.point[i];
  const std::uint32_t* row = cloud.row(i);
  Neighborhood_sum sum;
  sum.add({0, 0, 0});
  for(int j = 0; j < k && row[j] != no_index; ++j)
    sum.add(difference(cloud.point[row[j]], p));
  return sum.mean();
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
// and product of the others. That costs a fraction of an eigensystem, and there are up to five for each surfel.
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

namespace CGAL {
namespace Tandem {
namespace internal {
namespace normals {

using namespace tuning::normals;
using tuning::Ratio;

constexpr float no_plane = 1e30f; // instead of an error

// The plane with the smallest cost among those of a surfel.
struct Candidate {
  Float_vector mean;    // of its neighborhood, relative to the surfel
  float smallest;       // variance across the plane, at least that of a flat one (steps^2)
  float middle;         // least variance along it (steps^2)
  float error2;         // expected squared angular error from noise (radians^2), or no_plane
  float cost;           // error2 and a penalty for being thick, as across an edge; or no_plane
  std::uint32_t normal; // octahedral
};

// The tables of an estimation, by surfel, and its bounds in grid steps. It is passed to functors by value.
struct Workspace {
  Cloud_view cloud;
  Neighborhood* current; // at the present scale, or where its growth ended
  Neighborhood* next;    // at the next scale; undefined where growth has ended
  Candidate* candidate;
  const Grid_point* owner; // by candidate: the surfel that it comes from
  int k;                   // neighbors in use
  double flat2;            // variance of what is as good as flat, at epsilon, but for rounding
  double clutter2;         // least squared distance of clutter from its plane, at epsilon

  CGAL_TANDEM_HD float flat(std::uint32_t i) const
  {
    return to_float(fused(squared_tolerance(i), flat2, double(rounding_variance)));
  }
  CGAL_TANDEM_HD float minimum_clutter2(std::uint32_t i) const { return to_float(squared_tolerance(i) * clutter2); }

private:
  // Of a surfel, in epsilons.
  CGAL_TANDEM_HD double squared_tolerance(std::uint32_t i) const
  {
    const double factor = level_factor(cloud.level_of(i));
    return factor * factor;
  }
};

// The workspace of an estimation, for epsilon in grid steps. The tables of neighborhoods are set by the caller.
inline Workspace make_workspace(const Cloud_view& cloud, Candidate* candidate, double epsilon_steps)
{
  const float flat = to_float(noiseless_fraction * epsilon_steps);
  const float clutter = to_float(clutter_fraction * epsilon_steps);
  Workspace w = {};
  w.cloud = cloud;
  w.candidate = candidate;
  w.owner = cloud.point;
  w.k = used_neighbors(cloud.k);
  w.flat2 = exact_product(flat, flat);
  w.clutter2 = exact_product(clutter, clutter);
  return w;
}

// The neighborhood of i joined with those of the farther half of its neighbors, which overlap with it less. Reads
// `current` only, so all surfels can be computed at the same time.
CGAL_TANDEM_HD inline Neighborhood grown_neighborhood(const Workspace& w, std::uint32_t i)
{
  const Grid_point p = w.cloud.point[i];
  const std::uint32_t* row = w.cloud.row(i);
  Neighborhood_sum sum;
  sum.add({0, 0, 0}, w.current[i]);
  for(int j = w.k / 2; j < w.k && row[j] != no_index; ++j)
    sum.add(difference(w.cloud.point[row[j]], p), w.current[row[j]]);
  return sum.mean();
}

// The number of independent surfels of a neighborhood that has grown `scale` - 1 times. Its parts overlap, so it is
// less than their sum. Measured: (k + 1) (1 + 1.2 (scale - 1)).
CGAL_TANDEM_HD inline float effective_surfels(int k, int scale)
{
  constexpr Ratio growth = independent_growth;
  return to_float((k + 1) * (growth.numerator * (scale - 1) + growth.denominator)) / to_float(growth.denominator);
}

CGAL_TANDEM_HD inline std::uint32_t encoded_normal(const Neighborhood& h, float smallest)
{
  const Float_vector n = plane_normal(h, smallest);
  return encode_normal({n.x, n.y, n.z});
}

// Replaces the candidate of surfel i by the plane of h if that costs less. `points` > 3 is the number of independent
// ones; a plane fitted to them takes three degrees of freedom from the variance across it.
CGAL_TANDEM_HD inline void consider(const Workspace& w, std::uint32_t i, const Neighborhood& h, float points)
{
  const Thickness t = thickness(h);
  if(!(t.middle > 0))
    return;
  const float unbiased = t.smallest * (points / (points - 3));
  const float flat = w.flat(i), smallest = unbiased > flat ? unbiased : flat;
  const float ratio = smallest / t.middle, error2 = ratio / points;
  // Here and below products are exact, so that no compiler can contract a sum differently.
  const float cost = to_float(error2 + exact_product(thickness_weight, ratio));
  if(cost < w.candidate[i].cost)
    w.candidate[i] = {h.mean, smallest, t.middle, error2, cost, encoded_normal(h, t.smallest)};
}

// Sets current[i] to the nearest neighbors, and the first candidate of surfel i.
struct Start {
  Workspace w;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    w.candidate[i] = {{0, 0, 0}, w.flat(std::uint32_t(i)), 0, no_plane, no_plane, no_normal};
    w.current[i] = nearest_neighborhood(w.cloud, std::uint32_t(i), w.k);
    consider(w, std::uint32_t(i), w.current[i], effective_surfels(w.k, 1));
  }
};

// Writes next[i] where the error is too large. Surfels that have ended keep their `current` for their neighbors.
struct Grow {
  Workspace w;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(w.candidate[i].error2 > good_error2)
      w.next[i] = grown_neighborhood(w, std::uint32_t(i));
  }
};

// Takes over what Grow has written: in a loop of its own, since neighbors read current[i] while they grow. At some
// scales the plane is considered as well.
struct Commit {
  Workspace w;
  int scale;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(!(w.candidate[i].error2 > good_error2))
      return;
    if(scale < last_scale)
      w.current[i] = w.next[i];
    if((scale & (scale - 1)) == 0) // 2, 4, 8: measured, all scales are not better
      consider(w, std::uint32_t(i), w.next[i], effective_surfels(w.k, scale));
  }
};

} // namespace normals
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_GROW_NEIGHBORHOODS_H
