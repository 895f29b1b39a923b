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

// By shape: whether it keeps its own direction although another one is within the angle.
inline std::vector<char> find_rejected(const Shape_fits& shapes, const std::vector<Direction_group>& groups,
                                       const Regularity_options& options)
{
  std::vector<char> is_rejected(shapes.size(), 0);
  const double sine = sine_deg(options.angle_tolerance_deg);
  if(!options.parallelism || !(sine > tuning::directions::minimum_sine))
    return is_rejected;
  std::vector<Vector> directions;
  for(const Direction_group& g : groups)
    directions.push_back(g.direction);
  const Direction_index index(directions, sine);
  for(std::size_t g = 0; g < groups.size(); ++g)
    if(groups[g].members.size() == 1 && groups[g].direction == groups[g].fitted)
      index.near(groups[g].direction, [&](std::size_t other, double) {
        if(other != g)
          is_rejected[std::size_t(groups[g].members.front())] = 1;
      });
  return is_rejected;
}

// is_excluded: by shape; those keep their local fits and get no relations. The same holds for shapes without points or
// without a normal.
inline Relations regularize(const Shape_fits& shapes, const std::vector<char>& is_excluded,
                            const Regularity_options& options)
{
  // Normals are unit or null; 0.5 separates them whatever the rounding.
  std::vector<int> active;
  for(std::size_t i = 0; i < shapes.size(); ++i)
    if(!is_excluded[i] && shapes[i].scatter.count > 0 && dot(shapes[i].fit.normal, shapes[i].fit.normal) > 0.5)
      active.push_back(int(i));
  std::vector<Direction_group> groups = Parallel_groups(shapes, options)(active);
  set_directions(groups, options);
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
  r.is_rolled_back = find_rejected(shapes, groups, options);
  return r;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_REGULARIZE_H
