// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The regularity step: shapes become parallel, orthogonal and coplanar where verification accepts it (section 4 of the
// paper). Directions are fixed first (Direction_fitter.h), then offsets (Coplanar_classes.h); Verified_planes.h decides
// what is rejected. Input are moments and counts of misfits, the result is Relations. Neither labels nor shapes change
// here; rounds/regularize_shapes.h applies the result.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_REGULARIZE_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_REGULARIZE_H

#include <CGAL/Tandem/internal/regularity/Direction_fitter.h>
#include <CGAL/Tandem/internal/regularity/Coplanar_classes.h>

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

// is_excluded: by shape; those keep their local fits and get no relations. The same holds for shapes without points or
// without a normal. Verify: the callback of Verified_planes.
template <class Verify>
Relations regularize(const Shape_fits& shapes, const std::vector<char>& is_excluded, const Regularity_options& options,
                     Verify& verify)
{
  // Normals are unit or null; 0.5 separates them whatever the rounding.
  std::vector<int> active;
  for(std::size_t i = 0; i < shapes.size(); ++i)
    if(!is_excluded[i] && shapes[i].scatter.count > 0 && dot(shapes[i].fit.normal, shapes[i].fit.normal) > 0.5)
      active.push_back(int(i));
  Verified_planes<Verify> verified(shapes, options, verify);
  Direction_fitter<Verify> fitter(shapes, options, verified);
  fitter.fit(active);
  std::vector<Vector> normal(shapes.size());
  for(std::size_t i = 0; i < shapes.size(); ++i)
    normal[i] = canonical(shapes[i].fit.normal);
  for(const Direction_group& g : fitter.result())
    for(int i : g.members)
      normal[i] = g.direction;
  Regular_planes plane(shapes.size());
  for(std::size_t i = 0; i < shapes.size(); ++i)
    plane[i] = through_centroid(shapes[i], normal[i]);
  const std::vector<int> direction = shared_directions(fitter.result(), shapes.size());
  std::vector<int> coplanar(shapes.size(), -1);
  if(options.coplanarity && options.maximum_offset > 0)
    Coplanar_classes(shapes, direction, options).fit(verified, plane, coplanar);
  Relations r;
  number_relations(plane, direction, coplanar, r);
  r.is_rolled_back = fitter.rolled_back();
  return r;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_REGULARIZE_H
