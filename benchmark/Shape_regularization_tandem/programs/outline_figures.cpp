// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How good the outlines of shapes are: straightened only, regularized by CGAL's regularize_closed_contour(), and those of
// polygons(). For a cloud, or for the house of the generated scenes, whose areas are known.
//   outline_figures CLOUD.ply MAXIMUM_DISTANCE MAXIMUM_ANGLE MINIMUM_REGION_SIZE [FOLDER]
// For the shapes with most points FOLDER gets I.points and I.outline, in the plane of the shape, for gnuplot.
//   outline_figures house [POINTS [NOISE, a fraction of the diagonal]]

#include "clouds/outline_cloud.h"
#include "criteria/contour_regularization.h"
#include "testing/measure.h"

#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_triangulation.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::Tandem::benchmark;
namespace scenes = CGAL::Tandem::scenes;

namespace {

using Outline_areas = CGAL::Tandem::Shape_polygons_3<Outline_kernel>;

struct Outline_figures {
  std::size_t shapes = 0, edges = 0;
  double length = 0, regular_length = 0; // of edges
  std::size_t shared_corners = 0;        // that several shapes have, to the last bit
  std::size_t crossing_loops = 0;        // that are not simple
  std::size_t border_points = 0;
  double sum_of_distances = 0; // of border points, in spacings
};

// All edges of an entry, as segments.
std::vector<Outline_kernel::Segment_3> edges_of(const Outline_areas& areas, std::size_t s)
{
  std::vector<Outline_kernel::Segment_3> result;
  const auto add = [&](const CGAL::Tandem::Indexed_polygon::Loop& loop) {
    for(std::size_t i = 0; i < loop.size(); ++i)
      result.emplace_back(areas.points()[loop[i]], areas.points()[loop[(i + 1) % loop.size()]]);
  };
  for(const CGAL::Tandem::Indexed_polygon& polygon : areas.polygons(s)) {
    add(polygon.outer);
    for(const CGAL::Tandem::Indexed_polygon::Loop& hole : polygon.holes)
      add(hole);
  }
  return result;
}

// Corners as the sources of edges.
void count_shared_corners(const Outline_areas& areas, Outline_figures& f)
{
  std::map<Outline_kernel::Point_3, std::set<std::size_t>> shapes_at;
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s)
    for(const auto& edge : edges_of(areas, s))
      shapes_at[edge.source()].insert(s);
  for(const auto& [p, shapes] : shapes_at)
    f.shared_corners += shapes.size() > 1;
}

void count_crossing_loops(const Outline_areas& areas, Outline_figures& f)
{
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s)
    for(const auto& polygon : areas.polygons_2(s)) {
      f.crossing_loops += !polygon.outer_boundary().is_simple();
      for(const auto& hole : polygon.holes())
        f.crossing_loops += !hole.is_simple();
    }
}

// Whether the edge has the direction of the line with another parallel group, or the one orthogonal to it, up to 1e-9.
bool is_regular(const Outline_shapes& shapes, std::size_t s, const Outline_kernel::Segment_3& edge)
{
  const auto normal_of = [&](std::size_t t) {
    const auto& c = shapes.coefficients(t);
    return Outline_kernel::Vector_3(c[0], c[1], c[2]);
  };
  const Outline_kernel::Vector_3 d = edge.to_vector() / std::sqrt(edge.squared_length());
  for(std::size_t t = 0; t < shapes.number_of_shapes(); ++t) {
    const Outline_kernel::Vector_3 cross = CGAL::cross_product(normal_of(s), normal_of(t));
    const double sine = std::sqrt(cross.squared_length());
    if(sine > 1e-3 &&
       ((std::min)(std::fabs(d * cross), std::sqrt(CGAL::cross_product(d, cross).squared_length())) < 1e-9 * sine))
      return true;
  }
  return false;
}

// The points of the outline without straight borders, and without straightening; each with the spacing there.
std::vector<std::pair<Outline_kernel::Point_3, double>> border_points_of(const Outline_cloud& cloud,
                                                                         const Outline_shapes& shapes, std::size_t s)
{
  namespace outlines = CGAL::Tandem::internal::outlines;
  const outlines::Plane_frame frame(shapes, s, cloud[shapes.points(s)[0]].first);
  std::vector<outlines::Kernel::Point_2> flat;
  for(std::size_t i : shapes.points(s))
    flat.push_back(frame.flat(cloud[i].first));
  std::vector<std::pair<Outline_kernel::Point_3, double>> result;
  for(const outlines::Outline_loop& loop : outlines::Outline_triangulation(flat).outline(outlines::Outline_limits()))
    for(const outlines::Outline_vertex& v : loop)
      result.emplace_back(frame.lifted(v.point), v.spacing);
  return result;
}

Outline_figures figures_of(const Outline_cloud& cloud, const Outline_shapes& shapes, const Outline_areas& areas)
{
  Outline_figures f;
  count_shared_corners(areas, f);
  count_crossing_loops(areas, f);
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    const auto edges = edges_of(areas, s);
    f.shapes += !edges.empty();
    for(const auto& edge : edges) {
      const double length = std::sqrt(edge.squared_length());
      ++f.edges;
      f.length += length;
      f.regular_length += is_regular(shapes, s, edge) ? length : 0;
    }
    for(const auto& [p, spacing] : border_points_of(cloud, shapes, s)) {
      double nearest = HUGE_VAL;
      for(const auto& edge : edges)
        nearest = (std::min)(nearest, CGAL::squared_distance(p, edge));
      if(edges.empty())
        continue;
      ++f.border_points;
      f.sum_of_distances += std::sqrt(nearest) / spacing;
    }
  }
  return f;
}

void print(const std::string& name, const Outline_figures& f, double seconds)
{
  std::cout << name << ": edges a shape " << double(f.edges) / double(f.shapes) << " regular length "
            << f.regular_length / f.length << " mean distance of border points "
            << f.sum_of_distances / double(f.border_points) << " spacings, shared corners " << f.shared_corners
            << " loops that cross themselves " << f.crossing_loops << " seconds " << seconds << "\n";
}

struct Area_errors {
  double truth = 0, missing = 0, surplus = 0;
};

// The face that most points of the shape are of, -1 if none.
int face_of(const scenes::Scene& scene, const Outline_shapes& shapes, std::size_t s)
{
  std::map<int, std::size_t> count;
  for(std::size_t i : shapes.points(s))
    ++count[scene.label[i]];
  return std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
    ->first;
}

// Squares of two centimeters, of each face that has a shape: of its true area and of the polygons of its shapes.
Area_errors errors_of(const scenes::Model& model, const scenes::Scene& scene, const Outline_shapes& shapes,
                      const Outline_areas& areas)
{
  constexpr double width = .02;
  std::map<int, std::vector<std::size_t>> shapes_of;
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    shapes_of[face_of(scene, shapes, s)].push_back(s);
  Area_errors errors;
  for(const auto& [label, members] : shapes_of) {
    if(label < 0)
      continue;
    const scenes::Face& face = model.faces[std::size_t(label)];
    const auto& first = face.triangles[0];
    const scenes::Vec u = scenes::unit(first[1] - first[0]), v = cross(face.normal, u), origin = first[0];
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for(const auto& t : face.triangles)
      for(const scenes::Vec& p : t)
        for(int k = 0; k < 2; ++k) {
          low[k] = (std::min)(low[k], dot(k == 0 ? u : v, p - origin) - .5);
          high[k] = (std::max)(high[k], dot(k == 0 ? u : v, p - origin) + .5);
        }
    std::vector<std::pair<Outline_areas::Frame, std::vector<Outline_areas::Polygon_with_holes_2>>> all;
    for(std::size_t s : members)
      all.emplace_back(areas.frame(s), areas.polygons_2(s));
    for(double x = low[0]; x < high[0]; x += width)
      for(double y = low[1]; y < high[1]; y += width) {
        const scenes::Vec p = add_scaled(add_scaled(origin, x, u), y, v);
        const bool is_true = model.is_on(face, p, 1e-9);
        const bool is_covered = std::any_of(all.begin(), all.end(), [&](const auto& entry) {
          const auto q = entry.first.to_2d(Outline_kernel::Point_3(p.x, p.y, p.z));
          return std::any_of(entry.second.begin(), entry.second.end(), [&](const auto& polygon) {
            return polygon.outer_boundary().has_on_bounded_side(q) &&
                   std::none_of(polygon.holes_begin(), polygon.holes_end(),
                                [&](const auto& hole) { return !hole.has_on_unbounded_side(q); });
          });
        });
        errors.truth += is_true ? width * width : 0;
        errors.missing += is_true && !is_covered ? width * width : 0;
        errors.surplus += !is_true && is_covered ? width * width : 0;
      }
  }
  return errors;
}

using CGAL::Tandem::internal::outlines::outline_table;

// Prints the figures of the outlines that make() returns, and the seconds that it takes.
template <class Make>
Outline_areas measure(const std::string& name, const Cloud_with_shapes& input, Make make)
{
  Meter meter;
  Outline_areas areas = make();
  const double seconds = meter.lap();
  print(name, figures_of(input.cloud, input.shapes, areas), seconds);
  if(!input.scene.points.empty()) {
    const Area_errors errors = errors_of(scenes::make_house(), input.scene, input.shapes, areas);
    std::cout << "  truth " << errors.truth << " missing " << errors.missing / errors.truth << " surplus "
              << errors.surplus / errors.truth << "\n";
  }
  return areas;
}

std::vector<double> border_spacings(const Cloud_with_shapes& input)
{
  std::vector<double> result;
  for(std::size_t s = 0; s < input.shapes.number_of_shapes(); ++s) {
    std::vector<double> all;
    for(const auto& [p, spacing] : border_points_of(input.cloud, input.shapes, s))
      all.push_back(spacing);
    std::nth_element(all.begin(), all.begin() + std::ptrdiff_t(all.size() / 2), all.end());
    result.push_back(all.empty() ? 0 : all[all.size() / 2]);
  }
  return result;
}

Outline_areas measure_all(const Cloud_with_shapes& input)
{
  std::vector<CGAL::Tandem::internal::Position> points;
  for(const auto& item : input.cloud)
    points.push_back({item.first.x(), item.first.y(), item.first.z()});
  const auto draft = [&] { return outline_table(points, input.shapes.data(), false); };
  const std::vector<double> spacing = border_spacings(input);
  measure("straightened", input, [&] { return Outline_areas(draft()); });
  measure("regularize_closed_contour", input,
          [&] { return Outline_areas(regularized_contours(draft(), input.shapes, spacing)); });
  return measure("polygons", input, [&] {
    return CGAL::Tandem::polygons(input.shapes, input.cloud, CGAL::Tandem::parameters::point_map(Outline_point_map()));
  });
}

void write_plots(const std::string& folder, const Outline_cloud& cloud, const Outline_shapes& shapes,
                 const Outline_areas& areas)
{
  constexpr std::size_t largest_number = 12;
  for(std::size_t s = 0; s < shapes.number_of_shapes() && s < largest_number; ++s) {
    const auto& c = shapes.coefficients(s);
    const Outline_kernel::Vector_3 n(c[0], c[1], c[2]);
    const bool is_level = std::fabs(c[2]) > .9;
    const Outline_kernel::Vector_3 across =
      is_level ? Outline_kernel::Vector_3(c[2], 0, -c[0]) : Outline_kernel::Vector_3(-c[1], c[0], 0);
    const Outline_kernel::Vector_3 u = across / std::sqrt(across.squared_length()), v = CGAL::cross_product(n, u);
    const auto write = [&](std::ostream& out, const Outline_kernel::Point_3& p) {
      out << u * (p - CGAL::ORIGIN) << ' ' << v * (p - CGAL::ORIGIN) << '\n';
    };
    std::ofstream points(folder + '/' + std::to_string(s) + ".points"),
      outline(folder + '/' + std::to_string(s) + ".outline");
    for(std::size_t i : shapes.points(s))
      write(points, cloud[i].first);
    for(const auto& edge : edges_of(areas, s)) {
      write(outline, edge.source());
      write(outline, edge.target());
      outline << '\n';
    }
    if(!points || !outline)
      throw std::runtime_error(folder + " cannot be written to");
  }
}

} // namespace

int main(int argc, char** argv)
try {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool has_folder = arguments.size() == 5;
  const std::string folder = has_folder ? arguments.back() : "";
  arguments.resize(has_folder ? 4 : arguments.size());
  const Cloud_with_shapes input = cloud_with_shapes(arguments);
  const Outline_areas areas = measure_all(input);
  if(has_folder)
    write_plots(folder, input.cloud, input.shapes, areas);
  return 0;
} catch(const std::exception& e) {
  std::cerr << "outline_figures: " << e.what() << "\n";
  return 1;
}
