// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The regularity step of a round (section 4 of the paper): shapes that are large enough get the planes of their
// relations, the others keep their local fits. Changes planes and history of the shapes, but no label: points follow in
// apply_planes().

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_REGULARIZE_SHAPES_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_REGULARIZE_SHAPES_H

#include <CGAL/Tandem/internal/regularity/regularize.h>
#include <CGAL/Tandem/internal/rounds/split_layers.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// All shapes are at their local planes afterwards.
struct Take_local {
  Shape* shape;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    shape[id].plane = shape[id].local;
    shape[id].plane_number = -1;
  }
};

struct Summarize_shape {
  const Shape* shape;
  const std::uint32_t* id;
  Shape_summary* summary;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const Shape& s = shape[id[i]];
    summary[i] = {id[i], s.moments.count, s.history.points_when_examined(), {s.scatter, s.fit}};
  }
};

struct Apply_relation {
  Shape* shape;
  const std::uint32_t* id;
  const Regular_shape* regular;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    Shape& s = shape[id[i]];
    s.plane = regular[i].plane;
    s.plane_number = std::int32_t(regular[i].plane_number);
    s.history.set_examined(regular[i].examined_points);
  }
};

// The relations of the shapes; where none are due, only the planes through their centroids.
inline Shape_relations find_relations(const std::vector<Shape_summary>& shapes, const Regularity_options& options,
                                      bool is_due)
{
  Shape_fits fits;
  Shape_relations r;
  for(const Shape_summary& s : shapes) {
    fits.push_back(s.fit);
    r.id.push_back(std::uint32_t(s.id));
  }
  r.relations = regularize(fits, std::vector<char>(shapes.size(), !is_due), options);
  return r;
}

// Which regularity step it is: one of the loop, or the last one, in which also small shapes take part.
struct Regularity_step {
  int round;
  bool is_last;
};

template <class Backend>
Shape_relations regularize_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                                  const Regularity_step& step)
{
  Backend& backend = points.backend;
  require(points, shapes, tables::fits | tables::lists);
  const bool is_due = step.is_last || (step.round + 1) % options.regularity_period == 0;
  const std::int64_t minimum = step.is_last ? options.minimum_regular_size : options.minimum_related_size;
  for_each_shape(backend, shapes, Take_local{shapes.fitted()});
  const auto ids = backend.compact(shapes.size, Has_points{shapes.counted(), minimum});
  typename Backend::template Buffer<Shape_summary> buffer(ids.size());
  backend.for_each(ids.size(), Summarize_shape{shapes.fitted(), ids.data(), buffer.data()}, shapes_per_thread);
  std::vector<Shape_summary> summaries = to_vector(backend, buffer);
  Shape_relations r = find_relations(summaries, options.regularity, is_due);
  if(!step.is_last)
    split_layers(points, shapes, options, summaries, r);
  const auto regular = backend.template make_buffer<Regular_shape>(summaries.size(), [&](std::size_t i) {
    const int plane = r.relations.plane_of[i];
    return Regular_shape{r.relations.planes[std::size_t(plane)], summaries[i].examined_points, plane};
  });
  backend.for_each(ids.size(), Apply_relation{shapes.counted(), ids.data(), regular.data()}, shapes_per_thread);
  return r;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_REGULARIZE_SHAPES_H
