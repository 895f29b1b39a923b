// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closed surface of the planes of shapes.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SURFACE_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SURFACE_TABLE_H

#include <CGAL/Shape_regularization_tandem/models/Polygon_table.h>
#include <CGAL/Shape_regularization_tandem/models/for_each_in_parallel.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Point_blocks.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Boundary_faces.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Cell_cutter.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Plane_coverage.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Site.h>
#include <CGAL/Shape_regularization_tandem/models/surface/crossing_faces.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::surface {

// --- Walls that no point covers, as in airborne scans: where a shape ends with another one below its border, a wall is
// assumed to go straight down from there.

class Border_walls {
public:
  Border_walls(std::vector<Plane_coverage>& planes, const Vector& up, double maximum_distance)
    : planes_(planes), up_(up), near_(2 * maximum_distance)
  {}

  // A rectangle between two heights, in a plane that is there, or in a new one.
  void add_wall(const Plane_coverage::Corners& wall)
  {
    auto plane = std::find_if(planes_.begin(), planes_.end(), [&](const Plane_coverage& p) {
      return is_upright(p.plane()) &&
             std::all_of(wall.begin(), wall.end(), [&](const Point& corner) { return is_near(p.plane(), corner); });
    });
    if(plane == planes_.end())
      plane = planes_.insert(planes_.end(), plane_of(wall));
    plane->reach(wall);
    plane->assume(wall);
  }

  // Below the borders of these polygons, each of which has a plane of its own, from long ones to short ones.
  void add(const outlines::Polygon_table& polygons, const std::vector<Coefficients>& planes,
           const Model_progress& progress)
  {
    std::vector<Border> borders;
    for(std::size_t s = 0; s < polygons.polygons.size(); ++s)
      if(!is_upright(planes[s]))
        for(const Indexed_polygon& polygon : polygons.polygons[s])
          add_borders(polygons, polygon, planes[s], borders);
    std::stable_sort(borders.begin(), borders.end(),
                     [](const Border& a, const Border& b) { return a.length > b.length; });
    std::vector<Plane_coverage> with_walls = planes_;
    for(const Border& border : borders) {
      with_walls.push_back(plane_of(border.wall));
      with_walls.back().assume(border.wall);
    }
    const Ray_votes rays(with_walls, up_);
    std::vector<double> ratios(borders.size());
    for_each_in_parallel(borders.size(), progress, [&](std::size_t w) {
      const std::size_t plane = planes_.size() + w;
      ratios[w] = std::fabs(rays.balance(places_on(borders[w]), with_walls[plane].normal(), plane));
    });
    for(std::size_t w = 0; w < borders.size(); ++w)
      if(ratios[w] > least_ratio)
        add_wall(borders[w].wall);
  }

private:
  struct Border {
    Point first, last;
    double drop;                  // to the plane below
    double length;                // seen from above
    Plane_coverage::Corners wall; // below it
  };

  bool is_upright(const Coefficients& c) const
  {
    return std::fabs(Vector(c[0], c[1], c[2]) * up_) < outlines::smallest_sine;
  }
  bool is_near(const Coefficients& c, const Point& p) const { return std::fabs(height(c, p)) < near_; }

  void add_borders(const outlines::Polygon_table& polygons, const Indexed_polygon& polygon, const Coefficients& own,
                   std::vector<Border>& borders) const
  {
    const auto point = [&](std::uint32_t i) { return outlines::point_at(polygons.points[i]); };
    Vector area = CGAL::NULL_VECTOR;
    for(const auto& t : polygon.triangles)
      area = area + CGAL::cross_product(point(t[1]) - point(t[0]), point(t[2]) - point(t[0]));
    const Vector left = (area * up_ > 0 ? 1 : -1) * up_; // the polygon is on the left side of its edges
    const auto add = [&](const auto& loop) {
      for(std::size_t i = 0; i < loop.size(); ++i) {
        Border border = {point(loop[i]), point(loop[(i + 1) % loop.size()]), 0, 0, {}};
        const Vector outward = CGAL::cross_product(border.last - border.first, left);
        border.length = std::sqrt(outward.squared_length());
        if(border.length < shortest_wall * near_ || ends_at_other(own, border))
          continue;
        const Point middle = CGAL::midpoint(border.first, border.last);
        const Plane_coverage* const below = plane_below(middle + near_ / border.length * outward, border.drop);
        if(below == nullptr || is_seen_behind(border, *below, -1 / border.length * outward))
          continue;
        border.wall = {border.first, border.last, border.last - border.drop * up_, border.first - border.drop * up_};
        borders.push_back(border);
      }
    };
    add(polygon.outer);
    for(const auto& hole : polygon.holes)
      add(hole);
  }

  bool ends_at_other(const Coefficients& own, const Border& border) const
  {
    return std::any_of(planes_.begin(), planes_.end(), [&](const Plane_coverage& p) {
      return p.plane() != own && is_near(p.plane(), border.first) && is_near(p.plane(), border.last) &&
             p.is_near_hull(CGAL::midpoint(border.first, border.last), near_);
    });
  }

  // The lowest plane that is below a point, and how far.
  const Plane_coverage* plane_below(const Point& p, double& drop) const
  {
    const Plane_coverage* result = nullptr;
    for(const Plane_coverage& plane : planes_)
      if(const double d = is_upright(plane.plane()) ? 0 : drop_to(plane, p);
         d > near_ && (result == nullptr || d > drop) && plane.is_near_hull(p - d * up_, 0)) {
        result = &plane;
        drop = d;
      }
    return result;
  }

  double drop_to(const Plane_coverage& plane, const Point& p) const { return plane.height(p) / (plane.normal() * up_); }

  // Whether more than a quarter of the plane below is covered behind the wall: what saw it would have seen the wall.
  bool is_seen_behind(const Border& border, const Plane_coverage& below, const Vector& inward) const
  {
    constexpr int rows = 4;
    const double depth = (std::min)(border.drop, border.length) / 2;
    int seen = 0;
    for(int i = 0; i < rows; ++i)
      for(int j = 0; j < rows; ++j) {
        const Point p =
          border.first + (i + .5) / rows * (border.last - border.first) + (j + .5) / rows * depth * inward;
        seen += below.is_covered(p - drop_to(below, p) * up_);
      }
    return 4 * seen > rows * rows;
  }

  Plane_coverage plane_of(const Plane_coverage::Corners& wall) const
  {
    const Vector across = CGAL::cross_product(wall[1] - wall[0], up_),
                 normal = across / std::sqrt(across.squared_length());
    const double offset = -(normal * (CGAL::midpoint(wall[0], wall[1]) - CGAL::ORIGIN));
    return Plane_coverage({normal.x(), normal.y(), normal.z(), offset});
  }

  // On the wall.
  std::vector<Point> places_on(const Border& border) const
  {
    constexpr int rows = 16;
    std::vector<Point> places;
    for(int i = 0; i < rows; ++i)
      for(int j = 0; j < rows; ++j)
        places.push_back(border.first + (i + .5) / rows * (border.last - border.first) -
                         (j + .5) / rows * border.drop * up_);
    return places;
  }

  static constexpr double shortest_wall = 5; // times the distance within which two places are one
  static constexpr double least_ratio = .25; // of rays: they say nothing of a border within a room or below a roof

  std::vector<Plane_coverage>& planes_;
  Vector up_;
  double near_;
};

// --- What a closed surface is made of: the distinct planes of shapes that have an area, those with most points first, and
// walls behind them.

// Lengths are in a unit of about the largest coordinate.
struct Surface_input {
  static constexpr std::size_t fewest_planes = 4; // that enclose something

  outlines::Unit unit;
  std::vector<Plane_coverage> planes;
  std::vector<int> groups; // the coplanar groups of the planes that have points, which come first
  std::size_t omitted = 0; // further planes, with fewer points
  CGAL::Bbox_3 box;        // of the points, and somewhat around them
  Site site;

  // At most `most` planes that have points.
  Surface_input(const std::vector<Position>& points, const outlines::Shapes& shapes, std::size_t most,
                const Surface_request& request)
    : unit(points, shapes), site{{request.up.x, request.up.y, request.up.z}, std::nullopt, {}}
  {
    const double maximum_distance = unit.in(shapes.parameters().maximum_distance);
    const std::vector<std::size_t> shape_of_group = shapes.distinct_planes();
    std::vector<std::vector<Point>> of_group(shape_of_group.size());
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      for(std::uint32_t i : shapes.points(s))
        of_group[shapes.coplanar_group(s)].push_back(unit.in(points[i]));
    std::vector<std::size_t> order(of_group.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return of_group[a].size() > of_group[b].size(); });
    for(std::size_t g : order) {
      Plane_coverage plane(unit.in(shapes.coefficients(shape_of_group[g])), std::move(of_group[g]));
      if(!plane.has_area())
        continue;
      if(planes.size() == most) {
        ++omitted;
        continue;
      }
      for(const Point& p : plane.points())
        box += p.bbox();
      planes.push_back(std::move(plane));
      groups.push_back(int(g));
    }
    box = outlines::grown(box, 2 * maximum_distance);
    if(request.base_height)
      site.base = unit.in(*request.base_height);
    else if(!request.footprint.empty())
      site.base = box.zmin();
    for(const Flat_polygon& ring : request.footprint) {
      site.footprint.emplace_back();
      for(const Kernel::Point_2& p : ring)
        site.footprint.back().emplace_back(unit.in(p.x()), unit.in(p.y()));
    }
  }

  // These outlines of the shapes, what is known of the ground, and walls below borders.
  void add_outlines(outlines::Polygon_table polygons, const outlines::Shapes& shapes, const Model_progress& progress)
  {
    for(Position& p : polygons.points)
      for(double& x : p)
        x = unit.in(x);
    std::vector<Coefficients> of_shapes;
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      of_shapes.push_back(unit.in(shapes.coefficients(s)));
    std::vector<int> plane_of_group(shapes.number_of_shapes(), none);
    for(std::size_t p = 0; p < groups.size(); ++p)
      plane_of_group[std::size_t(groups[p])] = int(p);
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      if(const int p = plane_of_group[std::size_t(shapes.coplanar_group(s))]; p != none)
        for(const Indexed_polygon& polygon : polygons.polygons[s])
          for(const auto& t : polygon.triangles)
            planes[std::size_t(p)].cover({outlines::point_at(polygons.points[t[0]]),
                                          outlines::point_at(polygons.points[t[1]]),
                                          outlines::point_at(polygons.points[t[2]])});
    const double maximum_distance = unit.in(shapes.parameters().maximum_distance);
    if(site.base)
      add_base(8 * maximum_distance);
    Border_walls walls(planes, site.up, maximum_distance);
    site.for_each_wall(box.zmax(), [&](const Plane_coverage::Corners& wall) { walls.add_wall(wall); });
    walls.add(polygons, of_shapes, progress);
  }

  // Somewhat larger than what is above it.
  void add_base(double margin)
  {
    Plane_coverage base(site.base_plane());
    CGAL::Bbox_2 seen;
    for(double x : {box.xmin(), box.xmax()})
      for(double y : {box.ymin(), box.ymax()})
        for(double z : {box.zmin(), box.zmax()})
          seen += base.flat(Point(x, y, z)).bbox();
    const double left = seen.xmin() - margin, right = seen.xmax() + margin;
    const Plane_coverage::Corners all = {
      base.lifted({left, seen.ymin() - margin}), base.lifted({right, seen.ymin() - margin}),
      base.lifted({right, seen.ymax() + margin}), base.lifted({left, seen.ymax() + margin})};
    base.reach(all);
    base.assume(all);
    box = outlines::grown(box + base.box(0), margin);
    planes.push_back(std::move(base));
  }

  // The coplanar group of a plane; none if it has no points, or is a face of the box.
  int group(int plane) const
  {
    return plane >= 0 && std::size_t(plane) < groups.size() ? groups[std::size_t(plane)] : none;
  }
};

// Of the planes, where these faces are.
inline std::size_t number_of_points(const Cells& cells, const std::vector<Face>& faces,
                                    const std::vector<Plane_coverage>& planes, const Model_progress& progress)
{
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, std::size_t>;
  std::vector<std::vector<int>> facets_of(planes.size());
  for(const Face& face : faces)
    if(face.plane != none)
      facets_of[std::size_t(face.plane)].insert(facets_of[std::size_t(face.plane)].end(), face.facets.begin(),
                                                face.facets.end());
  std::vector<std::size_t> numbers(planes.size());
  for_each_in_parallel(planes.size(), progress, [&](std::size_t p) {
    std::vector<Flat_polygon> facets;
    Flat_polygon flat;
    std::vector<Box> facet_boxes, point_boxes;
    for(int f : facets_of[p]) {
      facets.push_back(planes[p].flat(cells.corners(cells.facet(f))));
      facet_boxes.emplace_back(CGAL::bbox_2(facets.back().begin(), facets.back().end()), facet_boxes.size());
    }
    for(const Point& point : planes[p].points()) {
      flat.push_back(planes[p].flat(point));
      point_boxes.emplace_back(flat.back().bbox(), point_boxes.size());
    }
    std::vector<char> is_near(flat.size(), 0);
    CGAL::box_intersection_d(
      facet_boxes.begin(), facet_boxes.end(), point_boxes.begin(), point_boxes.end(), [&](const Box& f, const Box& q) {
        const Flat_polygon& facet = facets[f.info()];
        if(is_near[q.info()] == 0 &&
           CGAL::bounded_side_2(facet.begin(), facet.end(), flat[q.info()]) != CGAL::ON_UNBOUNDED_SIDE)
          is_near[q.info()] = 1;
      });
    numbers[p] = std::size_t(std::count(is_near.begin(), is_near.end(), 1));
  });
  return std::accumulate(numbers.begin(), numbers.end(), std::size_t(0));
}

struct Areas {
  double all = 0, scanned = 0;
};

inline Areas areas_of(const Face& face, const Inside_cost& cost)
{
  Areas result;
  for(int f : face.facets) {
    result.all += cost.area[std::size_t(f)];
    result.scanned += cost.scanned[std::size_t(f)];
  }
  return result;
}

// Planes that are closer than rounding allows may cross where they should meet.
inline void add_triangles(const std::vector<Point>& points, Surface_table& table)
{
  Checked_triangles checked = checked_triangles(points, table.faces);
  table.triangles = std::move(checked.triangles);
  table.face_of_triangle = std::move(checked.face_of_triangle);
  if(checked.crossing_faces.empty())
    return;
  const auto [f, g] = checked.crossing_faces.front();
  throw std::runtime_error(
    "CGAL::Tandem: a closed surface would cross itself, as the coordinates of its corners are rounded: faces of "
    "the coplanar groups " +
    std::to_string(table.plane_of_face[f]) + " and " + std::to_string(table.plane_of_face[g]) +
    " (-1: no group). Without the points of one of them there may be a surface");
}

// Without the points of shapes that are not in the rings.
inline Shapes_data cropped(Shapes_data data, const std::vector<Position>& points, const Rings& rings)
{
  std::vector<std::int32_t> label(data.shape_of.begin(), data.shape_of.end());
  for(std::size_t i = 0; i < label.size(); ++i)
    if(label[i] >= 0 && !is_in(rings, {points[i][0], points[i][1]})) {
      --data.size[std::size_t(label[i])];
      label[i] = -1;
    }
  data.shape_of = std::move(label);
  return data;
}

// Planes, and the cells of their box. Of cells that are too many, half of the planes makes fewer.
struct Surface_cells {
  Surface_input input;
  Cells cells;
};

inline Surface_cells surface_cells(const std::vector<Position>& points, const outlines::Shapes& shapes,
                                   const outlines::Polygon_table& polygons, const Surface_request& request,
                                   Model_progress& progress)
{
  constexpr std::size_t most_cells = 400000;
  for(std::size_t most = request.most_planes;;) {
    Surface_input input(points, shapes, most, request);
    input.add_outlines(polygons, shapes, progress);
    if(input.planes.size() < Surface_input::fewest_planes)
      return {std::move(input), Cells()};
    progress.begin_stage(.4);
    Cells cells = cut_cells(input.planes, input.box, most_cells, progress);
    if(cells.cells.size() < most_cells || input.groups.size() <= Surface_input::fewest_planes)
      return {std::move(input), std::move(cells)};
    most = input.groups.size() / 2;
  }
}

// NOLINTNEXTLINE(misc-definitions-in-headers): inline where no library is linked
CGAL_TANDEM_MODELS_INLINE Surface_table surface_table(const std::vector<Position>& points, const Shapes_data& data,
                                                      const Surface_request& request)
try {
  Model_progress progress(request.callback);
  progress.begin_stage(.3);
  const outlines::Shapes shapes(request.footprint.empty() ? data : cropped(data, points, request.footprint));
  const auto [input, cells] =
    surface_cells(points, shapes, outlines::outline_table(points, shapes.data(), true, progress), request, progress);
  Surface_table result;
  result.number_of_planes = input.groups.size();
  result.number_of_omitted_planes = input.omitted;
  if(cells.cells.empty())
    return result;
  progress.begin_stage(.8);
  const Inside_cost cost(cells, input.planes, input.site, progress);
  progress.begin_stage(.9);
  const Inside_cells inside(cells, cost);
  const std::vector<Face> faces =
    faces_of_components(Boundary_faces(cells, inside).faces(), cost.area, request.most_components);
  progress.begin_stage(1);
  result.number_of_points = number_of_points(cells, faces, input.planes, progress);
  std::map<int, std::size_t> number;
  std::vector<Point> corners;
  Areas whole;
  for(const Face& face : faces) {
    result.plane_of_face.push_back(input.group(face.plane));
    const Areas areas = areas_of(face, cost);
    result.supported_of_face.push_back(areas.scanned / areas.all);
    whole.all += areas.all;
    whole.scanned += areas.scanned;
    result.faces.emplace_back();
    for(int v : face.vertices) {
      const auto added = number.emplace(v, corners.size());
      if(added.second)
        corners.push_back(cells.points[std::size_t(v)]);
      result.faces.back().push_back(added.first->second);
    }
  }
  result.supported = faces.empty() ? 0 : whole.scanned / whole.all;
  add_triangles(corners, result);
  for(const Point& p : corners)
    result.points.push_back(input.unit.out(Position{p.x(), p.y(), p.z()}));
  return result;
} catch(const Model_progress::Cancelled&) {
  return Surface_table();
}

} // namespace CGAL::Tandem::internal::surface

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SURFACE_TABLE_H
