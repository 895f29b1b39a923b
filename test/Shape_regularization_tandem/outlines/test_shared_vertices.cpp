// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where two shapes meet, they have the same vertices, bit for bit: in generated houses, in random scenes, and in units
// that differ by powers of two.
//   test_shared_vertices SEED COUNT  looks at other random scenes

#include "testing/property_case.h"

#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_shared_vertices)

using Areas = CGAL::Tandem::Shape_polygons_3<Kernel>;

Areas areas_of(const Shapes& shapes, const Cloud& cloud)
{
  return CGAL::Tandem::polygons(shapes, cloud, CGAL::Tandem::parameters::point_map(First<Kernel>()));
}

struct Totals {
  std::size_t common_edges = 0, overlaps = 0;
};

// An edge along the line of two planes.
struct Edge {
  double first, last;
  std::uint32_t corners[2];
};

bool is_on(const Shapes& shapes, std::size_t s, const Kernel::Point_3& p)
{
  const auto& c = shapes.coefficients(s);
  long double height = c[3], size = std::fabs(c[3]);
  for(int k = 0; k < 3; ++k) {
    height += static_cast<long double>(c[std::size_t(k)]) * p[k];
    size += std::fabs(static_cast<long double>(c[std::size_t(k)]) * p[k]);
  }
  return std::fabs(height) <= size * 0x1p-51L;
}

// The edges of s whose ends lie on the plane of t, too.
std::vector<Edge> edges_on(const Shapes& shapes, const Areas& areas, std::size_t s, std::size_t t,
                           const Kernel::Vector_3& line)
{
  std::vector<Edge> result;
  const auto add = [&](const CGAL::Tandem::Indexed_polygon::Loop& loop) {
    for(std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      const Kernel::Point_3 &p = areas.points()[a], &q = areas.points()[b];
      const double x = (p - CGAL::ORIGIN) * line, y = (q - CGAL::ORIGIN) * line;
      if(is_on(shapes, s, p) && is_on(shapes, t, p) && is_on(shapes, s, q) && is_on(shapes, t, q))
        result.push_back(x < y ? Edge{x, y, {a, b}} : Edge{y, x, {b, a}});
    }
  };
  for(const CGAL::Tandem::Indexed_polygon& polygon : areas.polygons(s)) {
    add(polygon.outer);
    for(const auto& hole : polygon.holes)
      add(hole);
  }
  return result;
}

// Edges of both that overlap by more than a rounded coordinate are the same edge: by their positions in the table.
void count_common(const Shapes& shapes, const Areas& areas, std::size_t s, std::size_t t, Totals& totals)
{
  Kernel::Vector_3 line = CGAL::cross_product(shapes.plane(s).orthogonal_vector(), shapes.plane(t).orthogonal_vector());
  if(line.squared_length() < .0625) // flatter ones have no common vertices
    return;
  line = line / std::sqrt(line.squared_length());
  double largest = 0;
  for(const Kernel::Point_3& p : areas.points())
    largest = (std::max)({largest, std::fabs(p.x()), std::fabs(p.y()), std::fabs(p.z())});
  for(const Edge& a : edges_on(shapes, areas, s, t, line))
    for(const Edge& b : edges_on(shapes, areas, t, s, line))
      if((std::min)(a.last, b.last) - (std::max)(a.first, b.first) > largest * 0x1p-46) {
        ++totals.overlaps;
        totals.common_edges += a.corners[0] == b.corners[0] && a.corners[1] == b.corners[1];
      }
}

void check_shared(const Shapes& shapes, const Cloud& cloud, const std::string& name, Totals& totals)
{
  const Areas areas = areas_of(shapes, cloud);
  std::set<std::array<double, 3>> all; // no two points of the table are equal
  for(const Kernel::Point_3& p : areas.points())
    CHECK_AT(all.insert({p.x(), p.y(), p.z()}).second, name);
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    for(std::size_t t = 0; t < s; ++t)
      count_common(shapes, areas, s, t, totals);
}

// --- Scenes

BOOST_AUTO_TEST_CASE(houses)
{
  Totals totals;
  for(const std::string scene : {"house", "village", "indoor"}) {
    const Cloud cloud = to_cloud(scenes::make_scene(scene, scene_options(is_sanitized ? 20000 : 60000, .0003)));
    check_shared(detect(cloud, make_parameters(.04, 60)), cloud, scene, totals);
  }
  // A few edges differ: an outline that is not simple with all vertices of others does without some.
  CHECK(double(totals.common_edges) >= .97 * double(totals.overlaps) &&
        totals.common_edges > (is_sanitized ? 40 : 120));
}

BOOST_AUTO_TEST_CASE(random_scenes)
{
  const std::uint64_t first = argument(1, 1), count = argument(2, is_sanitized ? 15 : 60);
  Totals totals;
  on_random_cases(first, count, [&](const Property_case& c) {
    check_shared(detect(c.cloud, c.parameters, c.given), c.cloud, c.name, totals);
  });
  // Far from the origin, where coordinates are rounded to a fraction of the spacing, outlines that would not be simple
  // with the vertices of others do without them.
  CHECK(count < 40 || double(totals.common_edges) >= .97 * double(totals.overlaps));
  CHECK(count < 40 || totals.common_edges > 10);
}

// In units that differ by powers of two, polygons are the same.
BOOST_AUTO_TEST_CASE(units)
{
  const Cloud cloud = make_pairs<Kernel>(make_box_cloud(400));
  const Shapes shapes = detect(cloud, make_parameters(.02, 50));
  const Areas expected = areas_of(shapes, cloud);
  for(int exponent : {-960, -300, -1, 1, 300, 1000}) {
    Shapes::Data data = shapes.data();
    for(auto& c : data.coefficients)
      c[3] = std::ldexp(c[3], exponent);
    data.parameters.maximum_distance = std::ldexp(data.parameters.maximum_distance, exponent);
    const Areas areas = areas_of(Shapes(data), transformed(cloud, std::ldexp(1, exponent)));
    const std::string name = "2^" + std::to_string(exponent);
    CHECK_AT(areas.points().size() == expected.points().size(), name);
    for(std::size_t i = 0; i < (std::min)(areas.points().size(), expected.points().size()); ++i)
      for(int k = 0; k < 3; ++k)
        CHECK_AT(areas.points()[i][k] == std::ldexp(expected.points()[i][k], exponent), name);
    for(std::size_t s = 0; s < areas.number_of_entries(); ++s)
      CHECK_AT(areas.area(s) == std::ldexp(expected.area(s), 2 * exponent), name);
  }
  Totals totals;
  check_shared(shapes, cloud, "box", totals);
  CHECK_AT(totals.common_edges == 12 && totals.overlaps == 12 && expected.points().size() == 8,
           std::to_string(totals.common_edges) + ' ' + std::to_string(expected.points().size()));
}

BOOST_AUTO_TEST_SUITE_END()
