// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Outlines of a facade: straight edges that are parallel or orthogonal to lines with other planes, windows that are
// rectangles, and a round hole that is none.

#include "testing/test_support.h"

#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <cmath>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_regular_outlines)

using Areas = CGAL::Tandem::Shape_polygons_3<Kernel>;
using CGAL::Tandem::Indexed_polygon;
using scenes::Vec;

constexpr double sigma = .004;

struct Window {
  double x, z, width, height;
};
const std::vector<Window> windows = {{1, 1, 1.2, 1.4}, {3.4, 1, 1.2, 1.4}, {1, 3.2, 1.2, 1.4}, {3.4, 3.2, 1.2, 1.4}};
constexpr double round_x = 6.5, round_z = 2.5, radius = .8;

bool is_window(double x, double z)
{
  for(const Window& w : windows)
    if(x > w.x && x < w.x + w.width && z > w.z && z < w.z + w.height)
      return true;
  return std::hypot(x - round_x, z - round_z) < radius;
}

// A gable wall of 8 x 5 whose ridge is at 7, without a floor; a wall at its side, and the two slopes of the roof. All is
// turned, so that nothing is parallel to an axis.
class Facade {
public:
  Cloud make(std::size_t points_a_square_meter)
  {
    const auto add_area = [&](double area, auto f) {
      for(double i = 0; i < area * double(points_a_square_meter); ++i)
        f();
    };
    add_area(56, [&] {
      const double x = 8 * random.uniform(), z = 7 * random.uniform();
      if(z < height_at(x) && !is_window(x, z))
        put({x, noise(), z}, {0, -1, 0});
    });
    add_area(30, [&] { put({noise(), 6 * random.uniform(), 5 * random.uniform()}, {-1, 0, 0}); });
    add_area(48, [&] {
      const double x = 8 * random.uniform(), y = 6 * random.uniform(), s = x < 4 ? -1 : 1;
      put({x, y, height_at(x) + noise()}, {s * 1 / std::sqrt(5.), 0, 2 / std::sqrt(5.)});
    });
    return cloud;
  }

  static double height_at(double x) { return 5 + .5 * (4 - std::fabs(x - 4)); }

private:
  double noise() { return sigma * random.gaussian(); }
  void put(const Vec& p, const Vec& n) { add(cloud, frame.point(p), frame.vector(n)); }

  scenes::Random random{11};
  scenes::Frame frame = scenes::Frame().turned({.3, .4, 1}, .2);
  Cloud cloud;
};

// The sine of the angle to the nearest of the directions that other shapes give, and of those orthogonal to them.
double sine_to_relations(const Shapes& shapes, std::size_t s, const Kernel::Vector_3& edge)
{
  const auto normal_of = [&](std::size_t t) { return shapes.plane(t).orthogonal_vector(); };
  double smallest = 1;
  for(std::size_t t = 0; t < shapes.number_of_shapes(); ++t) {
    const Kernel::Vector_3 line = CGAL::cross_product(normal_of(s), normal_of(t));
    const double length = std::sqrt(line.squared_length() * edge.squared_length());
    if(line.squared_length() > .01)
      smallest = (std::min)({smallest, std::fabs(line * edge) / length,
                             std::sqrt(CGAL::cross_product(line, edge).squared_length()) / length});
  }
  return smallest;
}

Kernel::Vector_3 edge_of(const Areas& areas, const Indexed_polygon::Loop& loop, std::size_t i)
{
  return areas.points()[loop[(i + 1) % loop.size()]] - areas.points()[loop[i]];
}

// Rectangles of about the size of a window, and the rest.
void check_holes(const Shapes& shapes, const Areas& areas, std::size_t s, double spacing)
{
  const Indexed_polygon& polygon = areas.polygons(s).at(0);
  CHECK_AT(polygon.holes.size() == windows.size() + 1, std::to_string(polygon.holes.size()));
  std::size_t rectangles = 0;
  for(const Indexed_polygon::Loop& hole : polygon.holes) {
    if(hole.size() != 4) {
      CHECK_AT(hole.size() > 5, std::to_string(hole.size())); // the round one
      continue;
    }
    ++rectangles;
    double sizes[2];
    for(std::size_t i = 0; i < 4; ++i) {
      const Kernel::Vector_3 edge = edge_of(areas, hole, i);
      CHECK_AT(sine_to_relations(shapes, s, edge) < 1e-9, std::to_string(sine_to_relations(shapes, s, edge)));
      sizes[i % 2] = std::sqrt(edge.squared_length());
    }
    CHECK_AT(std::fabs((std::min)(sizes[0], sizes[1]) - 1.2) < 2 * spacing, std::to_string(sizes[0]));
    CHECK_AT(std::fabs((std::max)(sizes[0], sizes[1]) - 1.4) < 2 * spacing, std::to_string(sizes[1]));
  }
  CHECK_AT(rectangles == windows.size(), std::to_string(rectangles));
}

// Bottom, right, two slopes, left: straight, up to a short edge or two at corners.
void check_wall(const Shapes& shapes, const Areas& areas, std::size_t s)
{
  CHECK_AT(areas.polygons(s).size() == 1, std::to_string(areas.polygons(s).size()));
  const Indexed_polygon::Loop& outer = areas.polygons(s).at(0).outer;
  CHECK_AT(outer.size() >= 5 && outer.size() <= 7, std::to_string(outer.size()));
  double regular = 0, length = 0;
  for(std::size_t i = 0; i < outer.size(); ++i) {
    const Kernel::Vector_3 edge = edge_of(areas, outer, i);
    const double of_edge = std::sqrt(edge.squared_length());
    length += of_edge;
    regular += sine_to_relations(shapes, s, edge) < 1e-9 ? of_edge : 0;
  }
  CHECK_AT(regular > .97 * length, std::to_string(regular / length));
  double window_area = CGAL_PI * radius * radius;
  for(const Window& w : windows)
    window_area += w.width * w.height;
  CHECK_AT(std::fabs(areas.area(s) / (48 - window_area) - 1) < .04, std::to_string(areas.area(s)));
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  for(const std::size_t density : {200, 500}) {
    const Cloud cloud = Facade().make(density);
    const Shapes shapes = detect(cloud, make_parameters(.02, 200));
    CHECK_AT(shapes.number_of_shapes() == 4, std::to_string(shapes.number_of_shapes()));
    const Areas areas = CGAL::Tandem::polygons(shapes, cloud, CGAL::Tandem::parameters::point_map(First<Kernel>()));
    std::size_t walls = 0;
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      if(!areas.polygons(s).empty() && !areas.polygons(s)[0].holes.empty()) {
        ++walls;
        check_holes(shapes, areas, s, 1 / std::sqrt(double(density)));
        check_wall(shapes, areas, s);
      }
    CHECK(walls == 1);
  }
}

BOOST_AUTO_TEST_SUITE_END()
