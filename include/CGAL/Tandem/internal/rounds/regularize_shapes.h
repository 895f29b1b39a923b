// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The regularity step of a round: the shapes that are large enough get the planes
// of their relations, the others keep their local fits.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_REGULARIZE_SHAPES_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_REGULARIZE_SHAPES_H

#include <CGAL/Tandem/internal/rounds/merge_fragments.h>
#include <CGAL/Tandem/internal/regularity/regularize.h>

#include <algorithm>
#include <cstdlib>

namespace CGAL {
namespace Tandem {
namespace internal {

// The relations of some shapes: those of id[i] are the entries i.
struct Shape_relations {
  Ids id;
  Relations relations;
  std::int64_t points = 0; // of the shapes when the relations were found
};

// A shape that was rolled back tries again when it has grown, or after 2, 4, 8 ... rounds.
inline void schedule_retry(Shape& shape, int round)
{
  shape.rollbacks = (std::min)(shape.rollbacks + 1, 5);
  shape.retry_round = round + (1 << shape.rollbacks);
  shape.retry_count = shape.moments.count + shape.moments.count / 4;
}

// What the points say to the regularity step: see Verified_planes.h.
template <class Backend>
class Point_verifier {
public:
  // ids: of the shapes of the step.
  Point_verifier(Tandem_state<Backend>& t, const Ids& ids) : t_(t), ids_(ids), count_(t, ids) {}

  void operator()(const std::vector<int>& shapes, const Regular_planes& candidates, std::vector<std::int64_t>& counts)
  {
    Ids ids(shapes.size());
    for(std::size_t i = 0; i < ids.size(); ++i)
      ids[i] = ids_[std::size_t(shapes[i])];
    const Unset_vector<double> shares = count_(ids, candidates);
    t_.backend.for_each_on_host(ids.size(), [&](std::size_t i) {
      counts[i] = std::int64_t(shares[i] * double(t_.shapes[ids[i]].moments.count));
    });
  }

  template <class F>
  void for_each(std::size_t n, F f, std::size_t few) const
  {
    t_.backend.for_each_on_host(n, f, few);
  }

private:
  Tandem_state<Backend>& t_;
  const Ids& ids_;
  Misfit_counter<Backend> count_;
};

// Relations are found anew when shapes have gained, lost or exchanged this share of their points, in the loop
// and in the end game. Until then they hold on: in the late rounds little changes. (With a period of more than one
// round they never do.)
constexpr double changed_share = 0.05, changed_share_at_end = 0.03;

// A shape without relations, or in the loop one that has changed much by itself, is not held by those found before. (In
// the end game all of its points fit its plane.)
inline bool is_held(const Shape& shape, bool is_end)
{
  const std::int64_t before = shape.regular_count; // 0 if it has none
  return is_end ? before > 0 : 4 * std::abs(shape.moments.count - before) <= before;
}

template <class Backend>
bool have_changed(const Tandem_state<Backend>& t, const Ids& ids, const Shape_relations& before, bool is_end)
{
  const auto change = [&](std::size_t i) { // less the points that are still there
    const Shape& shape = t.shapes[ids[i]];
    return std::abs(shape.moments.count - shape.regular_count) - shape.regular_count;
  };
  const std::int64_t changed = before.points + sum_on_host(t.backend, ids.size(), change);
  return double(changed) > (is_end ? changed_share_at_end : changed_share) * double(t.assigned);
}

// The entry has a plane, and a direction, that no other one has.
inline void set_own_plane(Relations& r, std::size_t entry, const Regular_plane& plane)
{
  r.direction_of[entry] = int(r.directions.size());
  r.plane_of[entry] = int(r.planes.size());
  r.directions.push_back(plane.normal);
  r.planes.push_back(plane);
}

// Shapes that are held keep the planes of their relations, the others stay at their local planes.
template <class Backend>
Shape_relations keep_relations(Tandem_state<Backend>& t, const Ids& ids, const Shape_relations& before, bool is_end)
{
  const std::size_t n = ids.size();
  Shape_relations r = {ids, before.relations, before.points};
  r.relations.direction_of.assign(n, -1);
  r.relations.plane_of.assign(n, -1);
  r.relations.is_rolled_back.assign(n, 0);
  for(std::size_t i = 0; i < n; ++i) {
    Shape& shape = t.shapes[ids[i]];
    if(is_held(shape, is_end)) {
      r.relations.direction_of[i] = before.relations.direction_of[std::size_t(shape.entry)];
      r.relations.plane_of[i] = before.relations.plane_of[std::size_t(shape.entry)];
    } else {
      set_own_plane(r.relations, i, plane_through(canonical(shape.fit.normal), shape.scatter.centroid));
    }
    shape.entry = int(i);
    shape.plane = r.relations.planes[std::size_t(r.relations.plane_of[i])];
  }
  return r;
}

// retry_all: in the end game, also small shapes and those that wait. `before`: the relations of the last step.
template <class Backend>
Shape_relations regularize_shapes(Tandem_state<Backend>& t, bool retry_all, const Shape_relations& before)
{
  const bool is_due = retry_all || (t.round + 1) % t.options.regularity_period == 0;
  const std::int64_t minimum = retry_all ? t.options.minimum_regular_size : t.options.minimum_related_size;
  Shape_relations r;
  r.id = chosen_shapes(t, [&](const Shape&, std::uint32_t id) {
    Shape& shape = t.shapes[id];
    shape.plane = shape.local;
    if(shape.moments.count < minimum)
      shape.regular_count = 0;
    return shape.moments.count >= minimum;
  });
  const bool is_first = retry_all && before.id.empty(); // those of the loop are of other shapes
  if(is_due && !is_first && !have_changed(t, r.id, before, retry_all))
    return keep_relations(t, r.id, before, retry_all);
  Shape_fits fits(r.id.size());
  std::vector<char> is_excluded(r.id.size());
  t.backend.for_each_on_host(r.id.size(), [&](std::size_t i) {
    const Shape& shape = t.shapes[r.id[i]];
    fits[i] = {shape.scatter, shape.fit};
    const bool is_waiting = t.round < shape.retry_round && shape.moments.count < shape.retry_count;
    is_excluded[i] = !is_due || (!retry_all && is_waiting);
  });
  Point_verifier<Backend> verify(t, r.id);
  Regularity_options options = t.options.regularity;
  options.is_last = retry_all;
  r.relations = regularize(fits, is_excluded, options, verify);
  r.points = sum_on_host(t.backend, r.id.size(), [&](std::size_t i) {
    Shape& shape = t.shapes[r.id[i]];
    shape.plane = r.relations.planes[std::size_t(r.relations.plane_of[i])];
    shape.entry = int(i);
    shape.regular_count = is_due ? shape.moments.count : 0;
    if(r.relations.is_rolled_back[i])
      schedule_retry(shape, t.round);
    return shape.regular_count;
  });
  return r;
}

// Touching shapes of one plane become one shape.
template <class Backend>
std::vector<std::uint32_t> coplanar_targets(Tandem_state<Backend>& t, const Shape_relations& r, const Link_list& links)
{
  std::vector<int> plane_of(t.shapes.size(), -1);
  for(std::size_t i = 0; i < r.id.size(); ++i)
    plane_of[r.id[i]] = r.relations.plane_of[i];
  const auto itself = [](std::size_t i) { return std::uint32_t(i); };
  const Ids coplanar = part_on_host(t.backend, links.size(), itself, [&](std::uint32_t i) {
                         const int plane = plane_of[links[i].first()];
                         return plane >= 0 && plane == plane_of[links[i].second()]; // what is united has one plane
                       }).chosen;
  Unions unions(t.shapes.size());
  std::vector<std::uint32_t> united;
  for(std::uint32_t i : coplanar) {
    std::uint32_t a = unions.root(links[i].first()), b = unions.root(links[i].second());
    if(a == b)
      continue;
    const std::int64_t na = t.shapes[a].moments.count, nb = t.shapes[b].moments.count;
    if(na < nb || (na == nb && b < a))
      std::swap(a, b);
    unions.set_parent(b, a);
    united.push_back(b);
  }
  std::vector<std::uint32_t> target = identity_targets(t);
  for(std::uint32_t id : united)
    target[id] = unions.root(id);
  return target;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_REGULARIZE_SHAPES_H
