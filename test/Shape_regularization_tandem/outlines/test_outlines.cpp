// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Outlines of a facade: straight edges that are parallel or orthogonal to lines with other planes, windows that are
// rectangles, and a round hole that is none. Of shapes to which no other plane gives a direction: squares have four
// corners, also those of parallel planes. Of points that are there many times, exactly or nearly,
// and of points in another order.

#include "testing/test_support.h"

#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_outlines)

using Areas = CGAL::Tandem::Shape_polygons_3<Kernel>;
using CGAL::Tandem::Indexed_polygon;
using scenes::Vec;

Areas areas_of(const Shapes& shapes, const Cloud& cloud)
{
  return CGAL::Tandem::polygons(shapes, cloud, CGAL::Tandem::parameters::point_map(First<Kernel>()));
}

std::vector<Kernel::Vector_3> edges_of(const Areas& areas, const Indexed_polygon::Loop& loop)
{
  std::vector<Kernel::Vector_3> result;
  for(std::size_t i = 0; i < loop.size(); ++i)
    result.push_back(areas.points()[loop[(i + 1) % loop.size()]] - areas.points()[loop[i]]);
  return result;
}

// The sine of the angle to a direction, or to one that is orthogonal to it, whichever is nearer.
double sine_to(const Kernel::Vector_3& a, const Kernel::Vector_3& b)
{
  const double product = std::sqrt(a.squared_length() * b.squared_length());
  return (std::min)(std::fabs(a * b), std::sqrt(CGAL::cross_product(a, b).squared_length())) / product;
}

// --- A facade

// Windows of 1.2 x 1.4 with these corners, and a round one.
constexpr double corners[][2] = {{1, 1}, {3.4, 1}, {1, 3.2}, {3.4, 3.2}}, radius = .8;

bool is_window(double x, double z)
{
  const auto has = [&](const double(&c)[2]) { return x > c[0] && x < c[0] + 1.2 && z > c[1] && z < c[1] + 1.4; };
  return std::any_of(std::begin(corners), std::end(corners), has) || std::hypot(x - 6.5, z - 2.5) < radius;
}

// A gable wall of 8 x 5 whose ridge is at 7, without a floor; a wall at its side, and the two slopes of the roof. All
// is turned, so that nothing is parallel to an axis, and far from the origin.
Cloud make_facade(double points_a_square_meter)
{
  scenes::Random random{11};
  const scenes::Frame frame = scenes::Frame().turned({.3, .4, 1}, .2).at({4.5e5, 0, 0});
  Cloud cloud;
  const auto place = [&](double length) { return length * random.uniform(); };
  const auto noise = [&] { return .004 * random.gaussian(); };
  const auto height_at = [](double x) { return 5 + .5 * (4 - std::fabs(x - 4)); };
  const auto put = [&](const Vec& p, const Vec& n) { add(cloud, frame.point(p), frame.vector(n)); };
  for(double i = 0; i < 56 * points_a_square_meter; ++i) {
    const double x = place(8), z = place(7);
    if(z < height_at(x) && !is_window(x, z))
      put({x, noise(), z}, {0, -1, 0});
  }
  for(double i = 0; i < 30 * points_a_square_meter; ++i)
    put({noise(), place(6), place(5)}, {-1, 0, 0});
  for(double i = 0; i < 48 * points_a_square_meter; ++i) {
    const double x = place(8), y = place(6);
    put({x, y, height_at(x) + noise()}, unit(Vec{x < 4 ? -1. : 1., 0, 2}));
  }
  return cloud;
}

// The sine of the angle to the nearest of the directions that other shapes give, and of those orthogonal to them.
double sine_to_relations(const Shapes& shapes, std::size_t s, const Kernel::Vector_3& edge)
{
  double smallest = 1;
  for(std::size_t t = 0; t < shapes.number_of_shapes(); ++t) {
    const Kernel::Vector_3 line =
      CGAL::cross_product(shapes.plane(s).orthogonal_vector(), shapes.plane(t).orthogonal_vector());
    if(line.squared_length() > .01)
      smallest = (std::min)(smallest, sine_to(line, edge));
  }
  return smallest;
}

// Rectangles of about the size of a window, and the rest.
void check_holes(const Shapes& shapes, const Areas& areas, std::size_t s, double spacing)
{
  const Indexed_polygon& polygon = areas.polygons(s).at(0);
  CHECK_AT(polygon.holes.size() == 5, std::to_string(polygon.holes.size()));
  std::size_t rectangles = 0;
  for(const Indexed_polygon::Loop& hole : polygon.holes) {
    if(hole.size() != 4) {
      CHECK_AT(hole.size() > 5, std::to_string(hole.size())); // the round one
      continue;
    }
    ++rectangles;
    std::vector<double> sizes;
    for(const Kernel::Vector_3& edge : edges_of(areas, hole)) {
      CHECK_AT(sine_to_relations(shapes, s, edge) < 1e-9, std::to_string(sine_to_relations(shapes, s, edge)));
      sizes.push_back(std::sqrt(edge.squared_length()));
    }
    check_close((std::min)(sizes[0], sizes[1]), 1.2, 2 * spacing, "width");
    check_close((std::max)(sizes[0], sizes[1]), 1.4, 2 * spacing, "height");
  }
  CHECK_AT(rectangles == 4, std::to_string(rectangles));
}

// Bottom, right, two slopes, left: straight, up to a short edge or two at corners.
void check_wall(const Shapes& shapes, const Areas& areas, std::size_t s)
{
  CHECK_AT(areas.polygons(s).size() == 1, std::to_string(areas.polygons(s).size()));
  const Indexed_polygon::Loop& outer = areas.polygons(s).at(0).outer;
  CHECK_AT(outer.size() >= 5 && outer.size() <= 7, std::to_string(outer.size()));
  double regular = 0, length = 0;
  for(const Kernel::Vector_3& edge : edges_of(areas, outer)) {
    const double of_edge = std::sqrt(edge.squared_length());
    length += of_edge;
    regular += sine_to_relations(shapes, s, edge) < 1e-9 ? of_edge : 0;
  }
  CHECK_AT(regular > .97 * length, std::to_string(regular / length));
  check_close(areas.area(s) / (48 - 4 * 1.2 * 1.4 - CGAL_PI * radius * radius), 1, .04, "area");
  const auto& c = shapes.coefficients(s);
  for(std::uint32_t v : outer) {
    const Kernel::Point_3& p = areas.points()[v];
    check_close(std::fma(c[0], p.x(), std::fma(c[1], p.y(), std::fma(c[2], p.z(), c[3]))), 0, 2e-10, "height");
  }
}

BOOST_AUTO_TEST_CASE(facade)
{
  for(const double density : {200., 500.}) {
    const Cloud cloud = make_facade(density);
    const Shapes shapes = detect(cloud, make_parameters(.02, 200));
    CHECK_AT(shapes.number_of_shapes() == 4, std::to_string(shapes.number_of_shapes()));
    const Areas areas = areas_of(shapes, cloud);
    std::size_t walls = 0;
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      if(!areas.polygons(s).empty() && !areas.polygons(s)[0].holes.empty()) {
        ++walls;
        check_holes(shapes, areas, s, 1 / std::sqrt(density));
        check_wall(shapes, areas, s);
      }
    CHECK(walls == 1);
  }
}

// --- Shapes without directions of others

// Turned about the vertical axis.
void add_square(Cloud& cloud, const Vec& corner, double width, double angle)
{
  scenes::Random random{11};
  const double c = std::cos(angle), s = std::sin(angle);
  for(double i = 0; i < 100 * width * width; ++i) {
    const double u = width * random.uniform(), v = width * random.uniform();
    add(cloud, corner + Vec{c * u - s * v, s * u + c * v, .005 * random.gaussian()}, {0, 0, 1});
  }
}

Areas areas_of(const Cloud& cloud) { return areas_of(detect(cloud, make_parameters(.03, 200)), cloud); }

std::vector<Kernel::Vector_3> edges_of(const Areas& areas, std::size_t s)
{
  CHECK_AT(areas.polygons(s).size() == 1, std::to_string(areas.polygons(s).size()));
  return edges_of(areas, areas.polygons(s).at(0).outer);
}

BOOST_AUTO_TEST_CASE(squares)
{
  struct Second {
    double width, x, turn; // no width: there is none
  };
  for(double angle : {0., .2, .7})
    for(const Second& second : {Second{0, 0, 0}, Second{8, 20, 0}, Second{8, 30, .5}}) {
      Cloud cloud;
      add_square(cloud, {0, 0, 0}, 10, angle);
      add_square(cloud, {second.x, 0, 3}, second.width, angle + second.turn);
      const Areas areas = areas_of(cloud);
      CHECK(areas.number_of_entries() == (second.width > 0 ? 2 : 1));
      double sum = 0;
      for(std::size_t s = 0; s < areas.number_of_entries(); ++s) {
        sum += areas.area(s);
        const auto edges = edges_of(areas, s);
        CHECK_AT(edges.size() == 4, std::to_string(edges.size()));
        for(const Kernel::Vector_3& e : edges) // squares that are not turned have one direction
          CHECK(sine_to(e, edges_of(areas, second.turn == 0 ? 0 : s)[0]) < 1e-9);
      }
      check_close(sum / (100 + second.width * second.width), 1, .03, "area");
    }
}

// --- Copies

constexpr double epsilon = .02, width = 4, height = 3;

// A rectangle, and a wall at its side.
Cloud make_copies(std::size_t places, std::size_t copies, double jitter)
{
  scenes::Random random{3};
  Cloud cloud;
  const auto add = [&](const Kernel::Point_3& place, const Kernel::Vector_3& normal) {
    for(std::size_t i = 0; i < copies; ++i) {
      const Kernel::Vector_3 shift(random.gaussian(), random.gaussian(), random.gaussian());
      cloud.emplace_back(place + jitter * shift, normal);
    }
  };
  for(std::size_t i = 0; i < places; ++i) {
    const double x = width * random.uniform(), y = height * random.uniform(), z = height * random.uniform();
    add({x, y, 0}, {0, 0, 1});
    add({x, 0, z}, {0, -1, 0});
  }
  return cloud;
}

// The same area, whatever the number of copies is: with places that are many times the maximum distance from each
// other, or less than it.
BOOST_AUTO_TEST_CASE(copies_of_points)
{
  for(std::size_t places : {300, 20000})
    for(std::size_t copies : {1, 8, 50, 200})
      for(double jitter : {0., 1e-6, 1e-3, 4e-3}) {
        if(places > 300 ? copies > 8 || jitter > 1e-6 || is_sanitized : copies > 50 && jitter > 1e-3)
          continue;
        const std::string name = std::to_string(places) + ' ' + std::to_string(copies) + ' ' + std::to_string(jitter);
        const Cloud cloud = make_copies(places, copies, jitter);
        const Shapes shapes = detect(cloud, make_parameters(epsilon, 100 * copies));
        CHECK_AT(shapes.number_of_shapes() == 2, name + ": " + std::to_string(shapes.number_of_shapes()));
        const Areas areas = areas_of(shapes, cloud);
        CHECK_AT(areas.number_of_empty_entries() == 0, name);
        for(std::size_t s = 0; s < areas.number_of_entries(); ++s) {
          CHECK_AT(areas.area(s) > .83 * width * height && areas.area(s) < 1.03 * width * height,
                   name + ": " + std::to_string(areas.area(s)));
          CHECK_AT(areas.polygons(s).size() == 1 && areas.polygons(s)[0].outer.size() < 12, name);
        }
      }
}

// The points of a shape count, not their order.
BOOST_AUTO_TEST_CASE(order_of_points)
{
  const Cloud cloud = make_copies(2000, 1, .004);
  const Shapes shapes = detect(cloud, make_parameters(epsilon, 100));
  const Areas expected = areas_of(shapes, cloud);
  std::vector<std::int32_t> labels(shapes.shape_indices().begin(), shapes.shape_indices().end());
  std::reverse(labels.begin(), labels.end());
  Shapes::Data data = shapes.data();
  data.shape_of = std::move(labels);
  const Areas areas = areas_of(Shapes(data), Cloud(cloud.rbegin(), cloud.rend()));
  CHECK(areas.points() == expected.points());
  for(std::size_t s = 0; s < expected.number_of_entries(); ++s)
    CHECK(areas.area(s) == expected.area(s));
}

BOOST_AUTO_TEST_SUITE_END()
