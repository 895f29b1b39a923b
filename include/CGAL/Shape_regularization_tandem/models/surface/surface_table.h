// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closed surface of the planes of shapes.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SURFACE_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SURFACE_TABLE_H

#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Short_edges.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Surface_input.h>
#include <CGAL/Shape_regularization_tandem/models/surface/limited_partition.h>

#include <cstddef>
#include <map>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

CGAL_TANDEM_MODELS_INLINE Surface_table surface_table(const std::vector<Position>& points, const Shapes_data& data,
                                                      std::size_t most_planes, const internal::Vector& upward)
{
  const Vector up(upward.x, upward.y, upward.z);
  const outlines::Shapes shapes(data);
  Surface_input input(points, shapes, most_planes);
  input.add_walls(outlines::outline_table(points, data), shapes, up);
  Surface_table result;
  result.number_of_planes = input.number_of_planes();
  if(input.planes().size() < Surface_input::fewest_planes)
    return result;
  const Cells cells = limited_partition(input.planes(), input.box());
  const Inside_cost cost(cells, input.planes(), up);
  const Inside_cells inside(cells, cost);
  for(std::size_t f = 0; f < cells.facets.size(); ++f)
    if(inside.is_boundary(int(f)))
      result.number_of_points += cost.number_of_points(int(f));
  const double shortest = 1e-9 * extent_of(input.box()); // what is closer is an effect of rounding
  const Short_edges edges(cells.points, Boundary_faces(cells, inside).faces(), shortest);
  std::map<int, std::size_t> number;
  for(const Face& face : edges.faces()) {
    result.plane_of_face.push_back(input.group(face.plane));
    result.faces.emplace_back();
    for(int v : face.vertices) {
      const auto added = number.emplace(v, result.points.size());
      if(added.second)
        result.points.push_back(input.out(cells.points[std::size_t(v)]));
      result.faces.back().push_back(added.first->second);
    }
  }
  return result;
}

} // namespace surface
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SURFACE_TABLE_H
