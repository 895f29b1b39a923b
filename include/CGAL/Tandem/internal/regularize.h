// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The regularity step: shapes become parallel, orthogonal and coplanar where
// their moments and their points allow it. Point-sized work is left to a callback
//   verify(shapes, planes, counts): counts[k] = number of points of shapes[k]
//   that fit its local plane, but not planes[k]
// which is called a few times with all shapes that are in question.

#ifndef CGAL_TANDEM_INTERNAL_REGULARIZE_H
#define CGAL_TANDEM_INTERNAL_REGULARIZE_H

#include <CGAL/Tandem/internal/angles.h>
#include <CGAL/Tandem/internal/coplanar_classes.h>
#include <CGAL/Tandem/internal/frames.h>
#include <CGAL/Tandem/internal/relations.h>

#include <tuple>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace regularity {

constexpr double misfit_share = 0.2; // of its points, newly misfitting: the shape is refused
constexpr double rms_share = 0.5;    // of epsilon, added in quadrature to the distance of the points: refused
constexpr double still_share = 0.02; // of epsilon: a plane that moved less needs no verification

// What was refused is clustered again with half the tolerance. A shape large enough
// to be refused has a precise normal: only true right angles are left to it, and at last none.
constexpr int levels = 5;
constexpr double parallel_share[levels] = {1, 0.5, 0.25, 0.125, 0.125};
constexpr double right_share[levels] = {1, 0.25, 0.0625, 0.0625, 0};

} // namespace regularity

inline Regular_plane through_centroid(const Shape_fit& s, const Vector& n) { return {n, dot(n, s.scatter.centroid)}; }

// The shapes with the plane that their points accepted last: the local fit at first.
template <class Verify>
class Verified_planes {
public:
  Verified_planes(const std::vector<Shape_fit>& shapes, double maximum_distance, Verify& verify)
    : shapes(shapes), maximum_distance(maximum_distance), verify(verify)
  {
    for(const Shape_fit& s : shapes)
      accepted.push_back(through_centroid(s, canonical(s.fit.normal)));
  }

  // Whether the direction adds too much to the distance of the points (from the moments alone).
  bool is_too_far(int shape, const Vector& n) const
  {
    const double allowed = regularity::rms_share * maximum_distance;
    return added(shape, n) > allowed * allowed * shapes[shape].scatter.count;
  }

  double added(int shape, const Vector& n) const
  {
    const Shape_fit& s = shapes[shape];
    return quadratic_form(s.scatter.matrix, n) - quadratic_form(s.scatter.matrix, s.fit.normal);
  }

  // Asks the points, in one call. Returns for each candidate whether it was refused.
  std::vector<char> test(const std::vector<int>& candidates, const std::vector<Regular_plane>& planes)
  {
    std::vector<int> asked;
    std::vector<Regular_plane> asked_planes;
    std::vector<std::size_t> position;
    for(std::size_t k = 0; k < candidates.size(); ++k)
      if(motion(candidates[k], planes[k]) > regularity::still_share * maximum_distance) {
        asked.push_back(candidates[k]);
        asked_planes.push_back(planes[k]);
        position.push_back(k);
      }
    std::vector<std::int64_t> counts(asked.size(), 0);
    if(!asked.empty())
      verify(asked, asked_planes, counts);
    std::vector<char> is_refused(candidates.size(), 0);
    for(std::size_t a = 0; a < asked.size(); ++a) {
      if(double(counts[a]) > regularity::misfit_share * shapes[asked[a]].scatter.count)
        is_refused[position[a]] = 1;
      else
        accepted[asked[a]] = asked_planes[a];
    }
    return is_refused;
  }

private:
  // Bound on the motion of the plane against the accepted one within two standard deviations of the shape.
  double motion(int shape, const Regular_plane& plane) const
  {
    const Scatter& s = shapes[shape].scatter;
    const Regular_plane& old = accepted[shape];
    const double side = dot(plane.normal, old.normal) < 0 ? -1 : 1;
    const double shift = (dot(plane.normal, s.centroid) - plane.offset) - side * (dot(old.normal, s.centroid) - old.offset);
    const double sine = std::sqrt(Direction_index::squared_distance(plane.normal, old.normal));
    return std::fma(sine, 2 * std::sqrt(shapes[shape].fit.largest / s.count), std::fabs(shift));
  }

  const std::vector<Shape_fit>& shapes;
  double maximum_distance;
  Verify& verify;
  std::vector<Regular_plane> accepted;
};

// Directions: clusters of the Gauss map, tied by frames, verified; what is refused
// starts again with half the angle.
template <class Verify>
class Direction_fitter {
public:
  Direction_fitter(const std::vector<Shape_fit>& shapes, const Regularity_options& options,
                   Verified_planes<Verify>& verified)
    : shapes(shapes), options(options), verified(verified)
  {}

  // Groups the given shapes; those refused at every level are in no group.
  void fit(std::vector<int> pending)
  {
    was_refused.assign(shapes.size(), 0);
    for(int level = 0; level < regularity::levels && !pending.empty(); ++level) {
      const double parallel_sine = sine_deg(options.angle_tolerance_deg * regularity::parallel_share[level]);
      const double right_sine = sine_deg(options.angle_tolerance_deg * regularity::right_share[level]);
      freeze(right_sine);
      if(options.parallelism && level > 0)
        rejoin(pending, parallel_sine);
      add_groups(pending, parallel_sine, right_sine);
      pending = settle();
      for(int i : ask_points()) {
        pending.push_back(i);
        was_refused[i] = 1;
      }
      std::sort(pending.begin(), pending.end());
    }
  }

  const std::vector<Direction_group>& result() const { return groups; }

  // Shapes that share no direction and keep their local fit, since the points refused something else.
  std::vector<char> rolled_back() const
  {
    std::vector<char> result = was_refused;
    for(const Direction_group& g : groups)
      for(int i : g.members)
        if(g.members.size() > 1 || !(g.direction == canonical(shapes[i].fit.normal)))
          result[i] = 0;
    return result;
  }

private:
  // Groups that lost members are fitted again and tied within the smaller angle. At the last level what was
  // accepted stays as it is.
  void freeze(double right_sine)
  {
    for(std::size_t g = 0; g < groups.size(); ++g) {
      groups[g].is_frozen = right_sine == 0 && !is_dirty[g];
      if(is_dirty[g])
        groups[g].sine = right_sine;
    }
    refit();
  }

  // A refused shape joins a group that, without the other refused shapes, has come much closer to it.
  void rejoin(std::vector<int>& pending, double sine)
  {
    std::vector<Vector> fitted;
    for(const Direction_group& g : groups)
      fitted.push_back(g.fitted);
    const Direction_index index(fitted, sine);
    std::vector<int> rest;
    for(int i : pending) {
      std::pair<double, std::size_t> best(0.25 * refused_cost[i], groups.size());
      index.near(shapes[i].fit.normal, [&](std::size_t g, double) {
        if(!groups[g].is_frozen)
          best = (std::min)(best, {verified.added(i, fitted[g]), g});
      });
      if(best.second == groups.size() || verified.is_too_far(i, fitted[best.second])) {
        rest.push_back(i);
      } else {
        std::vector<int>& m = groups[best.second].members;
        m.insert(std::lower_bound(m.begin(), m.end(), i), i);
        is_dirty[best.second] = 1;
      }
    }
    pending.swap(rest);
  }

  void add_groups(const std::vector<int>& pending, double parallel_sine, double right_sine)
  {
    std::vector<std::vector<int>> clusters;
    if(options.parallelism && parallel_sine > 1e-9) {
      std::vector<Vector> normal;
      std::vector<double> weight;
      for(int i : pending) {
        normal.push_back(shapes[i].fit.normal);
        weight.push_back(shapes[i].scatter.count);
      }
      clusters = cluster_directions(normal, weight, parallel_sine);
    } else {
      for(std::size_t k = 0; k < pending.size(); ++k)
        clusters.push_back({int(k)});
    }
    for(std::vector<int>& cluster : clusters) {
      for(int& k : cluster)
        k = pending[k];
      groups.push_back({cluster, right_sine, {}, 0, {}, {}, {}, 0, {}, false});
      is_dirty.push_back(1);
    }
  }

  // Fits and ties the groups. Members that their moments refuse are taken out: before the ties, so that the
  // rest is fitted without them, and after.
  std::vector<int> settle()
  {
    std::vector<int> refused;
    for(int step = 0; step < 3; ++step) {
      refit();
      const std::size_t before = refused.size();
      remove_members([&](int i, std::size_t g) { return verified.is_too_far(i, groups[g].fitted); }, refused);
      if(refused.size() == before)
        break;
    }
    refit();
    tie();
    remove_members([&](int i, std::size_t g) { return verified.is_too_far(i, groups[g].direction); }, refused);
    return refused;
  }

  void refit()
  {
    for(std::size_t g = 0; g < groups.size(); ++g)
      if(is_dirty[g])
        refit(groups[g]);
    std::fill(is_dirty.begin(), is_dirty.end(), char(0));
  }

  void refit(Direction_group& g) const
  {
    g.matrix = {0, 0, 0, 0, 0, 0};
    g.weight = 0;
    for(int i : g.members) {
      g.matrix = g.matrix + shapes[i].scatter.matrix;
      g.weight += shapes[i].scatter.count;
    }
    g.fit();
    if(g.members.size() == 1) // keeps the bits of its own fit
      g.set_fit(canonical(shapes[g.members.front()].fit.normal));
  }

  void tie()
  {
    if(options.orthogonality) {
      const double rms = regularity::rms_share * options.maximum_distance;
      Frames(groups, rms * rms).tie();
    } else {
      for(Direction_group& g : groups)
        if(!g.is_frozen)
          g.direction = g.fitted;
    }
  }

  std::vector<int> ask_points()
  {
    std::vector<int> candidates;
    std::vector<Regular_plane> planes;
    for(const Direction_group& g : groups)
      for(int i : g.members) {
        candidates.push_back(i);
        planes.push_back(through_centroid(shapes[i], g.direction));
      }
    const std::vector<char> is_refused = verified.test(candidates, planes);
    std::vector<int> refused;
    std::size_t k = 0; // members are visited in the same order
    remove_members([&](int, std::size_t) { return is_refused[k++] != 0; }, refused);
    return refused;
  }

  template <class Predicate>
  void remove_members(Predicate is_refused, std::vector<int>& refused)
  {
    refused_cost.resize(shapes.size(), 0);
    for(std::size_t g = 0; g < groups.size(); ++g) {
      std::vector<int> kept;
      for(int i : groups[g].members) {
        const bool is_out = is_refused(i, g);
        (is_out ? refused : kept).push_back(i);
        if(is_out)
          refused_cost[i] = verified.added(i, groups[g].fitted);
      }
      if(kept.size() < groups[g].members.size()) {
        groups[g].members.swap(kept);
        is_dirty[g] = 1;
      }
    }
    drop_empty();
  }

  void drop_empty()
  {
    std::size_t kept = 0;
    for(std::size_t g = 0; g < groups.size(); ++g)
      if(!groups[g].members.empty()) {
        if(kept != g)
          groups[kept] = std::move(groups[g]);
        is_dirty[kept++] = is_dirty[g];
      }
    groups.resize(kept);
    is_dirty.resize(kept);
  }

  const std::vector<Shape_fit>& shapes;
  const Regularity_options& options;
  Verified_planes<Verify>& verified;
  std::vector<Direction_group> groups;
  std::vector<char> is_dirty;       // per group: its members changed
  std::vector<char> was_refused;    // per shape: by the points
  std::vector<double> refused_cost; // per shape: what the fit of the refused group added
};

// Numbers the groups that share a direction alike: -1 for shapes without a group.
inline std::vector<int> shared_directions(const std::vector<Direction_group>& groups, std::size_t n)
{
  auto key = [](const Vector& v) { return std::make_tuple(v.x, v.y, v.z); };
  std::vector<std::size_t> order(groups.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return key(groups[a].direction) < key(groups[b].direction); });
  std::vector<int> direction_of(n, -1);
  int last = -1;
  for(std::size_t k = 0; k < order.size(); ++k) {
    if(k == 0 || key(groups[order[k]].direction) != key(groups[order[k - 1]].direction))
      ++last;
    for(int i : groups[order[k]].members)
      direction_of[i] = last;
  }
  return direction_of;
}

// Fills the tables in the order of the shapes. plane[i] is the plane of shape i,
// direction[i] and coplanar[i] name what it shares (-1: nothing).
inline void number_relations(const std::vector<Regular_plane>& plane, const std::vector<int>& direction,
                             const std::vector<int>& coplanar, Relations& r)
{
  const std::size_t n = plane.size();
  std::vector<int> direction_number(n, -1), plane_number(n, -1);
  for(std::size_t i = 0; i < n; ++i) {
    int d = direction[i] < 0 ? -1 : direction_number[direction[i]];
    if(d < 0) {
      d = int(r.directions.size());
      r.directions.push_back(plane[i].normal);
      if(direction[i] >= 0)
        direction_number[direction[i]] = d;
    }
    int p = coplanar[i] < 0 ? -1 : plane_number[coplanar[i]];
    if(p < 0) {
      p = int(r.planes.size());
      r.planes.push_back(plane[i]);
      if(coplanar[i] >= 0)
        plane_number[coplanar[i]] = p;
    }
    r.direction_of.push_back(d);
    r.plane_of.push_back(p);
  }
}

// is_excluded: shapes that keep their local fit and take part in nothing.
template <class Verify>
Relations regularize(const std::vector<Shape_fit>& shapes, const std::vector<char>& is_excluded,
                     const Regularity_options& options, Verify& verify)
{
  std::vector<int> active;
  for(std::size_t i = 0; i < shapes.size(); ++i)
    if(!is_excluded[i] && shapes[i].scatter.count > 0 && dot(shapes[i].fit.normal, shapes[i].fit.normal) > 0.5)
      active.push_back(int(i));
  Verified_planes<Verify> verified(shapes, options.maximum_distance, verify);
  Direction_fitter<Verify> fitter(shapes, options, verified);
  fitter.fit(active);
  std::vector<Regular_plane> plane;
  for(const Shape_fit& s : shapes)
    plane.push_back(through_centroid(s, canonical(s.fit.normal)));
  for(const Direction_group& g : fitter.result())
    for(int i : g.members)
      plane[i] = through_centroid(shapes[i], g.direction);
  const std::vector<int> direction = shared_directions(fitter.result(), shapes.size());
  std::vector<int> coplanar(shapes.size(), -1);
  if(options.coplanarity && options.maximum_offset > 0)
    Coplanar_classes(shapes, direction, options.maximum_offset).fit(verified, plane, coplanar);
  Relations r;
  number_relations(plane, direction, coplanar, r);
  r.is_rolled_back = fitter.rolled_back();
  return r;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARIZE_H
