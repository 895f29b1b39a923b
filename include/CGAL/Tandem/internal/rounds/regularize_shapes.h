// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The regularity step of a round (section 4 of the paper): shapes that are large enough get the planes of their
// relations, the others keep their local fits. Decides whether relations are kept or found anew, and who waits after a
// rollback. Changes planes and history of the shapes, but no label: points follow in apply_planes().

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_REGULARIZE_SHAPES_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_REGULARIZE_SHAPES_H

#include <CGAL/Tandem/internal/regularity/regularize.h>
#include <CGAL/Tandem/internal/rounds/Misfit_counter.h>
#include <CGAL/Tandem/internal/rounds/Shape_relations.h>

#include <algorithm>
#include <cstdlib>

namespace CGAL {
namespace Tandem {
namespace internal {

// Which regularity step it is.
struct Regularity_step {
  int round;
  bool is_last; // at the end: also small shapes take part, and those that wait after a rollback
};

// A shape that was rolled back takes part again when it has grown, or after 2, 4, 8 ... rounds. Otherwise each round
// would test it in vain.
inline void schedule_retry(Shape& shape, int round)
{
  shape.rollbacks = (std::min)(shape.rollbacks + 1, tuning::verification::maximum_rollbacks);
  shape.retry_round = round + (1 << shape.rollbacks);
  shape.retry_count = shape.moments.count + shape.moments.count / tuning::verification::retry_growth_divisor;
}

// The verification of planes by the points, as the regularity step calls it: see Verified_planes.h. That step numbers
// shapes by entry, the counter by id.
template <class Backend>
class Point_verifier {
public:
  // ids: of the shapes of the step.
  Point_verifier(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options, const Ids& ids)
    : backend_(points.backend), shapes_(shapes), ids_(ids), misfits_(points, shapes, options, ids)
  {}

  // counts: of misfits, by place in `entries`, scaled from the sample to all points.
  void operator()(const std::vector<int>& entries, const Regular_planes& candidates, std::vector<std::int64_t>& counts)
  {
    Ids ids(entries.size());
    for(std::size_t i = 0; i < ids.size(); ++i)
      ids[i] = ids_[std::size_t(entries[i])];
    const Unset_vector<double> shares = misfits_.count(ids, candidates);
    backend_.for_each_on_host(
      ids.size(), [&](std::size_t i) { counts[i] = std::int64_t(shares[i] * double(shapes_[ids[i]].moments.count)); });
  }

  template <class F>
  void for_each(std::size_t n, F f, std::size_t few) const
  {
    backend_.for_each_on_host(n, f, few);
  }

private:
  Backend& backend_;
  const Shape_table<Backend>& shapes_;
  const Ids& ids_;
  Misfit_counter<Backend> misfits_;
};

// Whether a shape keeps its relations while they are not found anew. It does not if it has none, or if it has changed
// much in the loop. In the end game all of its points fit its plane, so changes do not matter.
inline bool keeps_relations(const Shape& shape, bool is_last)
{
  const std::int64_t before = shape.regular_count; // 0 if it has none
  return is_last ? before > 0
                 : tuning::relations::points_per_held_change * std::abs(shape.moments.count - before) <= before;
}

// Whether so many points came, went or changed their shape that relations are to be found anew. Until then they are
// kept, since little changes in late rounds. With a period of more than one round regular_count is 0, so they never
// are.
template <class Backend>
bool have_changed(Backend& backend, const Shape_table<Backend>& shapes, const Ids& ids, std::int64_t points_before,
                  bool is_last)
{
  const auto change = [&](std::size_t i) { // less the points that are still there
    const Shape& shape = shapes[ids[i]];
    return std::abs(shape.moments.count - shape.regular_count) - shape.regular_count;
  };
  const std::int64_t changed = points_before + sum_on_host(backend, ids.size(), change);
  const double share = is_last ? tuning::relations::changed_share_at_end : tuning::relations::changed_share;
  return double(changed) > share * double(shapes.assigned);
}

// Shapes keep the planes of their relations, where keeps_relations(); the others stay at their local planes. Needs
// no test of points.
template <class Backend>
Shape_relations keep_relations(Shape_table<Backend>& shapes, const Ids& ids, const Shape_relations& before,
                               bool is_last)
{
  const std::size_t n = ids.size();
  Shape_relations r = {ids, before.relations, before.points};
  r.relations.direction_of.assign(n, -1);
  r.relations.plane_of.assign(n, -1);
  r.relations.is_rolled_back.assign(n, 0);
  for(std::size_t i = 0; i < n; ++i) {
    Shape& shape = shapes[ids[i]];
    if(keeps_relations(shape, is_last)) {
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

// All shapes are at their local planes afterwards. Returns those that are large enough to have relations; smaller ones
// lose theirs.
template <class Backend>
Ids reset_planes(Backend& backend, Shape_table<Backend>& shapes, std::int64_t minimum_size)
{
  return chosen_shapes(backend, shapes, [&](const Shape&, std::uint32_t id) {
    Shape& shape = shapes[id];
    shape.plane = shape.local;
    if(shape.moments.count < minimum_size)
      shape.regular_count = 0;
    return shape.moments.count >= minimum_size;
  });
}

// Finds the relations of the listed shapes; in rounds in which none are due, only the planes through their centroids.
// Shapes that wait have entries, too, with planes of their own.
template <class Backend>
Shape_relations find_relations(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                               const Regularity_step& step, const Ids& ids)
{
  Backend& backend = points.backend;
  const bool is_due = step.is_last || (step.round + 1) % options.regularity_period == 0;
  Shape_fits fits(ids.size());
  std::vector<char> is_excluded(ids.size());
  backend.for_each_on_host(ids.size(), [&](std::size_t i) {
    const Shape& shape = shapes[ids[i]];
    fits[i] = {shape.scatter, shape.fit};
    const bool is_waiting = step.round < shape.retry_round && shape.moments.count < shape.retry_count;
    is_excluded[i] = !is_due || (!step.is_last && is_waiting);
  });
  Point_verifier<Backend> verify(points, shapes, options, ids);
  Regularity_options regularity = options.regularity;
  regularity.is_last = step.is_last;
  regularity.points_of_strips = double(tuning::verification::strips_of_turned_shape * options.minimum_region_size);
  regularity.strip_share = step.is_last ? tuning::verification::strip_share_at_end : tuning::verification::strip_share;
  regularity.minimum_size = step.is_last ? double(options.minimum_region_size) : 0; // in the loop it grows again
  Shape_relations r;
  r.id = ids;
  r.relations = regularize(fits, is_excluded, regularity, verify);
  r.points = sum_on_host(backend, ids.size(), [&](std::size_t i) {
    Shape& shape = shapes[ids[i]];
    shape.plane = r.relations.planes[std::size_t(r.relations.plane_of[i])];
    shape.entry = int(i);
    shape.regular_count = is_due ? shape.moments.count : 0;
    if(r.relations.is_rolled_back[i])
      schedule_retry(shape, step.round);
    return shape.regular_count;
  });
  return r;
}

// The step. `before`: the relations of the last one.
template <class Backend>
Shape_relations regularize_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                                  const Regularity_step& step, const Shape_relations& before)
{
  Backend& backend = points.backend;
  const Ids ids =
    reset_planes(backend, shapes, step.is_last ? options.minimum_regular_size : options.minimum_related_size);
  const bool is_due = step.is_last || (step.round + 1) % options.regularity_period == 0;
  const bool is_first = step.is_last && before.id.empty(); // those of the loop are of other shapes
  if(is_due && !is_first && !have_changed(backend, shapes, ids, before.points, step.is_last))
    return keep_relations(shapes, ids, before, step.is_last);
  return find_relations(points, shapes, options, step, ids);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_REGULARIZE_SHAPES_H
