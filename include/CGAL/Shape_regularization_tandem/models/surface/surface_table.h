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
#include <CGAL/Shape_regularization_tandem/models/surface/Border_walls.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Boundary_faces.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Cell_cutter.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Plane_coverage.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Site.h>
#include <CGAL/Shape_regularization_tandem/models/surface/crossing_faces.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::surface {

// --- The planes of a site: the distinct planes of shapes that have an area there, those with most points first, and what is
// assumed without points.

struct Site_planes {
  static constexpr std::size_t fewest_planes = 4; // that enclose something

  Site site;
  std::vector<Plane_coverage> planes;
  std::vector<int> groups;  // the coplanar groups of the planes that have points, which come first
  std::vector<int> omitted; // those of further planes, with fewer points
  CGAL::Bbox_3 box;         // of the points, and somewhat around them

  // At most `most` planes that have points.
  Site_planes(const Surface_scene& scene, Site at, std::size_t most, const Model_progress& progress)
    : site(std::move(at))
  {
    add_planes(scene, most);
    if(planes.empty())
      return;
    std::vector<int> plane_of_group(scene.planes.size(), none);
    for(std::size_t p = 0; p < groups.size(); ++p)
      plane_of_group[std::size_t(groups[p])] = int(p);
    std::vector<int> plane_of_shape;
    for(std::size_t s = 0; s < scene.planes.size(); ++s)
      plane_of_shape.push_back(plane_of_group[scene.shapes.coplanar_group(s)]);
    for(std::size_t s = 0; s < scene.planes.size(); ++s)
      if(const int p = plane_of_shape[s]; p != none)
        for(const Indexed_polygon& polygon : scene.polygons.polygons[s])
          for(const auto& t : polygon.triangles)
            if(CGAL::do_overlap(scene.box_of(t), box) && is_above_base(scene, t))
              planes[std::size_t(p)].cover({scene.corner(t[0]), scene.corner(t[1]), scene.corner(t[2])});
    if(site.base)
      add_base(8 * scene.maximum_distance);
    Border_walls walls(planes, site, scene.maximum_distance);
    site.for_each_wall(box.zmax(), [&](const Plane_coverage::Corners& wall) { walls.add_wall(wall); });
    walls.add(scene, plane_of_shape, box, progress);
  }

  // The coplanar group of a plane; none if it has no points, or is a face of the box.
  int group(int plane) const
  {
    return plane >= 0 && std::size_t(plane) < groups.size() ? groups[std::size_t(plane)] : none;
  }

private:
  // What is as low as the base is the ground, which is no part of a surface that has a base.
  bool is_above_base(const Surface_scene& scene, const Point& p) const
  {
    return !site.base || height(site.base_plane(), p) > 2 * scene.maximum_distance;
  }

  bool is_above_base(const Surface_scene& scene, const std::array<std::uint32_t, 3>& triangle) const
  {
    return std::any_of(triangle.begin(), triangle.end(),
                       [&](std::uint32_t corner) { return is_above_base(scene, scene.corner(corner)); });
  }

  void add_planes(const Surface_scene& scene, std::size_t most)
  {
    const std::vector<std::size_t> shape_of_group = scene.shapes.distinct_planes();
    std::vector<std::vector<Point>> of_group(shape_of_group.size());
    for(std::size_t s = 0; s < scene.shapes.number_of_shapes(); ++s)
      for(std::uint32_t i : scene.shapes.points(s))
        if(const Point p = scene.unit.in(scene.points[i]); site.contains(p) && is_above_base(scene, p))
          of_group[scene.shapes.coplanar_group(s)].push_back(p);
    std::vector<std::size_t> order(of_group.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return of_group[a].size() > of_group[b].size(); });
    for(std::size_t g : order) {
      if(of_group[g].empty())
        break;
      Plane_coverage plane(scene.planes[shape_of_group[g]], std::move(of_group[g]));
      if(!plane.has_area())
        continue;
      if(planes.size() == most) {
        omitted.push_back(int(g));
        continue;
      }
      for(const Point& p : plane.points())
        box += p.bbox();
      planes.push_back(std::move(plane));
      groups.push_back(int(g));
    }
    if(!site.footprint.empty() && !planes.empty())
      box += CGAL::Bbox_3(site.box().xmin(), site.box().ymin(), box.zmin(), site.box().xmax(), site.box().ymax(),
                          box.zmax());
    box = outlines::grown(box, 2 * scene.maximum_distance);
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

// Of one site. Planes that are closer than rounding allows may cross where they should meet.
inline void add_triangles(const std::vector<Point>& corners, Surface_table& table)
{
  Checked_triangles checked = checked_triangles(corners, table.faces);
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

// --- The surface of a site

// Planes, and the cells of their box. Of cells that are too many, half of the planes makes fewer.
struct Site_cells {
  Site_planes planes;
  Cells cells;
};

inline Site_cells site_cells(const Surface_scene& scene, const Site& site, std::size_t most_planes,
                             const Model_progress& progress)
{
  constexpr std::size_t most_cells = 400000;
  while(true) {
    Site_planes planes(scene, site, most_planes, progress);
    Cells cells;
    if(planes.planes.size() >= Site_planes::fewest_planes)
      cells = cut_cells(planes.planes, planes.box, most_cells, progress);
    if(cells.cells.size() < most_cells || planes.groups.size() <= Site_planes::fewest_planes)
      return {std::move(planes), std::move(cells)};
    most_planes = (std::max)(Site_planes::fewest_planes, planes.groups.size() / 2);
  }
}

// The stages take these parts of the time from `begin` to `end`.
inline Surface_table surface_of_site(const Surface_scene& scene, const Site& site, const Surface_request& request,
                                     Model_progress& progress, double end)
{
  const double begin = progress.end_of_stage();
  const auto begin_stage = [&](double part) { progress.begin_stage(begin + part * (end - begin)); };
  begin_stage(.1);
  const auto [planes, cells] = site_cells(scene, site, request.most_planes, progress);
  Surface_table result;
  result.groups = planes.groups;
  result.omitted_groups = planes.omitted;
  if(cells.cells.empty())
    return result;
  begin_stage(.7);
  const Inside_cost cost(cells, planes.planes, site, progress);
  begin_stage(.9);
  const Inside_cells inside(cells, cost, progress);
  const std::vector<Face> faces =
    faces_of_components(Boundary_faces(cells, inside).faces(), cost.area, request.most_components);
  begin_stage(1);
  result.number_of_points = number_of_points(cells, faces, planes.planes, progress);
  std::map<int, std::size_t> number;
  std::vector<Point> corners;
  for(const Face& face : faces) {
    result.plane_of_face.push_back(planes.group(face.plane));
    const Areas areas = areas_of(face, cost);
    result.supported_of_face.push_back(areas.scanned / areas.all);
    result.area += areas.all;
    result.supported_area += areas.scanned;
    result.faces.emplace_back();
    for(int v : face.vertices) {
      const auto added = number.emplace(v, corners.size());
      if(added.second)
        corners.push_back(cells.points[std::size_t(v)]);
      result.faces.back().push_back(added.first->second);
    }
  }
  add_triangles(corners, result);
  for(const Point& p : corners)
    result.points.push_back(scene.unit.out(Position{p.x(), p.y(), p.z()}));
  return result;
}

// --- Sites

// The height of the lowest point of a shape that is not farther from a footprint than half of its extent.
inline double ground_near(const Surface_scene& scene, const Site& site)
{
  const CGAL::Bbox_2 box = site.box();
  const double margin = (std::max)(box.x_span(), box.y_span()) / 2;
  double lowest = std::numeric_limits<double>::infinity();
  for(std::size_t s = 0; s < scene.shapes.number_of_shapes(); ++s)
    for(std::uint32_t i : scene.shapes.points(s)) {
      const Point p = scene.unit.in(scene.points[i]);
      if(p.x() >= box.xmin() - margin && p.x() <= box.xmax() + margin && p.y() >= box.ymin() - margin &&
         p.y() <= box.ymax() + margin)
        lowest = (std::min)(lowest, p.z());
    }
  return lowest;
}

// Of the footprints, or one for all.
inline std::vector<Site> sites_of(const Surface_scene& scene, const Surface_request& request)
{
  Site everywhere = {Vector(request.up.x, request.up.y, request.up.z), std::nullopt, {}};
  if(request.base_height)
    everywhere.base = scene.unit.in(*request.base_height);
  if(request.footprints.empty())
    return {everywhere};
  std::vector<Site> sites;
  for(const std::vector<Flat_polygon>& footprint : request.footprints) {
    Site site = everywhere;
    for(const Flat_polygon& ring : footprint) {
      site.footprint.emplace_back();
      for(const Kernel::Point_2& p : ring)
        site.footprint.back().emplace_back(scene.unit.in(p.x()), scene.unit.in(p.y()));
    }
    if(!site.base)
      site.base = ground_near(scene, site);
    sites.push_back(std::move(site));
  }
  return sites;
}

// Surfaces of different sites have no corners in common.
inline void append(const Surface_table& part, Surface_table& whole)
{
  const std::size_t points = whole.points.size(), faces = whole.faces.size();
  const auto add = [](const auto& from, auto& to) { to.insert(to.end(), from.begin(), from.end()); };
  const auto add_from = [](const auto& from, std::size_t first, auto& to) {
    for(auto corners : from) {
      for(std::size_t& corner : corners)
        corner += first;
      to.push_back(std::move(corners));
    }
  };
  add(part.points, whole.points);
  add_from(part.faces, points, whole.faces);
  add_from(part.triangles, points, whole.triangles);
  for(std::size_t face : part.face_of_triangle)
    whole.face_of_triangle.push_back(faces + face);
  add(part.plane_of_face, whole.plane_of_face);
  add(part.supported_of_face, whole.supported_of_face);
  add(part.groups, whole.groups);
  whole.area += part.area;
  whole.supported_area += part.supported_area;
  add(part.omitted_groups, whole.omitted_groups);
  whole.number_of_points += part.number_of_points;
}

// NOLINTNEXTLINE(misc-definitions-in-headers): inline where no library is linked
CGAL_TANDEM_MODELS_INLINE Surface_table surface_table(const std::vector<Position>& points, const Shapes_data& data,
                                                      const Surface_request& request)
try {
  Model_progress progress(request.callback);
  constexpr double outlines_end = .3;
  progress.begin_stage(outlines_end);
  const outlines::Shapes shapes(data);
  const Surface_scene scene(
    points, shapes, request.outlines ? *request.outlines : outlines::outline_table(points, shapes.data(), progress));
  const std::vector<Site> sites = sites_of(scene, request);
  Surface_table result;
  for(std::size_t s = 0; s < sites.size(); ++s)
    append(surface_of_site(scene, sites[s], request, progress,
                           outlines_end + (1 - outlines_end) * double(s + 1) / double(sites.size())),
           result);
  const std::set<int> considered(result.groups.begin(), result.groups.end());
  const std::set<int> omitted(result.omitted_groups.begin(), result.omitted_groups.end());
  result.groups.assign(considered.begin(), considered.end());
  result.omitted_groups.clear();
  std::set_difference(omitted.begin(), omitted.end(), considered.begin(), considered.end(),
                      std::back_inserter(result.omitted_groups));
  return result;
} catch(const Model_progress::Cancelled&) {
  return Surface_table();
}

} // namespace CGAL::Tandem::internal::surface

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SURFACE_TABLE_H
