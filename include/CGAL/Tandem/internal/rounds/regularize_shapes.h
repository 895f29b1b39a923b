// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The regularity step of a round (section 4 of the paper): shapes that are large enough get the planes of their
// relations, the others keep their local fits. Changes planes and history of the shapes, but no label: surfels follow
// in apply_planes().

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_REGULARIZE_SHAPES_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_REGULARIZE_SHAPES_H

#include <CGAL/Tandem/internal/regularity/regularize.h>
#include <CGAL/Tandem/internal/regularity/relations.h>
#include <CGAL/Tandem/internal/shapes/Stage_parameters.h>
#include <CGAL/Tandem/internal/shapes/update_tables.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace CGAL::Tandem::internal {

// --- The relations of the shapes, and what the regularity step reads and writes.

// What the regularity step reads of a shape, on the host.
struct Shape_summary {
  std::uint64_t id; // wide, so that all bytes are defined where summaries are copied
  Shape_fit fit;
};

// What it writes.
struct Regular_shape {
  Regular_plane plane;
  std::int64_t plane_number;
};

// The relations of some shapes: those of shape id[i] are the entries i. The ids ascend, and are valid until the next pass
// of growth, which may renumber the shapes.
struct Shape_relations {
  std::vector<std::uint32_t> id;
  Relations relations;
};

// --- The step itself.

// All shapes are at their local planes afterwards.
struct Take_local {
  Shape* shape;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    shape[id].plane = shape[id].local;
    shape[id].plane_number = -1;
  }
};

// Of the shapes of at least a size, which are fitted.
struct Take_summary {
  Has_points is_taken;

  CGAL_TANDEM_HD bool has(std::uint32_t id) const { return is_taken(id); }
  CGAL_TANDEM_HD Shape_summary take(std::uint32_t id) const
  {
    const Shape& s = is_taken.shape[id];
    Shape_fit fit = {s.scatter, s.fit};
    fit.scatter.matrix = s.scatter.matrix / s.scatter.squared_tolerance;
    fit.eigen = eigen_system(Symmetric_matrix() + fit.scatter.matrix); // as a sum of one summand
    return {id, fit};
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
  }
};

// The offset of each plane becomes that which fits the points of all of its shapes best. All of these have entries.
inline void center_planes(const std::vector<Shape_summary>& shapes, Shape_relations& relations)
{
  Relations& r = relations.relations;
  std::vector<double> count(r.planes.size(), 0), sum(r.planes.size(), 0);
  for(const Shape_summary& shape : shapes) {
    const Scatter& s = shape.fit.scatter;
    const auto entry = std::lower_bound(relations.id.begin(), relations.id.end(), shape.id) - relations.id.begin();
    const std::size_t p = std::size_t(r.plane_of[std::size_t(entry)]);
    count[p] += s.weight();
    sum[p] = fused(s.weight(), dot(r.planes[p].normal, s.centroid), sum[p]);
  }
  for(std::size_t p = 0; p < count.size(); ++p)
    if(count[p] > 0)
      r.planes[p].offset = sum[p] / count[p];
}

// On the host, what the regularity step reads of the shapes of at least this size, by id. All have to be fitted.
template <class Backend>
std::vector<Shape_summary> summarize(Backend& backend, Shape_table<Backend>& shapes, std::int64_t minimum_size)
{
  return backend.template collect_on_host<Shape_summary>(shapes.size, Take_summary{{shapes.fitted(), minimum_size}},
                                                         shapes_per_thread);
}

// The shapes take the planes of their relations.
template <class Backend>
void apply_relations(Backend& backend, Shape_table<Backend>& shapes, const Shape_relations& r)
{
  const auto ids = to_buffer(backend, r.id);
  const auto regular = backend.template make_buffer<Regular_shape>(r.id.size(), [&](std::size_t i) {
    const int plane = r.relations.plane_of[i];
    return Regular_shape{r.relations.planes[std::size_t(plane)], plane};
  });
  backend.for_each(ids.size(), Apply_relation{shapes.table().data(), ids.data(), regular.data()}, shapes_per_thread);
}

// is_due: otherwise shapes get planes through their centroids, without relations. minimum_size: of the shapes that take part.
template <class Backend>
Shape_relations regularize_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes,
                                  const Stage_parameters& options, bool is_due, std::int64_t minimum_size)
{
  Backend& backend = points.backend;
  update_tables(points, shapes, tables::fits);
  for_each_shape(backend, shapes, Take_local{shapes.fitted()});
  Shape_fits fits;
  Shape_relations r;
  for(const Shape_summary& s : summarize(backend, shapes, minimum_size)) {
    fits.push_back(s.fit);
    r.id.push_back(std::uint32_t(s.id));
  }
  r.relations = regularize(fits, std::vector<char>(fits.size(), !is_due), options.regularity, false);
  apply_relations(backend, shapes, r);
  return r;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_REGULARIZE_SHAPES_H
