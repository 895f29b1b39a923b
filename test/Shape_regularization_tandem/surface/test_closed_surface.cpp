// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// closed_surface(): closed two-manifolds, the same in every unit and order, and what it refuses. The volumes of sparse
// scans of solids, and of houses of airborne scans, whose walls have no points.

#include "testing/property_case.h"

#include <CGAL/Shape_regularization_tandem/closed_surface.h>

#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <random>

BOOST_AUTO_TEST_SUITE(test_closed_surface)

namespace np = CGAL::Tandem::parameters;
using Surface = CGAL::Tandem::Closed_surface_3<Epick>;
using Found_shapes = CGAL::Tandem::Planar_shapes_3<Epick>;

// The volume, of a surface that is closed, oriented outward, a two-manifold, and does not cut itself.
double checked_volume(const Surface& surface, const std::string& name)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  CHECK_AT(surface.plane_of_face.size() == surface.faces.size(), name);
  CHECK_AT(PMP::is_polygon_soup_a_polygon_mesh(surface.faces), name + ": no two-manifold");
  CGAL::Surface_mesh<Epick::Point_3> mesh;
  std::vector<Epick::Point_3> points; // about the origin, as volumes are summed from there
  for(const Epick::Point_3& p : surface.points)
    points.push_back(CGAL::ORIGIN + (p - surface.points.front()));
  PMP::polygon_soup_to_polygon_mesh(points, surface.triangles, mesh);
  CHECK_AT(CGAL::is_closed(mesh), name + ": not closed");
  CHECK_AT(std::is_sorted(surface.face_of_triangle.begin(), surface.face_of_triangle.end()), name);
  std::vector<std::size_t> sizes(surface.faces.size(), 2);
  for(std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& face = surface.faces[surface.face_of_triangle[t]];
    ++sizes[surface.face_of_triangle[t]];
    for(std::size_t corner : surface.triangles[t])
      CHECK_AT(std::count(face.begin(), face.end(), corner) == 1, name + ": a triangle with a corner of another face");
  }
  for(std::size_t f = 0; f < surface.faces.size(); ++f)
    CHECK_AT(sizes[f] == surface.faces[f].size(), name + ": a face with too few or too many triangles");
  CHECK_AT(!PMP::does_self_intersect(mesh), name + ": cuts itself");
  for(const auto& face : surface.faces)
    for(std::size_t i = 0; i < face.size(); ++i)
      CHECK_AT(surface.points[face[i]] != surface.points[face[(i + 1) % face.size()]], name + ": an edge of no length");
  const double volume = surface.is_empty() ? 0 : PMP::volume(mesh);
  CHECK_AT(volume > 0 || surface.is_empty(), name + ": the volume is " + std::to_string(volume));
  return volume;
}

template <class Kernel>
CGAL::Tandem::Closed_surface_3<Kernel> surface_of_box(double scale)
{
  Pairs<Kernel> cloud = make_pairs<Kernel>(make_box_cloud(400));
  for(auto& item : cloud)
    item.first = item.first.transform(CGAL::Aff_transformation_3<Kernel>(CGAL::SCALING, typename Kernel::FT(scale)));
  const auto list = np::point_map(First<Kernel>());
  const auto shapes = CGAL::Tandem::detect_planes(
    cloud, list.normal_map(Second<Kernel>()).maximum_distance(.02 * scale).minimum_region_size(50));
  return CGAL::Tandem::closed_surface(shapes, cloud, list);
}

// Six faces in every kernel and in every unit.
BOOST_AUTO_TEST_CASE(six_faces)
{
  const Surface box = surface_of_box<Epick>(1);
  CHECK(box.points.size() == 8 && box.faces.size() == 6 && box.number_of_planes == 6);
  checked_volume(box, "box");
  for(const double scale : {std::ldexp(1, -300), std::ldexp(1, 300)}) {
    const Surface other = surface_of_box<Epick>(scale);
    CHECK(other.faces == box.faces);
    for(std::size_t i = 0; i < box.points.size() && i < other.points.size(); ++i)
      CHECK(other.points[i].x() == scale * box.points[i].x() && other.points[i].z() == scale * box.points[i].z());
  }
  CHECK(surface_of_box<CGAL::Simple_cartesian<float>>(1).faces.size() == 6);
}

BOOST_AUTO_TEST_CASE(refusals)
{
  const Pairs<Epick> cloud = make_pairs<Epick>(make_box_cloud(100));
  const auto list = np::point_map(First<Epick>());
  const Found_shapes shapes =
    CGAL::Tandem::detect_planes(cloud, list.normal_map(Second<Epick>()).maximum_distance(.02).minimum_region_size(50));
  const auto check_refused = [](auto f, const char* why) { check_throws<std::invalid_argument>(f, {why}, __LINE__); };
  check_refused([&] { CGAL::Tandem::closed_surface(shapes, Pairs<Epick>(), list); }, "0 points");
  check_refused([&] { CGAL::Tandem::closed_surface(shapes, cloud, list.maximum_number_of_planes(3)); }, "at least 4");
  check_refused([&] { CGAL::Tandem::closed_surface(shapes, cloud, list.symmetry_direction(Epick::Vector_3(0, 0, 0))); },
                "symmetry_direction");
  const Surface part = CGAL::Tandem::closed_surface(shapes, cloud, list.maximum_number_of_planes(4));
  CHECK(part.number_of_planes == 4);
  checked_volume(part, "four planes");
  CHECK(CGAL::Tandem::closed_surface(Found_shapes(), std::vector<Epick::Point_3>()).is_empty());
}

// Whatever the points are, it ends and is closed.
BOOST_AUTO_TEST_CASE(random_scenes)
{
  int enclosed = 0;
  on_random_cases(1, 20, [&](const Property_case& c) {
    std::vector<Epick::Point_3> points;
    for(std::size_t i = 0; i < c.cloud.size() && i < 20000; ++i)
      points.emplace_back(c.cloud[i].first.x(), c.cloud[i].first.y(), c.cloud[i].first.z());
    const Found_shapes shapes = CGAL::Tandem::detect_planes(points, np::settings(c.parameters));
    const Surface surface = CGAL::Tandem::closed_surface(shapes, points, np::maximum_number_of_planes(40));
    enclosed += checked_volume(surface, c.name) > 0;
    for(const Epick::Point_3& p : surface.points)
      CHECK_AT(std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()), c.name);
  });
  CHECK_AT(enclosed > 0, "random scenes enclose nothing");
}

// The sides of a prism over an L, or of a house with a roof of two or, if it is hipped, four sides.
using Side = std::vector<Epick::Point_3>; // convex

std::vector<Side> sides_of_solid(unsigned kind, double& volume)
{
  using P = Epick::Point_3;
  if(kind == 0) {
    volume = 3;
    return {{P(0, 0, 0), P(2, 0, 0), P(2, 1, 0), P(0, 1, 0)}, {P(0, 1, 0), P(1, 1, 0), P(1, 2, 0), P(0, 2, 0)},
            {P(0, 0, 1), P(2, 0, 1), P(2, 1, 1), P(0, 1, 1)}, {P(0, 1, 1), P(1, 1, 1), P(1, 2, 1), P(0, 2, 1)},
            {P(0, 0, 0), P(2, 0, 0), P(2, 0, 1), P(0, 0, 1)}, {P(2, 0, 0), P(2, 1, 0), P(2, 1, 1), P(2, 0, 1)},
            {P(2, 1, 0), P(1, 1, 0), P(1, 1, 1), P(2, 1, 1)}, {P(1, 1, 0), P(1, 2, 0), P(1, 2, 1), P(1, 1, 1)},
            {P(1, 2, 0), P(0, 2, 0), P(0, 2, 1), P(1, 2, 1)}, {P(0, 2, 0), P(0, 0, 0), P(0, 0, 1), P(0, 2, 1)}};
  }
  const double d = kind == 1 ? 0 : .75; // of the ends of the ridge from the walls
  const P a(0, 0, 1), b(1.5, 0, 1), c(1.5, 2, 1), e(0, 2, 1), m(.75, d, 1.75), n(.75, 2 - d, 1.75);
  volume = kind == 1 ? 1.5 * 2 * 1.375 : 1.5 * 2 + .75 * 1.5 * ((2 - 2 * d) / 2 + 2 * d / 3);
  std::vector<Side> result = {{a, m, n, e}, {b, c, n, m}, {a, b, m}, {c, e, n}};
  const Side base = {P(0, 0, 0), P(1.5, 0, 0), P(1.5, 2, 0), P(0, 2, 0)}, eaves = {a, b, c, e};
  result.push_back(base);
  for(std::size_t i = 0; i < 4; ++i)
    result.push_back({base[i], base[(i + 1) % 4], eaves[(i + 1) % 4], eaves[i]});
  return result;
}

// Evenly by area, with some noise; turned.
std::vector<Epick::Point_3> scan_of(const std::vector<Side>& sides, unsigned seed)
{
  std::mt19937 random(seed);
  const auto uniform = [&] { return double(random()) / 4294967296.; };
  const double angle = 3 * uniform(), c = std::cos(angle), s = std::sin(angle);
  std::vector<Epick::Point_3> result;
  for(const Side& side : sides)
    for(std::size_t i = 2; i < side.size(); ++i) {
      const Epick::Vector_3 u = side[i - 1] - side[0], v = side[i] - side[0], normal = CGAL::cross_product(u, v);
      const double length = std::sqrt(normal.squared_length());
      for(int n = int(70 * length + uniform()); n > 0; --n) {
        double x = uniform(), y = uniform();
        if(x + y > 1) {
          x = 1 - x;
          y = 1 - y;
        }
        const Epick::Point_3 p = side[0] + x * u + y * v + .008 * (uniform() - .5) / length * normal;
        result.emplace_back(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z());
      }
    }
  return result;
}

// Sparse scans of solids have their volumes, whatever the order of the points is, bit for bit.
BOOST_AUTO_TEST_CASE(volumes)
{
  for(unsigned seed = 1; seed <= 5; ++seed)
    for(unsigned kind = 0; kind < 3; ++kind) {
      const std::string name = "solid " + std::to_string(kind) + ", seed " + std::to_string(seed);
      double volume = 0;
      std::vector<Epick::Point_3> points = scan_of(sides_of_solid(kind, volume), seed);
      const auto surface_of = [&] {
        return CGAL::Tandem::closed_surface(
          CGAL::Tandem::detect_planes(points, np::maximum_distance(.012).minimum_region_size(15)), points);
      };
      const Surface surface = surface_of();
      check_close(checked_volume(surface, name) / volume, 1, .01, name);
      CHECK_AT(surface.supported_of_face.size() == surface.faces.size(), name);
      for(const double share : surface.supported_of_face)
        CHECK_AT(share >= 0 && share <= 1, name);
      std::shuffle(points.begin(), points.end(), std::mt19937(seed));
      const Surface other = surface_of();
      CHECK_AT(other.points == surface.points && other.faces == surface.faces &&
                 other.plane_of_face == surface.plane_of_face && other.supported_of_face == surface.supported_of_face,
               name + ": another surface after a permutation");
    }
}

// Two boxes, a small one of which is a component of its own.
BOOST_AUTO_TEST_CASE(components)
{
  double volume = 0;
  std::vector<Epick::Point_3> points;
  for(const Epick::Point_3& p : scan_of(sides_of_solid(0, volume), 1))
    points.emplace_back(20 * p.x(), 20 * p.y(), 20 * p.z());
  const std::size_t large = points.size();
  for(const auto& item : make_pairs<Epick>(make_box_cloud(400)))
    points.push_back(item.first + Epick::Vector_3(60, 0, 0));
  CHECK(points.size() > large);
  const Found_shapes shapes = CGAL::Tandem::detect_planes(points, np::maximum_distance(.24).minimum_region_size(15));
  const double whole = checked_volume(CGAL::Tandem::closed_surface(shapes, points), "whole");
  const double all =
    checked_volume(CGAL::Tandem::closed_surface(shapes, points, np::maximum_number_of_components(10)), "all");
  check_close(whole / (8000 * volume), 1, .01, "the large one");
  CHECK(all > whole);
  check_throws<std::invalid_argument>(
    [&] { CGAL::Tandem::closed_surface(shapes, points, np::maximum_number_of_components(-1)); }, {"at least 0"},
    __LINE__);
}

// Points every .2 on a parallelogram, with some noise upward.
void add_area(std::vector<Epick::Point_3>& points, const Epick::Point_3& corner, const Epick::Vector_3& u,
              const Epick::Vector_3& v)
{
  static std::mt19937 random(1);
  const int m = int(std::sqrt(u.squared_length()) / .2), n = int(std::sqrt(v.squared_length()) / .2);
  for(int i = 0; i < m; ++i)
    for(int j = 0; j < n; ++j) {
      const Epick::Vector_3 noise(0, 0, .04 * (double(random()) / 4294967296. - .5));
      points.push_back(corner + (i + .5) / m * u + (j + .5) / n * v + noise);
    }
}

// Of roofs and the ground around them, as an airborne scanner sees them: walls and floors have no points.
void add_gable(std::vector<Epick::Point_3>& points, double x, double eaves, double ridge)
{
  add_area(points, Epick::Point_3(x, 0, eaves), Epick::Vector_3(10, 0, 0), Epick::Vector_3(0, 4, ridge - eaves));
  add_area(points, Epick::Point_3(x, 4, ridge), Epick::Vector_3(10, 0, 0), Epick::Vector_3(0, 4, eaves - ridge));
}

std::vector<Epick::Point_3> airborne_scan(double angle, int houses)
{
  std::vector<Epick::Point_3> points, result;
  for(double y : {-10., 8.})
    add_area(points, Epick::Point_3(-10, y, 0), Epick::Vector_3(10 + 20. * houses, 0, 0), Epick::Vector_3(0, 10, 0));
  for(int i = 0; i <= houses; ++i)
    add_area(points, Epick::Point_3(20. * i - 10, 0, 0), Epick::Vector_3(10, 0, 0), Epick::Vector_3(0, 8, 0));
  add_gable(points, 0, 6, 9);
  if(houses > 1)
    add_gable(points, 20, 5, 8.5);
  if(houses > 2)
    add_area(points, Epick::Point_3(40, 0, 12), Epick::Vector_3(10, 0, 0), Epick::Vector_3(0, 8, 0));
  const double c = std::cos(angle), s = std::sin(angle);
  for(const Epick::Point_3& p : points)
    result.emplace_back(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z());
  return result;
}

void check_airborne_volume(const std::vector<Epick::Point_3>& points, const Epick::Vector_3& up, double truth)
{
  const Found_shapes shapes = CGAL::Tandem::detect_planes(points, np::maximum_distance(.08).minimum_region_size(100));
  const Surface surface = CGAL::Tandem::closed_surface(shapes, points, np::symmetry_direction(up));
  CHECK(surface.number_of_points > 1000 && surface.number_of_points < points.size());
  check_close(checked_volume(surface, "airborne scan") / truth, 1, .05, "volume of the houses");
}

// Houses of 600, 540 and 960, in any direction.
BOOST_AUTO_TEST_CASE(airborne_scans)
{
  const double volumes[] = {600, 1140, 2100};
  for(const double angle : {0., .1, .5, 1.})
    for(int houses = angle == 0 ? 1 : 2; houses <= 3; ++houses)
      check_airborne_volume(airborne_scan(angle, houses), Epick::Vector_3(0, 0, 1), volumes[houses - 1]);
  std::vector<Epick::Point_3> turned; // about the x axis
  for(const Epick::Point_3& p : airborne_scan(.5, 3))
    turned.emplace_back(p.x(), p.z(), -p.y());
  check_airborne_volume(turned, Epick::Vector_3(0, 2, 0), volumes[2]);
}

// Below a carport, whose floor was scanned, are no walls.
BOOST_AUTO_TEST_CASE(carport)
{
  std::vector<Epick::Point_3> points;
  add_area(points, Epick::Point_3(-10, -10, 0), Epick::Vector_3(30, 0, 0), Epick::Vector_3(0, 30, 0));
  add_area(points, Epick::Point_3(0, 0, 3), Epick::Vector_3(6, 0, 0), Epick::Vector_3(0, 5, 1));
  add_area(points, Epick::Point_3(0, 5, 4), Epick::Vector_3(6, 0, 0), Epick::Vector_3(0, 5, -1));
  const Found_shapes shapes = CGAL::Tandem::detect_planes(points, np::maximum_distance(.08).minimum_region_size(100));
  CHECK(shapes.number_of_shapes() == 3);
  CHECK(CGAL::Tandem::closed_surface(shapes, points).is_empty());
}

// Roofs of two houses, of 600 and 540, one of which is cut in two: neither walls nor the ground have points.
struct Roofs {
  std::vector<Epick::Point_3> points;
  Found_shapes shapes;

  Roofs()
  {
    add_gable(points, 0, 6, 9);
    add_gable(points, 20, 5, 8.5);
    shapes = CGAL::Tandem::detect_planes(points, np::maximum_distance(.08).minimum_region_size(100));
  }

  template <class Parameters>
  double volume(const Parameters& parameters) const
  {
    return checked_volume(CGAL::Tandem::closed_surface(shapes, points, parameters), "roofs");
  }
};

using Footprint = CGAL::Polygon_with_holes_2<Epick>;

Footprint rectangle(double x, double y, double right, double back)
{
  const std::vector<Epick::Point_2> corners = {{x, y}, {right, y}, {right, back}, {x, back}};
  return Footprint(CGAL::Polygon_2<Epick>(corners.begin(), corners.end()));
}

BOOST_AUTO_TEST_CASE(base)
{
  const Roofs roofs;
  check_close(roofs.volume(np::base_height(0.)) / 1140, 1, .05, "down to 0");
  check_close(roofs.volume(np::base_height(-2.)) / 1460, 1, .05, "down to -2");
  check_throws<std::invalid_argument>([&] { roofs.volume(np::base_height(std::nan(""))); }, {"base_height"}, __LINE__);
  const auto areas = CGAL::Tandem::polygons(roofs.shapes, roofs.points);
  const Surface of_areas = CGAL::Tandem::closed_surface(roofs.shapes, roofs.points, areas, np::base_height(0.));
  CHECK(of_areas.points == CGAL::Tandem::closed_surface(roofs.shapes, roofs.points, np::base_height(0.)).points);
  check_throws<std::invalid_argument>(
    [&] { CGAL::Tandem::closed_surface(roofs.shapes, roofs.points, CGAL::Tandem::Shape_polygons_3<Epick>()); },
    {"entr"}, __LINE__);
  const std::vector<Epick::Point_3> with_ground = airborne_scan(.5, 2);
  const Found_shapes shapes =
    CGAL::Tandem::detect_planes(with_ground, np::maximum_distance(.08).minimum_region_size(100));
  const double volume =
    checked_volume(CGAL::Tandem::closed_surface(shapes, with_ground, np::base_height(3.)), "above the ground");
  check_close(volume / (1140 - 2 * 80 * 3), 1, .05, "above the ground");
}

// One solid for each: the second footprint has a courtyard, the others are parts of a house, side by side, and a field.
BOOST_AUTO_TEST_CASE(footprints)
{
  const Roofs roofs;
  std::vector<Footprint> footprints = {rectangle(0, 0, 4, 8), rectangle(20, 0, 30, 8), rectangle(4, 0, 10, 8),
                                       rectangle(50, 0, 60, 8)};
  const Footprint court = rectangle(23, 3, 27, 5);
  footprints[1].add_hole(CGAL::Polygon_2<Epick>(court.outer_boundary()));
  const Surface surface =
    CGAL::Tandem::closed_surface(roofs.shapes, roofs.points, np::footprints(footprints).base_height(0.));
  double sum = 0;
  for(std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    sum +=
      CGAL::volume(CGAL::ORIGIN + Epick::Vector_3(0, 0, 0), surface.points[a], surface.points[b], surface.points[c]);
  }
  check_close(sum / (1140 - 8 * 8.06), 1, .02, "the volume of all");
  CHECK(surface.number_of_planes == 4);
  footprints.resize(2);
  checked_volume(CGAL::Tandem::closed_surface(roofs.shapes, roofs.points, np::footprints(footprints)), "apart");
  // Without a base, down to the lowest point near, which is that of the eaves.
  CHECK(roofs.volume(np::footprints(std::vector<Footprint>(1, footprints[0]))) < 4 * 8 * 3);
  check_throws<std::invalid_argument>(
    [&] { roofs.volume(np::footprints(footprints).symmetry_direction(Epick::Vector_3(0, 1, 0))); }, {"footprint", "z"},
    __LINE__);
  const std::vector<Epick::Point_2> bow = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
  check_throws<std::invalid_argument>(
    [&] {
      roofs.volume(
        np::footprints(std::vector<Footprint>(1, Footprint(CGAL::Polygon_2<Epick>(bow.begin(), bow.end())))));
    },
    {"footprints", "three corners"}, __LINE__);
}

// The progress rises to 1; it ends where the callback says so, with an empty surface, or throws.
BOOST_AUTO_TEST_CASE(progress)
{
  const Roofs roofs;
  const auto list = np::base_height(0.);
  std::vector<double> seen;
  const auto callback = [&](double progress) {
    seen.push_back(progress);
    return true;
  };
  const double volume = roofs.volume(list.callback(callback));
  CHECK(volume == roofs.volume(list) && seen.size() > 20);
  CHECK(std::is_sorted(seen.begin(), seen.end()) && seen.front() >= 0 && seen.back() > .9 && seen.back() <= 1);
  for(const double end : {0., .3, .5, .8, .9}) {
    double last = 0;
    const auto cancel = [&](double progress) {
      last = progress;
      return progress < end;
    };
    CHECK(CGAL::Tandem::closed_surface(roofs.shapes, roofs.points, list.callback(cancel)).is_empty());
    CHECK(last >= end);
  }
  const auto fail = [](double) -> bool { throw std::range_error("by the callback"); };
  check_throws<std::range_error>([&] { roofs.volume(list.callback(fail)); }, {"by the callback"}, __LINE__);
}

BOOST_AUTO_TEST_SUITE_END()
