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
#include <CGAL/Tandem/internal/rounds/split_layers.h>
#include <CGAL/Tandem/internal/shapes/require.h>

#include <cstdint>
#include <cstdlib>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Which regularity step it is, and memory for samples.
template <class Backend>
struct Regularity_step {
  int round;
  bool is_last; // at the end: also small shapes take part, and those that wait after a rollback
  Sample_memory<Backend>& memory;
};

// All shapes are at their local planes afterwards; those that are too small to have relations lose theirs.
struct Reset_plane {
  Shape* shape;
  std::int64_t minimum_size;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    shape[id].plane = shape[id].local;
    shape[id].plane_number = -1;
    if(shape[id].moments.count < minimum_size)
      shape[id].history.set_related(0);
  }
};

struct Summarize_shape {
  const Shape* shape;
  const std::uint32_t* id;
  int round;
  Shape_summary* summary;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const Shape& s = shape[id[i]];
    const bool is_waiting = s.history.is_waiting(s.moments.count, round);
    summary[i] = {id[i],
                  s.entry,
                  is_waiting,
                  s.history.points_when_related(),
                  s.history.points_when_examined(),
                  {s.scatter, s.fit},
                  tested(s)};
  }
};

struct Apply_relation {
  Shape* shape;
  const std::uint32_t* id;
  const Regular_shape* regular;
  int round;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    Shape& s = shape[id[i]];
    s.plane = regular[i].plane;
    s.plane_number = regular[i].plane_number;
    s.history.set_related(regular[i].related_points);
    s.history.set_examined(regular[i].examined_points);
    s.history.last_misfits = regular[i].last_misfits;
    s.entry = int(i);
    if(regular[i].is_rolled_back)
      s.history.roll_back(s.moments.count, round);
  }
};

using Shape_summaries = std::vector<Shape_summary>;

// The verification of planes by the points, as the regularity step calls it: see Verified_planes.h. Shapes are numbered
// by entry; the counter has them at the same places.
template <class Backend>
class Point_verifier {
public:
  // misfits: of the shapes of the step, in the order of their summaries, which keep the last counts.
  Point_verifier(Backend& backend, const Options& options, Misfit_counter<Backend>& misfits, Shape_summaries& summaries)
    : backend_(backend), options_(options), summaries_(summaries), misfits_(misfits)
  {}

  // counts: of misfits, by place in `entries`, scaled from the sample to all points. No entry is listed twice.
  void operator()(const std::vector<int>& entries, const Regular_planes& candidates, std::vector<std::int64_t>& counts)
  {
    std::vector<double> share(entries.size());
    std::vector<std::uint32_t> query_of(summaries_.size(), no_index);
    std::vector<std::size_t> open; // places in `entries`
    std::vector<Misfit_query> query;
    for(std::size_t i = 0; i < entries.size(); ++i) {
      const Tested_shape& shape = tested(entries[i]);
      if(shape.knows_share(candidates[i], options_.maximum_distance, share[i]))
        continue;
      query_of[std::size_t(entries[i])] = std::uint32_t(open.size());
      query.push_back({rounded(shape.local), rounded(candidates[i])});
      open.push_back(i);
    }
    if(!open.empty()) {
      const std::vector<std::uint32_t> misfits = misfits_.count(query_of, query);
      for(std::size_t q = 0; q < open.size(); ++q)
        share[open[q]] = tested(entries[open[q]]).take_count(candidates[open[q]], misfits[q]);
    }
    for(std::size_t i = 0; i < entries.size(); ++i)
      counts[i] = std::int64_t(share[i] * double(tested(entries[i]).points));
  }

  template <class F>
  void for_each(std::size_t n, F f, std::size_t few) const
  {
    backend_.for_each_on_host(n, f, few);
  }

private:
  Tested_shape& tested(int entry) { return summaries_[std::size_t(entry)].tested; }

  Backend& backend_;
  const Options& options_;
  Shape_summaries& summaries_;
  Misfit_counter<Backend>& misfits_;
};

// Whether a shape keeps its relations while they are not found anew. It does not if it has none, or if it has changed
// much in the loop. In the end game all of its points fit its plane, so changes do not matter.
inline bool keeps_relations(const Shape_summary& shape, bool is_last)
{
  const std::int64_t before = shape.related_points; // 0 if it has none
  return is_last ? before > 0 : tuning::relations::points_per_held_change * std::abs(shape.points() - before) <= before;
}

// Whether so many points came, went or changed their shape that relations are to be found anew. Until then they are
// kept, since little changes in late rounds. With a period of more than one round related_points is 0, so they never
// are. points_before: of the shapes when the relations were found.
inline bool have_changed(const Shape_summaries& shapes, std::int64_t points_before, std::size_t assigned, bool is_last)
{
  std::int64_t changed = points_before;
  for(const Shape_summary& s : shapes) // less the points that are still there
    changed += std::abs(s.points() - s.related_points) - s.related_points;
  const double share = is_last ? tuning::relations::changed_share_at_end : tuning::relations::changed_share;
  return double(changed) > share * double(assigned);
}

// Shapes keep the planes of their relations, where keeps_relations(); the others stay at their local planes. Needs
// no test of points.
inline Shape_relations keep_relations(const Shape_summaries& shapes, const Shape_relations& before, bool is_last)
{
  const std::size_t n = shapes.size();
  Shape_relations r = {{}, before.relations, before.points};
  r.relations.direction_of.assign(n, -1);
  r.relations.plane_of.assign(n, -1);
  r.relations.is_rolled_back.assign(n, 0);
  for(std::size_t i = 0; i < n; ++i) {
    const Shape_summary& shape = shapes[i];
    if(keeps_relations(shape, is_last)) {
      r.relations.direction_of[i] = before.relations.direction_of[std::size_t(shape.entry)];
      r.relations.plane_of[i] = before.relations.plane_of[std::size_t(shape.entry)];
    } else {
      const Fit& fit = shape.fit.fit;
      set_own_plane(r.relations, i, plane_through(canonical(fit.normal), shape.fit.scatter.centroid));
    }
  }
  return r;
}

// Finds the relations of the shapes; where none are due, only the planes through their centroids. Shapes that wait have
// entries, too, with planes of their own.
template <class Verify>
Shape_relations find_relations(const Shape_summaries& shapes, const Options& options, bool is_due, bool is_last,
                               Verify& verify)
{
  Shape_fits fits;
  std::vector<char> is_excluded;
  Shape_relations r;
  for(const Shape_summary& s : shapes) {
    fits.push_back(s.fit);
    is_excluded.push_back(!is_due || (!is_last && s.is_waiting));
    r.points += is_due ? s.points() : 0;
  }
  Regularity_options regularity = options.regularity;
  regularity.is_last = is_last;
  regularity.points_of_strips = double(tuning::verification::strips_of_turned_shape * options.minimum_region_size);
  regularity.strip_share = is_last ? tuning::verification::strip_share_at_end : tuning::verification::strip_share;
  regularity.minimum_size = is_last ? double(options.minimum_region_size) : 0; // in the loop it grows again
  r.relations = regularize(fits, is_excluded, regularity, verify);
  return r;
}

// The step. `before`: the relations of the last one.
template <class Backend>
Shape_relations regularize_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                                  const Regularity_step<Backend>& step, const Shape_relations& before)
{
  Backend& backend = points.backend;
  require(points, shapes, tables::fits | tables::lists);
  const bool is_last = step.is_last, is_due = is_last || (step.round + 1) % options.regularity_period == 0;
  const std::int64_t minimum = is_last ? options.minimum_regular_size : options.minimum_related_size;
  for_each_shape(backend, shapes, Reset_plane{shapes.fitted(), minimum});
  const auto ids = backend.compact(shapes.size, Has_points{shapes.counted(), minimum});
  typename Backend::template Buffer<Shape_summary> buffer(ids.size());
  backend.for_each(ids.size(), Summarize_shape{shapes.fitted(), ids.data(), step.round, buffer.data()},
                   shapes_per_thread);
  Shape_summaries summaries = to_vector(backend, buffer);
  const bool is_first = is_last && before.id.empty(); // those of the loop are of other shapes
  const bool is_kept =
    is_due && !is_first && !have_changed(summaries, before.points, count_live(backend, shapes).points, is_last);
  Shape_relations r;
  if(is_kept)
    r = keep_relations(summaries, before, is_last);
  else {
    Misfit_counter<Backend> misfits(points, shapes, options, ids, step.memory);
    Point_verifier<Backend> verify(backend, options, misfits, summaries);
    r = find_relations(summaries, options, is_due, is_last, verify);
  }
  for(Shape_summary& s : summaries) {
    r.id.push_back(s.id);
    if(!is_kept)
      s.related_points = is_due ? s.points() : 0;
  }
  if(!is_last)
    split_layers(points, shapes, options, summaries, r);
  const Relations& relations = r.relations;
  const auto regular = backend.template make_buffer<Regular_shape>(summaries.size(), [&](std::size_t i) {
    const int plane = relations.plane_of[i];
    const Shape_summary& shape = summaries[i];
    return Regular_shape{
      relations.planes[std::size_t(plane)], shape.related_points, shape.examined_points, shape.tested.last, plane,
      relations.is_rolled_back[i] != 0};
  });
  backend.for_each(ids.size(), Apply_relation{shapes.counted(), ids.data(), regular.data(), step.round},
                   shapes_per_thread);
  return r;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_REGULARIZE_SHAPES_H
