// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals for clouds that have none. Two things spoil the plane through the
// nearest neighbors of a point: noise, where they are too few, and edges, where
// they lie on two faces. Against noise the neighborhood of a point grows, by
// averaging with those of its neighbors, until the expected angular error is
// small. Near edges a point takes over the plane of a neighbor that lies on one
// face only. A point that is off its plane by more than the noise is clutter and
// keeps the plane of its nearest neighbors.

#ifndef CGAL_TANDEM_INTERNAL_ESTIMATE_NORMALS_H
#define CGAL_TANDEM_INTERNAL_ESTIMATE_NORMALS_H

#include <CGAL/Tandem/internal/Cloud.h>
#include <CGAL/Tandem/internal/Neighborhood.h>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace normals {

#ifndef H2_SKIP
#define H2_SKIP 1.0
#endif
#ifndef H2_C2
#define H2_C2 6.25f
#endif
#ifndef H2_FLOOR
#define H2_FLOOR 0.02f
#endif
#ifndef H2_LAST
#define H2_LAST 8
#endif
#ifndef H2_EDGE
#define H2_EDGE 3
#endif

constexpr int most_neighbors = 12;
constexpr int last_scale = H2_LAST;
constexpr float good_error2 = 0.00274f;       // (3 degrees)^2
constexpr float excellent_error2 = float(0.0003046*H2_SKIP*H2_SKIP);  // (1 degree)^2: left alone by the edge pass
constexpr float no_plane = 1e30f;

// The best plane that a point has found for itself.
struct Candidate {
  Float_vector mean;     // of its neighborhood, relative to the point
  float smallest;        // variance across the plane
  float middle;          // least variance along it
  float error2;          // expected squared angular error, no_plane if there is no plane
  std::uint32_t normal;  // octahedral
};

struct Workspace {
  Cloud_view cloud;
  Neighborhood* current;
  Neighborhood* next;
  Candidate* candidate;
  float floor2; // variance that counts as no noise at all
  int k;
};

// The union of equally weighted parts; each is f(index) relative to point i.
struct Mixture {
  Float_vector mean[most_neighbors + 1];
  double sum[3] = {0, 0, 0};
  double product[6] = {0, 0, 0, 0, 0, 0};
  int size = 0;

  CGAL_TANDEM_HD void add(const Float_vector& m)
  {
    mean[size++] = m;
    sum[0] += m.x;
    sum[1] += m.y;
    sum[2] += m.z;
  }

  CGAL_TANDEM_HD void add(const Float_vector& offset, const Neighborhood& h)
  {
    add(offset + h.mean);
    product[0] += h.xx;
    product[1] += h.xy;
    product[2] += h.xz;
    product[3] += h.yy;
    product[4] += h.yz;
    product[5] += h.zz;
  }

  CGAL_TANDEM_HD Neighborhood result()
  {
    const double n = size;
    const Float_vector center = {float(sum[0] / n), float(sum[1] / n), float(sum[2] / n)};
    for(int j = 0; j < size; ++j) {
      const Float_vector d = mean[j] - center;
      product[0] += exact_product(d.x, d.x);
      product[1] += exact_product(d.x, d.y);
      product[2] += exact_product(d.x, d.z);
      product[3] += exact_product(d.y, d.y);
      product[4] += exact_product(d.y, d.z);
      product[5] += exact_product(d.z, d.z);
    }
    return {center, float(product[0] / n), float(product[1] / n), float(product[2] / n),
            float(product[3] / n), float(product[4] / n), float(product[5] / n)};
  }
};

CGAL_TANDEM_HD inline Neighborhood nearest_neighborhood(const Workspace& w, std::uint32_t i)
{
  const Grid_point p = w.cloud.point[i];
  const std::uint32_t* row = w.cloud.row(i);
  Mixture mixture;
  mixture.add({0, 0, 0});
  for(int j = 0; j < w.k && row[j] != no_index; ++j)
    mixture.add(difference(w.cloud.point[row[j]], p));
  return mixture.result();
}

// The neighborhood of a point joined with those of the farther half of its neighbors.
CGAL_TANDEM_HD inline Neighborhood grown_neighborhood(const Workspace& w, std::uint32_t i)
{
  const Grid_point p = w.cloud.point[i];
  const std::uint32_t* row = w.cloud.row(i);
  Mixture mixture;
  mixture.add({0, 0, 0}, w.current[i]);
  for(int j = w.k / 2; j < w.k && row[j] != no_index; ++j)
    mixture.add(difference(w.cloud.point[row[j]], p), w.current[row[j]]);
  return mixture.result();
}

CGAL_TANDEM_HD inline Candidate make_candidate(const Workspace& w, const Neighborhood& h, float points)
{
  const Neighborhood_plane s = fit_plane(h);
  Candidate c = {h.mean, s.smallest, s.middle, no_plane, no_normal};
  if(s.middle > 0) {
    c.error2 = (s.smallest > w.floor2 ? s.smallest : w.floor2) / s.middle / points;
    c.normal = encode_normal({s.normal.x, s.normal.y, s.normal.z});
  }
  return c;
}

CGAL_TANDEM_HD inline bool is_evaluated(int scale) { return scale != 4 && scale != 6 && scale != 7; }

// The number of independent points that a neighborhood is worth after `scale` - 1 steps.
CGAL_TANDEM_HD inline float effective_points(const Workspace& w, int scale)
{
  return float(w.k + 1) * (1.0f + 1.2f * float(scale - 1));
}

struct Start {
  Workspace w;
  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    w.current[i] = nearest_neighborhood(w, std::uint32_t(i));
    w.candidate[i] = make_candidate(w, w.current[i], effective_points(w, 1));
  }
};

struct Grow {
  Workspace w;
  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(w.candidate[i].error2 > good_error2)
      w.next[i] = grown_neighborhood(w, std::uint32_t(i));
  }
};

struct Commit {
  Workspace w;
  int scale;
  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(!(w.candidate[i].error2 > good_error2))
      return;
    w.current[i] = w.next[i];
    if(!is_evaluated(scale))
      return;
    const Candidate c = make_candidate(w, w.current[i], effective_points(w, scale));
    if(c.error2 < w.candidate[i].error2)
      w.candidate[i] = c;
  }
};

CGAL_TANDEM_HD inline Float_vector code_vector(std::uint32_t code)
{
  const Int_vector v = decode_normal(code);
  return {float(v.x), float(v.y), float(v.z)};
}

// Whether p is off the plane of point s by at most `limit2` (squared).
CGAL_TANDEM_HD inline bool is_within(const Candidate& c, const Float_vector& from_mean, float limit2)
{
  const Float_vector n = code_vector(c.normal);
  const float e = float(exact_dot(n, from_mean));
  return exact_product(e, e) <= double(limit2) * exact_dot(n, n);
}

struct Adopt {
  Workspace w;
  const std::uint32_t* source; // whose candidate a point has
  std::uint32_t* next;
  CGAL_TANDEM_HD bool is_adoptable(const Grid_point& p, std::uint32_t s) const
  {
    const Candidate& c = w.candidate[s];
    const Float_vector d = difference(p, w.cloud.point[s]) - c.mean;
    const float limit2 = 4 * (c.smallest > w.floor2 ? c.smallest : w.floor2);
    return exact_dot(d, d) <= 16 * double(c.middle) && is_within(c, d, limit2);
  }

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    next[i] = source[i];
    float least = w.candidate[source[i]].error2;
    if(!(least > excellent_error2))
      return;
    least *= 0.49f;
    const Grid_point p = w.cloud.point[i];
    const std::uint32_t* row = w.cloud.row(std::uint32_t(i));
    for(int j = 0; j < w.cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t s = source[row[j]];
      if(w.candidate[s].error2 < least && is_adoptable(p, s)) {
        next[i] = s;
        least = w.candidate[s].error2;
      }
    }
  }
};

struct Finish {
  Workspace w;
  const std::uint32_t* source;
  Grid_point* point;
  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t s = source[i];
    const Candidate& c = w.candidate[s];
    const Float_vector d = difference(w.cloud.point[i], w.cloud.point[s]) - c.mean;
    const float limit2 = H2_C2 * (c.smallest > w.floor2 ? c.smallest : w.floor2);
    std::uint32_t n = c.normal;
    if(n != no_normal && !is_within(c, d, limit2))
      n = make_candidate(w, nearest_neighborhood(w, std::uint32_t(i)), 1).normal;
    point[i].normal = n;
  }
};

} // namespace normals

template <class Backend>
void estimate_normals(Backend& backend, const Cloud_view& cloud, Grid_point* point, double epsilon_grid)
{
  using namespace normals;
  const std::size_t n = cloud.size;
  typename Backend::template Buffer<Neighborhood> current(n), next(n);
  typename Backend::template Buffer<Candidate> candidate(n);
  const double floor = H2_FLOOR * epsilon_grid;
  const Workspace w = {cloud, current.data(), next.data(), candidate.data(), float(floor * floor) + 0.25f,
                       cloud.k < most_neighbors ? cloud.k : most_neighbors};
  backend.for_each(n, Start{w});
  for(int scale = 2; scale <= last_scale; ++scale) {
    backend.for_each(n, Grow{w});
    backend.for_each(n, Commit{w, scale});
  }
  current.release();
  next.release();
  typename Backend::template Buffer<std::uint32_t> source(n), next_source(n);
  backend.for_each(n, [s = source.data()](std::size_t i) { s[i] = std::uint32_t(i); });
  for(int pass = 0; pass < H2_EDGE; ++pass) {
    backend.for_each(n, Adopt{w, source.data(), next_source.data()});
    std::swap(source, next_source);
  }
  backend.for_each(n, Finish{w, source.data(), point});
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ESTIMATE_NORMALS_H
