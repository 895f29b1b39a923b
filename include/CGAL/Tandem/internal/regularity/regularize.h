// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The regularity step: shapes become parallel, orthogonal and coplanar where that is worth more than what their points
// lose (section 4 of the paper). Directions are fixed first (Parallel_groups.h, Frames.h), then offsets
// (Coplanar_groups.h). Input are moments, so no point is read; the result is Relations. Neither labels nor shapes change
// here; rounds/regularize_shapes.h applies the result.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_REGULARIZE_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_REGULARIZE_H

#include <CGAL/Tandem/internal/regularity/Axis_symmetry.h>
#include <CGAL/Tandem/internal/regularity/Coplanar_groups.h>
#include <CGAL/Tandem/internal/regularity/Frames.h>
#include <CGAL/Tandem/internal/regularity/Parallel_groups.h>

#include <tuple>

namespace CGAL {
namespace Tandem {
namespace internal {

// By shape, the number of its direction; -1 for shapes without a group. Groups whose directions have the same bits get
// the same number, since frames can make them equal.
inline std::vector<int> shared_directions(const std::vector<Direction_group>& groups, std::size_t n)
{
  auto key = [](const Vector& v) { return std::make_tuple(v.x, v.y, v.z); };
  std::vector<std::size_t> order;
  for(std::size_t g = 0; g < groups.size(); ++g)
    if(!groups[g].members.empty()) // as those of given directions may be: numbers are below n
      order.push_back(g);
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

// Fills r with directions and planes in the order of the first shape of each. plane[i] is the plane of shape i.
// direction[i] and coplanar[i] are the numbers of what it shares, or -1: then it gets entries of its own.
inline void number_relations(const Regular_planes& plane, const std::vector<int>& direction,
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

// Sets the directions of the groups, with right angles and symmetry where they are enabled.
inline void set_directions(std::vector<Direction_group>& groups, const Regularity_options& options)
{
  if(options.orthogonality)
    Frames(groups, options).tie();
  else
    for(Direction_group& g : groups)
      g.direction = g.fitted;
  for(const Vector& axis : options.symmetry_axis)
    Axis_symmetry(groups, axis, options).tie();
}

// Shapes that their group turns by more than the tolerance, or at more than a direction is worth, get groups of their
// own, of their own fits. Unions of unions may turn a shape so far, and right angles of their direction.
inline void release_shapes(const Shape_fits& shapes, const Regularity_options& options,
                           std::vector<Direction_group>& groups)
{
  const double sine = sine_deg(options.angle_tolerance_deg);
  std::vector<Direction_group> released;
  for(Direction_group& g : groups) {
    const auto is_kept = [&](int i) {
      const Scatter& s = shapes[std::size_t(i)].scatter;
      const Vector own = canonical(shapes[std::size_t(i)].fit.normal);
      const double cost = quadratic_form(s.matrix, g.direction) - quadratic_form(s.matrix, own);
      return g.direction == own ||
             (squared_sine(g.direction, own) <= sine * sine && cost <= options.direction_price(s.count));
    };
    const auto end = std::stable_partition(g.members.begin(), g.members.end(), is_kept);
    for(auto i = end; i != g.members.end(); ++i) {
      released.push_back(direction_group({*i}, sine));
      released.back().fit(shapes);
      released.back().direction = released.back().fitted;
    }
    g.members.erase(end, g.members.end());
  }
  drop_empty(groups);
  groups.insert(groups.end(), released.begin(), released.end());
}

// A search that ends when something is found.
template <class Region>
struct Until {
  Region region;
  const char& is_found;

  bool meets(const Direction_cell& cell, double largest) const { return !is_found && region.meets(cell, largest); }
  int nearest_quarter(const Direction_cell& cell) const { return region.nearest_quarter(cell); }
};

// By shape: whether it keeps its own direction although another one is within the angle.
inline std::vector<char> find_rejected(const Shape_fits& shapes, const std::vector<Direction_group>& groups,
                                       const Regularity_options& options)
{
  std::vector<char> is_rejected(shapes.size(), 0);
  const double sine = sine_deg(options.angle_tolerance_deg);
  if(!options.parallelism || !(sine > tuning::directions::minimum_sine))
    return is_rejected;
  Great_circle_index index;
  for(const Direction_group& g : groups)
    index.add(g.direction, 0);
  for(const Direction_group& g : groups) {
    if(g.members.size() != 1 || !(g.direction == g.fitted))
      continue;
    char& is_found = is_rejected[std::size_t(g.members.front())];
    index.search(Until<Near_direction_region>{{g.direction, sine}, is_found}, [&](int other) {
      const Vector& d = groups[std::size_t(other)].direction;
      is_found = is_found || (!(d == g.direction) && squared_sine(d, g.direction) <= sine * sine);
    });
  }
  return is_rejected;
}

// is_excluded: by shape; those keep their local fits and get no relations. The same holds for shapes without points or
// without a normal. finds_rejected: whether Relations::is_rolled_back is asked for.
inline Relations regularize(const Shape_fits& shapes, const std::vector<char>& is_excluded,
                            const Regularity_options& options, bool finds_rejected = true)
{
  // Normals are unit or null; 0.5 separates them whatever the rounding.
  std::vector<int> active;
  for(std::size_t i = 0; i < shapes.size(); ++i)
    if(!is_excluded[i] && shapes[i].scatter.count > 0 && dot(shapes[i].fit.normal, shapes[i].fit.normal) > 0.5)
      active.push_back(int(i));
  std::vector<Direction_group> groups = Parallel_groups(shapes, options)(active);
  set_directions(groups, options);
  release_shapes(shapes, options, groups);
  std::vector<Vector> normal(shapes.size());
  for(std::size_t i = 0; i < shapes.size(); ++i)
    normal[i] = canonical(shapes[i].fit.normal);
  for(const Direction_group& g : groups)
    for(int i : g.members)
      normal[i] = g.direction;
  Regular_planes plane(shapes.size());
  for(std::size_t i = 0; i < shapes.size(); ++i)
    plane[i] = through_centroid(shapes[i], normal[i]);
  const std::vector<int> direction = shared_directions(groups, shapes.size());
  std::vector<int> coplanar(shapes.size(), -1);
  if(options.coplanarity && options.maximum_offset > 0)
    Coplanar_groups(shapes, direction, options).fit(plane, coplanar);
  Relations r;
  number_relations(plane, direction, coplanar, r);
  if(finds_rejected)
    r.is_rolled_back = find_rejected(shapes, groups, options);
  return r;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_REGULARIZE_H
