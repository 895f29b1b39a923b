// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The regularity step of a round: the shapes that are large enough get the planes
// of their relations, the others keep their local fits.

#ifndef CGAL_TANDEM_INTERNAL_REGULARIZE_SHAPES_H
#define CGAL_TANDEM_INTERNAL_REGULARIZE_SHAPES_H

#include <CGAL/Tandem/internal/merge_fragments.h>
#include <CGAL/Tandem/internal/regularize.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// The relations of some shapes: those of id[i] are the entries i.
struct Shape_relations {
  std::vector<std::uint32_t> id;
  Relations relations;
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
  Point_verifier(Tandem_state<Backend>& t, const std::vector<std::uint32_t>& ids) : t_(t), ids_(ids), count_(t, ids) {}

  void operator()(const std::vector<int>& shapes, const std::vector<Regular_plane>& candidates,
                  std::vector<std::int64_t>& counts)
  {
    std::vector<std::uint32_t> ids(shapes.size());
    for(std::size_t i = 0; i < ids.size(); ++i)
      ids[i] = ids_[std::size_t(shapes[i])];
    const std::vector<double> shares = count_(ids, candidates);
    for(std::size_t i = 0; i < ids.size(); ++i)
      counts[i] = std::int64_t(shares[i] * double(t_.shapes[ids[i]].moments.count));
  }

  template <class F>
  void for_each(std::size_t n, F f) const
  {
    t_.backend.for_each_on_host(n, f);
  }

private:
  Tandem_state<Backend>& t_;
  const std::vector<std::uint32_t>& ids_;
  Misfit_counter<Backend> count_;
};

template <class Backend>
Shape_relations regularize_shapes(Tandem_state<Backend>& t, bool retry_all)
{
  const bool is_due = retry_all || (t.round + 1) % t.options.regularity_period == 0;
  // While fragments are young, most of them tilt by more than what they would be related to.
  const std::int64_t least = retry_all ? t.options.minimum_regular_size
                                       : (std::max)(t.options.minimum_regular_size, t.options.minimum_fragment_size);
  Shape_relations r;
  r.id = chosen_shapes(t, [&](const Shape& shape, std::uint32_t id) {
    t.shapes[id].plane = shape.local;
    return shape.moments.count >= least;
  });
  std::vector<Shape_fit> fits(r.id.size());
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
  for(std::size_t i = 0; i < r.id.size(); ++i) {
    Shape& shape = t.shapes[r.id[i]];
    shape.plane = r.relations.planes[std::size_t(r.relations.plane_of[i])];
    if(r.relations.is_rolled_back[i])
      schedule_retry(shape, t.round);
  }
  return r;
}

// Touching shapes of one plane become one shape.
template <class Backend>
std::vector<std::uint32_t> coplanar_targets(Tandem_state<Backend>& t, const Shape_relations& r,
                                            const std::vector<Link>& links)
{
  std::vector<int> plane_of(t.shapes.size(), -1);
  for(std::size_t i = 0; i < r.id.size(); ++i)
    plane_of[r.id[i]] = r.relations.plane_of[i];
  Unions unions(t.shapes.size());
  for(const Link& link : links) {
    std::uint32_t a = unions.root(link.first()), b = unions.root(link.second());
    if(a == b || plane_of[a] < 0 || plane_of[a] != plane_of[b])
      continue;
    const std::int64_t na = t.shapes[a].moments.count, nb = t.shapes[b].moments.count;
    if(na < nb || (na == nb && b < a))
      std::swap(a, b);
    unions.set_parent(b, a);
  }
  std::vector<std::uint32_t> target = identity_targets(t);
  for(std::uint32_t id : t.live)
    target[id] = unions.root(id);
  return target;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARIZE_SHAPES_H
