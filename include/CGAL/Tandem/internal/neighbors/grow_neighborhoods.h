// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The best plane of each point from its own neighborhood. The neighborhood grows, by averaging with those of its
// neighbors, until the expected angular error is small. Neither points nor neighbors change; the result is a table of
// candidates. See the manual, "Normals".

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_GROW_NEIGHBORHOODS_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_GROW_NEIGHBORHOODS_H

#include <CGAL/Tandem/internal/base/tuning/normals.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/neighbors/Neighborhood.h>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace normals {

using namespace tuning::normals;
using tuning::Share;

constexpr float no_plane = 1e30f; // instead of an error

// The plane with the smallest cost among those of a point.
struct Candidate {
  Float_vector mean;    // of its neighborhood, relative to the point
  float smallest;       // variance across the plane, at least that of a flat one (steps^2)
  float middle;         // least variance along it (steps^2)
  float error2;         // expected squared angular error from noise (radians^2), or no_plane
  std::uint32_t normal; // octahedral
};

// The tables of an estimation, by point, and its bounds in grid steps. It is passed to functors by value.
struct Workspace {
  Cloud_view cloud;
  Neighborhood* current; // at the present scale, or where its growth ended
  Neighborhood* next;    // at the next scale; undefined where growth has ended
  Candidate* candidate;
  const Grid_point* owner; // by candidate: the point that it comes from
  int k;                   // neighbors in use
  double flat2;            // variance of what is as good as flat, at epsilon, but for rounding
  double clutter2;         // least squared distance of clutter from its plane, at epsilon

  CGAL_TANDEM_HD float flat(std::uint32_t i) const
  {
    return to_float(std::fma(squared_tolerance(i), flat2, double(rounding_variance)));
  }
  CGAL_TANDEM_HD float minimum_clutter2(std::uint32_t i) const { return to_float(squared_tolerance(i) * clutter2); }

private:
  // Of a point, in epsilons.
  CGAL_TANDEM_HD double squared_tolerance(std::uint32_t i) const
  {
    const double factor = level_factor(cloud.level_of(i));
    return factor * factor;
  }
};

// The workspace of an estimation, for epsilon in grid steps. The tables of neighborhoods are set by the caller.
inline Workspace make_workspace(const Cloud_view& cloud, Candidate* candidate, double epsilon_grid)
{
  const float flat = to_float(noiseless_share * epsilon_grid);
  const float clutter = to_float(clutter_share * epsilon_grid);
  Workspace w = {};
  w.cloud = cloud;
  w.candidate = candidate;
  w.owner = cloud.point;
  w.k = cloud.k < maximum_neighbors ? cloud.k : maximum_neighbors;
  w.flat2 = exact_product(flat, flat);
  w.clutter2 = exact_product(clutter, clutter);
  return w;
}

// The neighborhood of point i and its k nearest neighbors.
CGAL_TANDEM_HD inline Neighborhood nearest_neighborhood(const Workspace& w, std::uint32_t i, int k)
{
  const Grid_point p = w.cloud.point[i];
  const std::uint32_t* row = w.cloud.row(i);
  Neighborhood_sum sum;
  sum.add({0, 0, 0});
  for(int j = 0; j < k && row[j] != no_index; ++j)
    sum.add(difference(w.cloud.point[row[j]], p));
  return sum.mean();
}

// The neighborhood of i joined with those of the farther half of its neighbors, which overlap with it less. Reads
// `current` only, so all points can be computed at the same time.
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

// The number of independent points of a neighborhood that has grown `scale` - 1 times. Its parts overlap, so it is less
// than their sum. Measured: (k + 1) (1 + 1.2 (scale - 1)).
CGAL_TANDEM_HD inline float effective_points(int k, int scale)
{
  constexpr Share growth = independent_growth;
  return to_float((k + 1) * (growth.numerator * (scale - 1) + growth.denominator)) / to_float(growth.denominator);
}

CGAL_TANDEM_HD inline std::uint32_t encoded_normal(const Neighborhood& h, float smallest)
{
  const Float_vector n = plane_normal(h, smallest);
  return encode_normal({n.x, n.y, n.z});
}

// The cost by which candidates are compared: expected error from noise, and a penalty for being thick, as across an
// edge. Here and below products are exact, so that no compiler can contract a sum differently.
CGAL_TANDEM_HD inline float cost(const Candidate& c)
{
  return to_float(c.error2 + exact_product(thickness_weight, c.smallest / c.middle));
}

// Replaces the candidate of point i by the plane of h if that costs less. `points` > 3 is the number of independent
// ones; a plane fitted to them takes three degrees of freedom from the variance across it.
CGAL_TANDEM_HD inline void consider(const Workspace& w, std::uint32_t i, const Neighborhood& h, float points)
{
  const Thickness t = thickness(h);
  if(!(t.middle > 0))
    return;
  const float unbiased = t.smallest * (points / (points - 3));
  const float flat = w.flat(i), smallest = unbiased > flat ? unbiased : flat;
  Candidate c = {h.mean, smallest, t.middle, smallest / t.middle / points, no_normal};
  if(w.candidate[i].error2 < no_plane && !(cost(c) < cost(w.candidate[i])))
    return;
  c.normal = encoded_normal(h, t.smallest);
  w.candidate[i] = c;
}

// Sets current[i] to the nearest neighbors, and the first candidate of point i.
struct Start {
  Workspace w;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    w.candidate[i] = {{0, 0, 0}, w.flat(std::uint32_t(i)), 0, no_plane, no_normal};
    w.current[i] = nearest_neighborhood(w, std::uint32_t(i), w.k);
    consider(w, std::uint32_t(i), w.current[i], effective_points(w.k, 1));
  }
};

// Writes next[i] where the error is too large. Points that have ended keep their `current` for their neighbors.
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
      consider(w, std::uint32_t(i), w.next[i], effective_points(w.k, scale));
  }
};

} // namespace normals
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_GROW_NEIGHBORHOODS_H
