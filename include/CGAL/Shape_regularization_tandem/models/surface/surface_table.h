// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closed surface of the planes of shapes.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SURFACE_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SURFACE_TABLE_H

#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Border_walls.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Boundary_faces.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Cell_cutter.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

// --- What a closed surface is made of: the distinct planes of shapes that have an area, those with most points first, and
// walls behind them.

// Lengths are in a unit of about the largest coordinate.
class Surface_input {
public:
  static constexpr std::size_t fewest_planes = 4; // that enclose something

  // At most `most` planes that have points.
  Surface_input(const std::vector<Position>& points, const outlines::Shapes& shapes, std::size_t most)
    : unit_(points, shapes)
  {
    const double maximum_distance = unit_.in(shapes.parameters().maximum_distance);
    add_planes(points, shapes, most, maximum_distance);
    box_ = CGAL::Bbox_3(box_.xmin() - 2 * maximum_distance, box_.ymin() - 2 * maximum_distance,
                        box_.zmin() - 2 * maximum_distance, box_.xmax() + 2 * maximum_distance,
                        box_.ymax() + 2 * maximum_distance, box_.zmax() + 2 * maximum_distance);
  }

  // Below the borders of these outlines of the shapes.
  void add_walls(outlines::Polygon_table polygons, const outlines::Shapes& shapes, const Vector& up)
  {
    for(Position& p : polygons.points)
      for(double& x : p)
        x = unit_.in(x);
    std::vector<Coefficients> of_shapes;
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      of_shapes.push_back(unit_.in(shapes.coefficients(s)));
    Border_walls(planes_, up, unit_.in(shapes.parameters().maximum_distance)).add(polygons, of_shapes);
  }

  std::size_t number_of_planes() const { return groups_.size(); } // that have points
  const std::vector<Plane_coverage>& planes() const { return planes_; }
  const CGAL::Bbox_3& box() const { return box_; } // of the points, and somewhat around them

  // The coplanar group of a plane; none if it has no points, or is a side of the box.
  int group(int plane) const
  {
    return plane >= 0 && std::size_t(plane) < groups_.size() ? groups_[std::size_t(plane)] : none;
  }

  Position out(const Point& p) const { return unit_.out(Position{p.x(), p.y(), p.z()}); }

private:
  void add_planes(const std::vector<Position>& points, const outlines::Shapes& shapes, std::size_t most,
                  double resolution)
  {
    const std::vector<std::size_t> shape_of_group = shapes.distinct_planes();
    std::vector<std::vector<Point>> of_group(shape_of_group.size());
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      for(std::uint32_t i : shapes.points(s))
        of_group[shapes.coplanar_group(s)].push_back(unit_.in(points[i]));
    std::vector<std::size_t> order(of_group.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return of_group[a].size() > of_group[b].size(); });
    for(std::size_t g : order) {
      if(planes_.size() == most || of_group[g].empty())
        return;
      Plane_coverage plane(unit_.in(shapes.coefficients(shape_of_group[g])), std::move(of_group[g]), resolution);
      if(!plane.has_area())
        continue;
      for(const Point& p : plane.points())
        box_ += p.bbox();
      planes_.push_back(std::move(plane));
      groups_.push_back(int(g));
    }
  }

  outlines::Unit unit_;
  std::vector<Plane_coverage> planes_;
  std::vector<int> groups_; // of the planes that have points
  CGAL::Bbox_3 box_;
};

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
  const Cells cells = cut_cells(input.planes(), input.box());
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
