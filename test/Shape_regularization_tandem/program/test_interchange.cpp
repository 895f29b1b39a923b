// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What detect_planes writes for other programs, read back: vertex groups and the areas of
// the shapes. The scene is a wall with a window, a second wall flush with it, and a floor.

#include "program/vg_file.h"
#include "testing/box_cloud.h"

#include "output/writers.h"
#include "output/write_results.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/PLY.h>

#include <limits>
#include <map>

BOOST_AUTO_TEST_SUITE(test_interchange)

using program::Kernel;
using program::Point_set;
using program::Shapes;

constexpr double window[4] = {1.5, 2.5, 1, 2}; // x and z

bool is_in_window(double x, double z) { return x > window[0] && x < window[1] && z > window[2] && z < window[3]; }

// Turned about the z axis, and far from the origin.
Kernel::Point_3 placed(double x, double y, double z)
{
  return Kernel::Point_3(.8 * x - .6 * y + 4.5e5, .6 * x + .8 * y, z);
}

Point_set make_scene(std::size_t bad_points = 0)
{
  Point_set points;
  points.add_normal_map();
  std::mt19937 random(3);
  const auto unit = [&] { return double(random_unit(random)); };
  for(std::size_t i = 0; i < bad_points; ++i)
    points.insert(Kernel::Point_3(std::numeric_limits<double>::quiet_NaN(), 0, 0), Kernel::Vector_3(0, 0, 1));
  for(int i = 0; i < 6000; ++i) {
    const double x = 4 * unit(), z = 3 * unit();
    if(!is_in_window(x, z))
      points.insert(placed(x, .01 * unit(), z), Kernel::Vector_3(1.2, -1.6, 0)); // outward, not unit
    if(i < 1500)
      points.insert(placed(5 + 2 * unit(), .01 * unit(), 1.5 * unit()), Kernel::Vector_3(1.2, -1.6, 0));
    if(i < 5000)
      points.insert(placed(4 * unit(), .1 + 2.5 * unit(), .01 * unit()), Kernel::Vector_3(0, 0, 1));
  }
  return points;
}

Shapes detect(const Point_set& points)
{
  const Shapes shapes =
    CGAL::Tandem::detect_planes(points, CGAL::Tandem::parameters::maximum_distance(.03).minimum_region_size(200));
  CHECK_AT(shapes.number_of_shapes() == 3 && shapes.number_of_coplanar_groups() == 2,
           std::to_string(shapes.number_of_shapes()));
  return shapes;
}

// --- Vertex groups

Vg_file write_and_read_vg(const Point_set& points, const Shapes& shapes)
{
  std::ostringstream out;
  program::write_vg(out, points, shapes);
  return read_vg(out.str());
}

void check_vg(std::size_t skipped, bool by_plane)
{
  const Point_set points = make_scene(skipped);
  const Shapes shapes = by_plane ? program::joined_shapes(points, detect(points)) : detect(points);
  const Vg_file file = write_and_read_vg(points, shapes);
  CHECK(file.points.size() == points.size() - skipped);
  CHECK(file.colors.empty() && file.normals.size() == file.points.size());
  CHECK(file.groups.size() == (by_plane ? 2 : 3));
  std::vector<int> group_of(file.points.size(), -1);
  for(std::size_t g = 0; g < file.groups.size(); ++g)
    for(std::size_t i : file.groups[g].members) {
      CHECK(group_of.at(i) == -1);
      group_of.at(i) = int(g);
    }
  for(std::size_t i = 0; i < file.points.size(); ++i) {
    const Kernel::Point_3& p = points.point(Point_set::Index(i + skipped));
    const auto& q = file.points[i];
    CHECK_AT(p.x() == q[0] && p.y() == q[1] && p.z() == q[2], std::to_string(i)); // to the bit
    const auto& n = file.normals[i];
    CHECK_AT(std::fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 4e-4, std::to_string(i));
    const int s = shapes.shape_index(i + skipped);
    CHECK_AT(group_of[i] == s, std::to_string(i));
    if(s >= 0) {
      const Kernel::Plane_3 plane = shapes.oriented_plane(std::size_t(s));
      const double* c = file.groups[std::size_t(s)].plane;
      CHECK_AT(c[0] == plane.a() && c[1] == plane.b() && c[2] == plane.c() && c[3] == plane.d(), std::to_string(i));
    }
  }
}

// --- Areas

struct Mesh {
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> faces;
};

double area(const Mesh& mesh, const std::vector<std::size_t>& face)
{
  return std::sqrt(CGAL::squared_area(mesh.points[face[0]], mesh.points[face[1]], mesh.points[face[2]]));
}

// Largest possible error of a coordinate, and of the plane equation that it is put into.
constexpr double coordinate_error = 4.5e5 * 1e-16;

// `shape_of` has the shape of each face.
void check_mesh(const Mesh& mesh, const std::vector<int>& shape_of, const Shapes& shapes)
{
  std::vector<double> areas(shapes.number_of_shapes(), 0);
  for(std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const std::size_t s = std::size_t(shape_of.at(f));
    const Kernel::Plane_3 plane = shapes.oriented_plane(s);
    for(std::size_t v : mesh.faces[f])
      CHECK_AT(CGAL::squared_distance(mesh.points.at(v), plane) < 4 * coordinate_error * coordinate_error,
               std::to_string(std::sqrt(CGAL::squared_distance(mesh.points[v], plane)) / coordinate_error));
    const Kernel::Point_3 &p = mesh.points[mesh.faces[f][0]], &q = mesh.points[mesh.faces[f][1]],
                          &r = mesh.points[mesh.faces[f][2]];
    CHECK_AT(CGAL::cross_product(q - p, r - p) * plane.orthogonal_vector() > 0, std::to_string(f));
    areas[s] += area(mesh, mesh.faces[f]);
    const Kernel::Point_3 c = CGAL::centroid(p, q, r);
    const double x = .8 * (c.x() - 4.5e5) + .6 * c.y(), y = .8 * c.y() - .6 * (c.x() - 4.5e5);
    const bool is_deep = is_in_window(x - .15, c.z() - .15) && is_in_window(x + .15, c.z() + .15);
    CHECK_AT(!(y < .05 && is_deep), "a triangle in the window");
  }
  std::sort(areas.begin(), areas.end());
  const double expected[3] = {3, 10, 11}; // the wall beside, the floor, and the wall less its window
  for(int i = 0; i < 3; ++i)
    CHECK_AT(std::fabs(areas[std::size_t(i)] / expected[i] - 1) < .07, std::to_string(areas[std::size_t(i)]));
}

void check_ply(const Point_set& points, const Shapes& shapes)
{
  std::ostringstream out;
  program::write_polygons(out, program::Described_shapes(points, shapes),
                          {".ply", program::Faces_of_file::triangles, ""});
  std::istringstream in(out.str());
  Mesh mesh;
  CHECK(CGAL::IO::read_PLY(in, mesh.points, mesh.faces));
  // The int after three colors is not read by CGAL: a face has 1 + 3 * 4 + 3 + 4 bytes.
  std::vector<int> shape_of;
  const std::string text = out.str();
  for(std::size_t f = 0; f < mesh.faces.size(); ++f) {
    std::int32_t s;
    std::memcpy(&s, text.data() + text.size() - (mesh.faces.size() - f) * 20 + 16, 4);
    shape_of.push_back(s);
  }
  check_mesh(mesh, shape_of, shapes);
}

void check_obj(const Point_set& points, const Shapes& shapes)
{
  std::ostringstream out;
  program::write_polygons(out, program::Described_shapes(points, shapes),
                          {".obj", program::Faces_of_file::triangles, ""});
  std::istringstream in(out.str());
  Mesh mesh;
  CHECK(CGAL::IO::read_OBJ(in, mesh.points, mesh.faces));
  std::vector<int> shape_of;
  int shape = -1;
  std::istringstream lines(out.str());
  for(std::string line; std::getline(lines, line);) {
    if(line.rfind("g shape_", 0) == 0)
      shape = std::stoi(line.substr(8));
    if(line.rfind("f ", 0) == 0)
      shape_of.push_back(shape);
  }
  CHECK(shape_of.size() == mesh.faces.size());
  check_mesh(mesh, shape_of, shapes);
}

// Each edge has one or two triangles: nothing overlaps, and the boundary is made of closed lines.
void check_boundary(const Point_set& points, const Shapes& shapes)
{
  const program::Shape_areas areas = program::areas_of_shapes(points, shapes);
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
    std::map<std::uint32_t, int> balance;
    for(const auto& t : areas.triangles(s))
      for(std::size_t i = 0; i < 3; ++i)
        ++count[{t[i], t[(i + 1) % 3]}];
    int boundary_edges = 0;
    for(const auto& [edge, n] : count) {
      CHECK_AT(n == 1, std::to_string(edge.first));
      if(count.count({edge.second, edge.first}) == 0) {
        ++boundary_edges;
        ++balance[edge.first];
        --balance[edge.second];
      }
    }
    for(const auto& [vertex, b] : balance)
      CHECK_AT(b == 0, std::to_string(vertex));
    // Straightened: a point about every 5 cm would have made some 300 edges.
    CHECK_AT(boundary_edges >= 4 && boundary_edges < 160, std::to_string(boundary_edges));
  }
}

// --- Points of a lattice, far from the origin

// Rounded coordinates put the points of a border next to their line, so that the triangulation has slivers there.
void check_lattice(int run)
{
  std::mt19937 random(run);
  std::normal_distribution<double> gauss(0, 1);
  const auto direction = [&] { return Kernel::Vector_3{gauss(random), gauss(random), gauss(random)}; };
  const auto unit = [](const Kernel::Vector_3& v) { return v / std::sqrt(v.squared_length()); };
  const Kernel::Vector_3 normal = unit(direction());
  const Kernel::Vector_3 u = unit(CGAL::cross_product(normal, direction()));
  const Kernel::Vector_3 v = CGAL::cross_product(normal, u);
  constexpr int side = 16;
  const double spacing = run % 2 ? .1 : .125;
  const Kernel::Point_3 corner = CGAL::ORIGIN + (run % 3) * 1e5 * direction();
  Point_set points;
  points.add_normal_map();
  for(int i = 0; i < side; ++i)
    for(int j = 0; j < side; ++j)
      points.insert(corner + (i * spacing) * u + (j * spacing) * v, normal);
  const Shapes shapes =
    CGAL::Tandem::detect_planes(points, CGAL::Tandem::parameters::maximum_distance(.01).minimum_region_size(100));
  CHECK_AT(shapes.number_of_shapes() == 1, std::to_string(run));
  const double covered = program::areas_of_shapes(points, shapes).area(0);
  const double length = (side - 1) * spacing;
  CHECK_AT(std::fabs(covered / (length * length) - 1) < 1e-6, std::to_string(run) + ": " + std::to_string(covered));
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  for(int run = 0; run < 300; ++run)
    check_lattice(run);
  for(bool by_plane : {false, true}) {
    check_vg(0, by_plane);
    check_vg(1, by_plane);
  }
  const Point_set points = make_scene();
  const Shapes shapes = detect(points);
  check_ply(points, shapes);
  check_obj(points, shapes);
  check_boundary(points, shapes);
}

BOOST_AUTO_TEST_SUITE_END()
