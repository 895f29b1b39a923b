// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals for clouds that have none; nothing else of the cloud changes. Two things spoil the plane through the nearest
// neighbors of a surfel. One is noise, where they are too few; the other is edges, where they lie on two faces. Against
// noise the neighborhood of a surfel grows until the expected angular error is small: grow_neighborhoods.h. Near edges
// a surfel takes over the plane of a neighbor that lies on one face only. A surfel that is off its plane by more than
// the noise is clutter. It gets no smooth normal, but the rough one of a plane through it. See the manual, "Normals".

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_ESTIMATE_NORMALS_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_ESTIMATE_NORMALS_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/neighbors/grow_neighborhoods.h>

#include <utility>

namespace CGAL::Tandem::internal {
namespace normals {

// The vector from the center of the plane of candidate s to p.
CGAL_TANDEM_HD inline Float_vector from_center(const Workspace& w, std::uint32_t s, const Grid_point& p)
{
  return difference(p, w.owner[s]) - w.candidate[s].mean;
}

// The squared distance to the plane (steps^2) of a surfel at d from its center.
CGAL_TANDEM_HD inline float plane_distance2(const Candidate& c, const Float_vector& d)
{
  const Int_vector v = decode_normal(c.normal);
  const Float_vector n = {to_float(v.x), to_float(v.y), to_float(v.z)};
  const float e = to_float(exact_dot(n, d));
  return to_float(exact_product(e, e) / exact_dot(n, n));
}

// One pass, in which planes propagate to neighbors near edges. next[i] becomes the cheapest acceptable candidate of the
// neighbors of surfel i, or stays its own. All read `source`, which the pass before has written, so their order does
// not matter. Of equal costs the
// first in the row of neighbors counts.
struct Take_neighbor_plane {
  Workspace w;
  const std::uint32_t* source; // by surfel: the one whose candidate it has
  std::uint32_t* next;

  // Whether p is near the center of the candidate and near its plane, in its standard deviations.
  CGAL_TANDEM_HD bool is_acceptable(std::uint32_t s, const Grid_point& p) const
  {
    const Candidate& c = w.candidate[s];
    const Float_vector d = from_center(w, s, p);
    return exact_dot(d, d) <= double(propagation_width2) * c.middle &&
           plane_distance2(c, d) <= propagation_thickness2 * c.smallest;
  }

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t own = source[i];
    next[i] = own;
    const Candidate& c = w.candidate[own];
    if(!(c.error2 > excellent_error2))
      return;
    float minimum = propagation_cost_fraction * c.cost;
    const Grid_point p = w.cloud.point[i];
    const std::uint32_t* row = w.cloud.row(std::uint32_t(i));
    for(int j = 0; j < w.k && row[j] != no_index; ++j) {
      const std::uint32_t s = source[row[j]];
      if(w.candidate[s].cost < minimum && is_acceptable(s, p)) {
        next[i] = s;
        minimum = w.candidate[s].cost;
      }
    }
  }
};

// Writes the normal of surfel i: that of its candidate, or a rough one for clutter.
struct Finish {
  Workspace w;
  const std::uint32_t* source;
  Grid_point* point;

  // The packed normal of a plane through the surfel itself and few neighbors. Those on a face beside it lie in the
  // direction of the normal of the face. So the rough plane is across the face, and the surfel does not fit it.
  CGAL_TANDEM_HD std::uint32_t rough_normal(std::uint32_t i) const
  {
    const Neighborhood h = about_surfel(
      nearest_neighborhood(w.cloud, i, w.k < 2 * minimum_rough_neighbors ? minimum_rough_neighbors : w.k / 2));
    const Thickness t = thickness(h);
    return t.middle > 0 ? encoded_normal(h, t.smallest) : no_normal;
  }

  // Clutter thickens its own neighborhood. So its distance is compared with the thickness at its neighbors, and most of
  // them decide.
  CGAL_TANDEM_HD bool lies_in_clutter(std::uint32_t i, const Candidate& c) const
  {
    const float e2 = plane_distance2(c, from_center(w, source[i], w.cloud.point[i]));
    if(e2 <= w.minimum_clutter2(i) || e2 <= c.smallest)
      return false;
    const std::uint32_t* row = w.cloud.row(i);
    int beyond = 0, size = 0;
    for(; size < w.k && row[size] != no_index; ++size)
      beyond += e2 > clutter_thickness2 * w.candidate[source[row[size]]].smallest;
    return 2 * beyond > size;
  }

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const Candidate& c = w.candidate[source[i]];
    const bool is_rough = c.error2 < no_plane && lies_in_clutter(std::uint32_t(i), c);
    point[i].normal = is_rough ? rough_normal(std::uint32_t(i)) : c.normal;
  }
};

// A candidate that has propagated to a surfel on another rank, with the surfel that it comes from.
struct Propagated {
  Candidate candidate;
  Grid_point owner;
};

struct Get_propagated {
  Workspace w;
  const std::uint32_t* source;
  Propagated* propagated;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { propagated[i] = {w.candidate[source[i]], w.owner[source[i]]}; }
};

// Puts what has propagated to a ghost among the candidates.
struct Put_propagated {
  const Propagated* propagated; // these two from the first ghost on
  std::uint32_t* source;
  Candidate* candidate; // these two by candidate
  Grid_point* owner;
  std::uint32_t first; // candidate

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    source[i] = first + std::uint32_t(i);
    candidate[source[i]] = propagated[i].candidate;
    owner[source[i]] = propagated[i].owner;
  }
};

// What has propagated to ghosts before each pass. It propagates from them, so it stays until the end: there are
// candidates for each ghost and pass, after those of the surfels.
template <class Backend>
class Ghost_candidates {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

public:
  Ghost_candidates(Backend& backend, const Ranks<Backend>& ranks, const Cloud_view& cloud)
    : backend_(backend), ranks_(ranks), ghosts_(ranks.ghosts(Rings::inner)), next_(cloud.size + cloud.ghosts)
  {
    if constexpr(Ranks<Backend>::are_many) {
      owner_.reset(size());
      backend.for_each(next_, Copy_items<Grid_point>{cloud.point, owner_.data()});
    }
  }

  // Of candidates.
  std::size_t size() const { return next_ + (propagation_passes + 1) * ghosts_; }

  // By candidate: the surfel that it comes from.
  const Grid_point* owner(const Cloud_view& cloud) const
  {
    return Ranks<Backend>::are_many ? owner_.data() : cloud.point;
  }

  // Before a pass. source: by surfel.
  void renew(const Workspace& w, std::uint32_t* source)
  {
    if constexpr(Ranks<Backend>::are_many) {
      Buffer<Propagated> propagated(w.cloud.size + w.cloud.ghosts);
      backend_.for_each(w.cloud.size, Get_propagated{w, source, propagated.data()});
      ranks_.refresh(propagated.data(), Rings::inner);
      backend_.for_each(ghosts_, Put_propagated{propagated.data() + w.cloud.size, source + w.cloud.size, w.candidate,
                                                owner_.data(), std::uint32_t(next_)});
      next_ += ghosts_;
    }
  }

private:
  Backend& backend_;
  const Ranks<Backend>& ranks_;
  std::size_t ghosts_, next_;
  Buffer<Grid_point> owner_;
};

} // namespace normals

// Fills point[i].normal, unoriented; no_normal where all neighbors are equal or collinear. `cloud` needs points and
// neighbors; `point` may be its own array, since coordinates are only read and normals only written. epsilon_steps is
// epsilon: parts of it define what is free of noise, and what is no clutter. Temporary memory: 104
// bytes a surfel.
template <class Backend>
void estimate_normals(Backend& backend, const Cloud_view& cloud, Grid_point* point, double epsilon_steps,
                      const Ranks<Backend>& ranks)
{
  using namespace normals;
  const std::size_t n = cloud.size, with_ghosts = n + cloud.ghosts;
  Ghost_candidates<Backend> ghosts(backend, ranks, cloud);
  Buffer_of<Backend, Candidate> candidate(ghosts.size());
  Workspace w = make_workspace(cloud, candidate.data(), epsilon_steps);
  w.owner = ghosts.owner(cloud);
  {
    Buffer_of<Backend, Neighborhood> current(with_ghosts), next(n);
    w.current = current.data();
    w.next = next.data();
    backend.for_each(n, Start{w});
    ranks.refresh(w.current, Rings::inner);
    for(int scale = 2; scale <= last_scale; ++scale) {
      backend.for_each(n, Grow{w});
      backend.for_each(n, Commit{w, scale});
      ranks.refresh(w.current, Rings::inner);
    }
  }
  Buffer_of<Backend, std::uint32_t> source(with_ghosts), next_source(with_ghosts);
  backend.for_each(n, Fill_ascending{source.data()}); // each surfel starts with its own candidate
  ghosts.renew(w, source.data());
  for(int pass = 0; pass < propagation_passes; ++pass) {
    backend.for_each(n, Take_neighbor_plane{w, source.data(), next_source.data()});
    std::swap(source, next_source);
    ghosts.renew(w, source.data());
  }
  backend.for_each(n, Finish{w, source.data(), point});
  ranks.refresh(point, Rings::all);
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_ESTIMATE_NORMALS_H
