// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The areas that the points of the planes cover, as polygons with common corners, written as a mesh.
//   outline_polygons [CLOUD [maximum_distance]]

#include "house_cloud.h"

#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <cstdio>
#include <fstream>
#include <iomanip>
#include <map>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;
using Loop = CGAL::Tandem::Indexed_polygon::Loop;
namespace np = CGAL::Tandem::parameters;

int main(int argc, char* argv[])
{
  const std::vector<Point_with_normal> points = example_cloud(argc, argv);
  const auto shapes = CGAL::Tandem::detect_planes(
    points, np::point_map(Point_map()).normal_map(Normal_map()).maximum_distance(argc > 2 ? std::stod(argv[2]) : .05));
  const auto areas = CGAL::Tandem::polygons(shapes, points, np::point_map(Point_map()).one_for_each_plane(true));
  std::map<std::uint32_t, int> planes_of_corner;
  std::vector<Loop> faces;
  for(std::size_t i = 0; i < areas.number_of_entries(); ++i) {
    std::size_t holes = 0;
    for(const CGAL::Tandem::Indexed_polygon& polygon : areas.polygons(i)) {
      holes += polygon.holes.size();
      faces.push_back(polygon.outer);
      for(std::uint32_t corner : polygon.outer)
        ++planes_of_corner[corner];
    }
    std::printf("plane %2zu: %.2f square meters, polygons: %zu, holes: %zu\n", i, areas.area(i),
                areas.polygons(i).size(), holes);
  }
  std::map<int, int> count;
  for(const auto& [corner, planes] : planes_of_corner)
    ++count[planes];
  for(const auto& [planes, corners] : count)
    std::printf("corners of %d planes: %d\n", planes, corners);

  std::ofstream out("outline_polygons.off"); // without holes, which OFF does not have
  out << std::setprecision(17) << "OFF\n" << areas.points().size() << ' ' << faces.size() << " 0\n";
  for(const Kernel::Point_3& p : areas.points())
    out << p << '\n';
  for(const Loop& face : faces) {
    out << face.size();
    for(std::uint32_t corner : face)
      out << ' ' << corner;
    out << '\n';
  }
  return out && !faces.empty() ? 0 : 1;
}
