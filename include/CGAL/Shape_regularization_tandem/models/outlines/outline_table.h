// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The outlines of shapes. They do not depend on the orientations of the planes: they are made for those with positive
// normals.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TABLE_H

#include <CGAL/Shape_regularization_tandem/internal/relabel_shapes.h>
#include <CGAL/Shape_regularization_tandem/models/Polygon_table.h>
#include <CGAL/Shape_regularization_tandem/models/for_each_in_parallel.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Border_finder.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/common_vertices.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_draft.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_triangulation.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_directions.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Regular_loop.h>

#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/hilbert_sort.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::outlines {

// --- The points of a shape in its frame

// The order of the caller's points does not matter.
inline Shape_points points_of_shape(const std::vector<Position>& points, const Shapes& shapes, const Unit& unit,
                                    std::size_t s)
{
  std::vector<Kernel::Point_3> sorted;
  for(std::uint32_t i : shapes.points(s))
    sorted.push_back(unit.in(points[i]));
  std::sort(sorted.begin(), sorted.end());
  Shape_points result = {Plane_frame(shapes, s, sorted[0]), {}, {}, {}};
  using Item = std::pair<Kernel::Point_2, std::uint32_t>;
  std::vector<Item> items;
  for(const Kernel::Point_3& p : sorted)
    items.emplace_back(result.frame.flat(p), std::uint32_t(items.size()));
  CGAL::hilbert_sort(items.begin(), items.end(),
                     CGAL::Spatial_sort_traits_adapter_2<Kernel, CGAL::First_of_pair_property_map<Item>>());
  for(const auto& [flat, i] : items) {
    result.flat.push_back(flat);
    result.points.push_back(sorted[i]);
  }
  return result;
}

class Polygon_maker {
public:
  Polygon_maker(const std::vector<Position>& points, const Shapes& shapes, const Model_progress& progress)
    : shapes(shapes), progress(progress), unit(points, shapes), n(shapes.number_of_shapes()),
      resolution(2 * unit.in(shapes.parameters().maximum_distance)), all(n), triangulations(n)
  {
    for(std::size_t s : shapes.distinct_planes())
      planes.push_back(unit.in(shapes.coefficients(s)));
    for(std::size_t s = 0; s < n; ++s)
      projections.emplace_back(plane_of(s));
    for_each_in_parallel(n, progress, [&](std::size_t s) {
      all[s] = points_of_shape(points, shapes, unit, s);
      triangulations[s] = std::make_unique<Outline_triangulation>(all[s].flat, resolution);
      all[s].spacing = triangulations[s]->spacings();
    });
  }

  // Once: the drafts are used up.
  Polygon_table polygons()
  {
    draw_borders();
    is_framed.resize(n);
    for_each_in_parallel(n, progress, [&](std::size_t s) { is_framed[s] = draft_outline(s); });
    make_regular();
    share_vertices();
    return joined_polygons();
  }

private:
  // The straight borders, whose ends are chosen for all shapes together.
  void draw_borders()
  {
    const Border_finder finder(shapes, unit, all);
    std::vector<Border_pieces> pieces(n);
    borders.resize(n);
    drafts.resize(n);
    for_each_in_parallel(n, progress, [&](std::size_t s) { pieces[s] = finder.pieces_of(s, borders[s]); });
    join_common_ends(pieces);
    for_each_in_parallel(n, progress, [&](std::size_t s) {
      for(const Border_piece& piece : pieces[s]) {
        borders[s].borders.push_back(finder.border_of(s, piece));
        drafts[s].lines.push_back(piece.line);
      }
      for(const Border_line& line : finder.lines_near(s))
        drafts[s].lines.push_back(line);
    });
  }

  // Without straight borders, if they do not fit together. Where lines touch or cross by the rounding of coordinates,
  // the points themselves, projected without rounding, have outlines that do not; then it returns false.
  bool draft_outline(std::size_t s)
  {
    Outline_draft& draft = drafts[s];
    for(const Straight_border& border : borders[s].borders)
      triangulations[s]->insert(border, all[s].frame);
    for(std::uint32_t i : borders[s].cut)
      triangulations[s]->cut(i);
    std::vector<Outline_loop> loops = placed_outline(std::move(*triangulations[s]), s);
    triangulations[s].reset();
    if(draft.make(std::move(loops), limits.tolerance) ||
       draft.make(placed_outline(Outline_triangulation(all[s].flat, resolution), s), limits.tolerance))
      return true;
    const std::vector<Outline_loop> projected = projected_outline(s);
    if(!draft.make(projected, limits.tolerance))
      draft.make(projected, 0);
    return false;
  }

  // Ends of straight borders that are no corners move to where regular edges begin.
  void make_regular()
  {
    const Plane_directions directions(shapes);
    std::vector<std::vector<Wanted_end>> wanted(n);
    std::vector<std::vector<Kernel::Vector_2>> along(n); // what edges may be parallel to
    for_each_in_parallel(n, progress, [&](std::size_t s) { along[s] = directions.of_shape(s, all[s].frame); });
    add_own_directions(shapes, drafts, is_framed, along);
    for_each_in_parallel(n, progress, [&](std::size_t s) {
      if(is_framed[s])
        wanted[s] = wanted_ends(s, along[s]);
    });
    Moved_ends moved;
    for(std::size_t s = 0; s < n; ++s) {
      moved.add_edges(drafts[s]);
      for(const Wanted_end& end : wanted[s])
        moved.add_wish(end);
    }
    moved.decide(
      [&](const Border_line& line, double along) { return position_on(line, line.origin + along * line.direction); });
    for_each_in_parallel(n, progress, [&](std::size_t s) {
      if(is_framed[s])
        make_regular(s, along[s], moved);
    });
  }

  std::vector<Wanted_end> wanted_ends(std::size_t s, const std::vector<Kernel::Vector_2>& along) const
  {
    std::vector<Wanted_end> result;
    for(const Outline_loop& loop : drafts[s].loops()) {
      const Border_points border(loop, drafts[s].dense_loop(loop));
      Regular_loop(border, along).for_each_wanted_end([&](std::size_t i, const Kernel::Point_2& p) {
        const int number = loop[i].border >= 0 ? loop[i].border : loop[(i + loop.size() - 1) % loop.size()].border;
        result.push_back({loop[i].position, drafts[s].lines[std::size_t(number)], all[s].frame.lifted(p)});
      });
    }
    return result;
  }

  void make_regular(std::size_t s, const std::vector<Kernel::Vector_2>& along, const Moved_ends& moved)
  {
    drafts[s].change([&](const Outline_loop& loop) {
      Outline_loop with_moved = loop;
      for(Outline_vertex& v : with_moved)
        if(const Position* p = v.is_fixed ? moved.moved_from(v.position) : nullptr)
          v = fixed_vertex(s, v, *p);
      const Border_points border(with_moved, drafts[s].dense_loop(loop));
      const Outline_loop rectangle = rectangle_of_hole(border, along);
      return placed(rectangle.empty() ? Regular_loop(border, along).loop() : rectangle, s);
    });
  }

  // Like another one, at a position.
  Outline_vertex fixed_vertex(std::size_t s, const Outline_vertex& like, const Position& p) const
  {
    Outline_vertex result = like;
    result.is_fixed = true;
    result.position = p;
    result.point = all[s].frame.flat(point_at(p));
    result.written = projections[s].projected(p);
    return result;
  }

  Position position_on(const Border_line& line, const Kernel::Point_3& near) const
  {
    return unit.written(
      point_on_planes({planes[std::size_t(line.planes[0])], planes[std::size_t(line.planes[1])]}, near));
  }

  void find_edges_on_lines(std::size_t s)
  {
    const auto on_line = [&](const Outline_vertex& v, const Border_line& line) {
      return fixed_vertex(s, v, position_on(line, point_at(v.position)));
    };
    drafts[s].change([&](const Outline_loop& loop) { return with_edges_on_lines(loop, drafts[s].lines, on_line); });
  }

  void join_vertices(std::size_t s, const Common_vertices& apart)
  {
    drafts[s].change([&](Outline_loop loop) {
      bool has_changed = false;
      for(Outline_vertex& v : loop)
        if(const Position p = apart.joined(v.position); p != v.position) {
          v = fixed_vertex(s, v, p);
          has_changed = true;
        }
      return has_changed ? loop : Outline_loop();
    });
  }

  void share_vertices()
  {
    for_each_in_parallel(n, progress, [&](std::size_t s) { find_edges_on_lines(s); });
    Common_vertices apart(drafts);
    apart.join();
    for_each_in_parallel(n, progress, [&](std::size_t s) { join_vertices(s, apart); });
    const Common_vertices common(drafts);
    for_each_in_parallel(n, progress, [&](std::size_t s) {
      const auto vertex = [&](const Outline_vertex& like, const Position& p) { return fixed_vertex(s, like, p); };
      drafts[s].change([&](const Outline_loop& loop) { return common.longer(drafts[s], loop, vertex); });
    });
  }

  // In one table of vertices: those with equal coordinates become one.
  Polygon_table joined_polygons()
  {
    Polygon_table result;
    std::map<Position, std::uint32_t> number_of;
    for(std::size_t s = 0; s < n; ++s) {
      const std::vector<Outline_vertex>& vertices = drafts[s].vertices();
      std::vector<std::uint32_t> numbers;
      for(const Outline_vertex& v : vertices) {
        const auto added = number_of.emplace(unit.out(v.position), std::uint32_t(result.points.size()));
        if(added.second)
          result.points.push_back(added.first->first);
        numbers.push_back(added.first->second);
      }
      double area = 0;
      for(Polygon& polygon : drafts[s].polygons()) {
        for(const auto& t : polygon.triangles)
          area += CGAL::area(vertices[t[0]].written, vertices[t[1]].written, vertices[t[2]].written);
        for_each_list(polygon, [&](auto& corners) {
          for(std::uint32_t& corner : corners)
            corner = numbers[corner];
        });
      }
      result.areas.push_back(unit.area_out(area / projections[s].shrinkage()));
      result.polygons.push_back(std::move(drafts[s].polygons()));
      result.frames.emplace_back(shapes.coefficients(s));
    }
    return result;
  }

  const Shapes::Coefficients& plane_of(std::size_t s) const { return planes[shapes.coplanar_group(s)]; }

  Outline_loop placed(Outline_loop loop, std::size_t s) const
  {
    for(Outline_vertex& v : loop) {
      if(!v.is_fixed)
        v.position = point_on_planes({plane_of(s)}, all[s].frame.lifted(v.point));
      v.position = unit.written(v.position);
      v.written = projections[s].projected(v.position);
    }
    return loop;
  }

  std::vector<Outline_loop> placed_outline(Outline_triangulation&& triangulation, std::size_t s) const
  {
    std::vector<Outline_loop> loops = triangulation.outline(limits);
    for(Outline_loop& loop : loops)
      loop = placed(std::move(loop), s);
    return loops;
  }

  std::vector<Outline_loop> projected_outline(std::size_t s) const
  {
    const Projection& frame = projections[s];
    std::vector<Kernel::Point_2> points;
    for(const Kernel::Point_3& p : all[s].points)
      points.push_back(frame.projected({p.x(), p.y(), p.z()}));
    std::vector<Outline_loop> loops = Outline_triangulation(points, resolution).outline(limits);
    for(Outline_loop& loop : loops)
      for(Outline_vertex& v : loop) {
        v.position = frame.on_plane(v.written);
        v.is_fixed = false;
      }
    return loops;
  }

  const Shapes& shapes;
  const Model_progress& progress;
  Unit unit;
  std::size_t n;
  double resolution; // places are known no better along a plane than across it: to both sides
  Outline_limits limits;
  std::vector<Shapes::Coefficients> planes; // of the coplanar groups
  std::vector<Projection> projections;      // of the shapes, in the unit
  std::vector<Shape_points> all;
  std::vector<std::unique_ptr<Outline_triangulation>> triangulations;
  std::vector<Straight_borders> borders; // of the shapes
  std::vector<Outline_draft> drafts;     // of the shapes
  std::vector<char> is_framed;           // whether the draft of the shape is in its frame
};

// Whether the largest number in the normal is negative.
inline bool is_turned(const Coefficients& c) { return c[steepest_axis(c)] < 0; }

// The largest number of each normal is positive.
inline Shapes_data with_positive_normals(Shapes_data data)
{
  for(Coefficients& c : data.coefficients)
    if(is_turned(c))
      for(double& x : c)
        x = -x;
  return data;
}

// With the orientations that the planes had.
inline Polygon_table with_orientations_of(const std::vector<Coefficients>& planes, Polygon_table table)
{
  for(std::size_t s = 0; s < planes.size(); ++s) {
    if(!is_turned(planes[s]))
      continue;
    table.frames[s] = Projection(planes[s]);
    for(Polygon& polygon : table.polygons[s])
      for_each_list(polygon, [](auto& corners) { std::reverse(corners.begin(), corners.end()); });
  }
  return table;
}

// Of shapes with points.
inline Polygon_table table_of_outlines(const std::vector<Position>& points, const Shapes_data& data,
                                       const Model_progress& progress)
{
  const Shapes shapes(with_positive_normals(data));
  return with_orientations_of(data.coefficients, Polygon_maker(points, shapes, progress).polygons());
}

// Known planes may have no points.
// NOLINTNEXTLINE(misc-definitions-in-headers): inline where no library is linked
CGAL_TANDEM_MODELS_INLINE Polygon_table outline_table(const std::vector<Position>& points, const Shapes_data& data,
                                                      const Model_progress& progress)
{
  std::vector<std::size_t> source;
  std::vector<int> number(data.size.size(), -1);
  for(std::size_t s = 0; s < number.size(); ++s)
    if(data.size[s] > 0) {
      number[s] = int(source.size());
      source.push_back(s);
    }
  if(source.size() == number.size())
    return table_of_outlines(points, data, progress);
  Polygon_table table = table_of_outlines(points, relabel_shapes(data, source, number), progress);
  for(std::size_t s = 0; s < number.size(); ++s)
    if(number[s] < 0) {
      const auto place = std::ptrdiff_t(s);
      table.polygons.emplace(table.polygons.begin() + place);
      table.areas.insert(table.areas.begin() + place, 0);
      table.frames.emplace(table.frames.begin() + place, data.coefficients[s]);
    }
  return table;
}

} // namespace CGAL::Tandem::internal::outlines

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TABLE_H
