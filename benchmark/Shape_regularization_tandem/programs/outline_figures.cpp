// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many corners outlines share, and how many loops cross themselves: of outlines that CGAL's
// regularize_closed_contour() regularizes, and of those of polygons().
//   outline_figures CLOUD.ply MAXIMUM_DISTANCE MAXIMUM_ANGLE MINIMUM_REGION_SIZE [FOLDER]
//   outline_figures house [POINTS [NOISE, a fraction of the diagonal]]
// For the shapes with most points FOLDER gets I.points and I.outline, in the plane of the shape, for gnuplot.

#include "clouds/outline_cloud.h"
#include "criteria/contour_regularization.h"

#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_triangulation.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

using namespace CGAL::Tandem::benchmark;

namespace {

using Outline_areas = CGAL::Tandem::Shape_polygons_3<Outline_kernel>;

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

// That several shapes have, to the last bit: corners as the sources of edges.
std::size_t number_of_shared_corners(const Outline_areas& areas)
{
  std::map<Outline_kernel::Point_3, std::set<std::size_t>> shapes_at;
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s)
    for(const auto& edge : edges_of(areas, s))
      shapes_at[edge.source()].insert(s);
  return std::size_t(
    std::count_if(shapes_at.begin(), shapes_at.end(), [](const auto& corner) { return corner.second.size() > 1; }));
}

std::size_t number_of_crossing_loops(const Outline_areas& areas)
{
  std::size_t number = 0;
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s)
    for(const auto& polygon : areas.polygons_2(s)) {
      number += !polygon.outer_boundary().is_simple();
      for(const auto& hole : polygon.holes())
        number += !hole.is_simple();
    }
  return number;
}

void print(const std::string& name, const Outline_areas& areas)
{
  std::cout << name << ": shared corners " << number_of_shared_corners(areas) << " loops that cross themselves "
            << number_of_crossing_loops(areas) << "\n";
}

// For each shape the median spacing of the points of its outline without straight borders, and without straightening.
std::vector<double> border_spacings(const Cloud_with_shapes& input)
{
  namespace outlines = CGAL::Tandem::internal::outlines;
  std::vector<double> result;
  for(std::size_t s = 0; s < input.shapes.number_of_shapes(); ++s) {
    const auto points = input.shapes.points(s);
    const outlines::Plane_frame frame(input.shapes, s, input.cloud[points[0]].first);
    std::vector<outlines::Kernel::Point_2> flat;
    for(std::size_t i : points)
      flat.push_back(frame.flat(input.cloud[i].first));
    std::vector<double> all;
    for(const outlines::Outline_loop& loop : outlines::Outline_triangulation(flat).outline(outlines::Outline_limits()))
      for(const outlines::Outline_vertex& v : loop)
        all.push_back(v.spacing);
    std::nth_element(all.begin(), all.begin() + std::ptrdiff_t(all.size() / 2), all.end());
    result.push_back(all.empty() ? 0 : all[all.size() / 2]);
  }
  return result;
}

// Prints the figures of both kinds of outlines. Returns those of polygons().
Outline_areas compare(const Cloud_with_shapes& input)
{
  std::vector<CGAL::Tandem::internal::Position> points;
  for(const auto& item : input.cloud)
    points.push_back({item.first.x(), item.first.y(), item.first.z()});
  const auto draft = CGAL::Tandem::internal::outlines::outline_table(points, input.shapes.data(), false);
  print("regularize_closed_contour", Outline_areas(regularized_contours(draft, input.shapes, border_spacings(input))));
  const Outline_areas areas =
    CGAL::Tandem::polygons(input.shapes, input.cloud, CGAL::Tandem::parameters::point_map(Outline_point_map()));
  print("polygons", areas);
  return areas;
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
  const Outline_areas areas = compare(input);
  if(has_folder)
    write_plots(folder, input.cloud, input.shapes, areas);
  return 0;
} catch(const std::exception& e) {
  std::cerr << "outline_figures: " << e.what() << "\n";
  return 1;
}
