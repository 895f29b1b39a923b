// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What detect_planes writes of random scenes, read back: polygons in all formats, the data of the page, vertex groups
// and the report.
//   test_outputs SEED        repeats one scene
//   test_outputs SEED COUNT  as many scenes, from SEED on

#include "testing/property_case.h"

#include "program/check_outputs.h"

#include <algorithm>
#include <cmath>

BOOST_AUTO_TEST_SUITE(test_outputs)

// --- Scenes of their own

// Lengths are multiplied by a power of two.
Output_case scaled(const Output_case& c, int exponent)
{
  Output_case result = {c.name + " times 2^" + std::to_string(exponent), c.points, program::Shapes()};
  const auto scale = [&](double& length) { length = std::ldexp(length, exponent); };
  for(Point_set::Index i : result.points) {
    auto& p = result.points.point(i);
    p = {std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent)};
  }
  Shapes::Data data = c.shapes.data();
  for(auto& coefficients : data.coefficients)
    scale(coefficients[3]);
  scale(data.parameters.maximum_distance);
  result.shapes = program::Shapes(data);
  return result;
}

// In units whose squares, and even areas, are no doubles, polygons are the same.
BOOST_AUTO_TEST_CASE(units)
{
  const Cloud cloud = make_pairs<Kernel>(make_box_cloud(400));
  const Output_case box = case_of("box", cloud, detect(cloud, make_parameters(.02, 50)));
  CHECK(box.shapes.number_of_shapes() == 6);
  const Written_shapes expected = read_geojson(text_of_polygons(box, "a.geojson", Faces_of_file::polygons));
  for(int exponent : {-960, -520, 520, 1000}) {
    const Output_case c = scaled(box, exponent);
    const Written_shapes written = read_geojson(text_of_polygons(c, "a.geojson", Faces_of_file::polygons));
    for(std::size_t s = 0; s < expected.size(); ++s) {
      CHECK_AT(written[s].polygons.size() == 1 && expected[s].polygons.size() == 1, c.name);
      if(written[s].polygons.empty() || expected[s].polygons.empty())
        continue;
      Ring ring = expected[s].polygons[0].rings[0];
      for(Position& p : ring)
        for(double& x : p)
          x = std::ldexp(x, exponent);
      CHECK_AT(written[s].polygons[0].rings[0] == ring, c.name);
      CHECK_AT(written[s].area == std::ldexp(expected[s].area, 2 * exponent), c.name);
    }
    check_view(c, written);
    check_vg(c);
  }
}

// All points in one shape.
Output_case case_of_plane(const std::string& name, const Cloud& cloud, const program::Shapes::Coefficients& plane)
{
  Shapes::Data data = detect(cloud, make_parameters(1, cloud.size() + 1)).data();
  data.shape_of = std::vector<std::int32_t>(cloud.size(), 0);
  data.coefficients = {plane};
  data.parallel_group = data.coplanar_group = {0};
  data.fixed_direction = data.symmetry_group = {-1};
  data.is_flipped = {0};
  data.size = {cloud.size()};
  data.uncertainty.resize(1);
  data.statistics.number_of_assigned_points = cloud.size();
  data.statistics.number_of_shapes = data.statistics.number_of_directions = data.statistics.number_of_planes = 1;
  return case_of(name, cloud, Shapes(data));
}

// Too few points for an outline, and points on a line.
BOOST_AUTO_TEST_CASE(no_outline)
{
  for(const std::size_t width : {3, 1}) {
    Cloud cloud;
    for(std::size_t i = 0; i < 9; ++i)
      cloud.emplace_back(Kernel::Point_3(double(i % width), double(i / width), 0), Kernel::Vector_3(0, 0, 1));
    Totals totals;
    check_outputs(case_of_plane("a few points", cloud, {0, 0, 1, 0}), totals);
    CHECK(totals.shapes == 1 && totals.polygons == 0);
  }
}

// So far from the origin that coordinates are rounded to a few tenths of the spacing, or less.
BOOST_AUTO_TEST_CASE(far_from_the_origin)
{
  scenes::Random random(3);
  Totals totals;
  constexpr int runs = is_sanitized ? 10 : 100;
  for(int run = 0; run < runs; ++run) {
    const scenes::Vec n = random.direction(), u = unit(cross(n, random.direction())), v = cross(n, u);
    const double width = 1e-9 * std::ldexp(20, run % 10), offset = -5e6 * (n.x + n.y + n.z);
    Cloud cloud;
    for(int cluster = 0; cluster < 6; ++cluster) { // of all densities, so that outlines nearly touch
      const double x = random.uniform(), y = random.uniform();
      const double dx = random.uniform() * random.uniform(), dy = random.uniform() * random.uniform();
      for(int i = 0; i < 200; ++i) {
        const double a = width * (x + dx * random.uniform()), b = width * (y + dy * random.uniform());
        const scenes::Vec p = add_scaled(add_scaled({5e6, 5e6, 5e6}, a, u), b, v);
        add(cloud, p, n);
      }
    }
    check_outputs(case_of_plane("far, run " + std::to_string(run), cloud, {n.x, n.y, n.z, offset}), totals);
  }
  CHECK(totals.with_polygons > runs / 5);
}

// The checks see what is wrong.
BOOST_AUTO_TEST_CASE(the_checker_sees_what_is_wrong)
{
  const Cloud cloud = make_pairs<Kernel>(make_box_cloud(4));
  const Output_case c = case_of_plane("a square", cloud, {0, 0, 1, 0});
  const Ring square = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  const auto is_valid = [&](const std::vector<Ring>& rings, double area) {
    return Polygon_checker(c.shapes, 0).violations({{{rings}}, area}).empty();
  };
  CHECK(is_valid({square}, 16));
  CHECK(is_valid({square, {{1, 1, 0}, {1, 2, 0}, {2, 1, 0}}}, 15.5));
  CHECK(!is_valid({square}, 15.9));
  CHECK(!is_valid({{{0, 0, 0}, {0, 4, 0}, {4, 4, 0}, {4, 0, 0}}}, -16));
  CHECK(!is_valid({{{0, 0, 0}, {4, 0, 1e-9}, {4, 4, 0}, {0, 4, 0}}}, 16));
  CHECK(!is_valid({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0}}}, 0));
  CHECK(!is_valid({{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}}}, 8));             // touches an edge
  CHECK(!is_valid({{{0, 0, 0}, {4, 0, 0}, {6, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}}, 16)); // spike
  CHECK(!is_valid({square, {{0, 1, 0}, {1, 2, 0}, {2, 1, 0}}}, 15));                          // hole at the edge
  CHECK(!is_valid({square, {{5, 1, 0}, {5, 2, 0}, {6, 1, 0}}}, 15.5));                        // hole outside
}

// Points of a lattice, far from the origin. Rounded coordinates put those of a border next to their line, so that the
// triangulation has slivers there.
BOOST_AUTO_TEST_CASE(areas_of_lattices)
{
  for(unsigned run = 0; run < (is_sanitized ? 10 : 100); ++run) {
    scenes::Random random(run);
    const scenes::Vec normal = random.direction(), u = unit(cross(normal, random.direction())), v = cross(normal, u);
    const scenes::Vec corner = (run % 3 * 1e5) * random.direction();
    const double spacing = run % 2 ? .1 : .125, length = 15 * spacing;
    Cloud cloud;
    for(int i = 0; i < 256; ++i)
      add(cloud, add_scaled(add_scaled(corner, i / 16 * spacing, u), i % 16 * spacing, v), normal);
    const Output_case c = case_of("lattice", cloud, detect(cloud, make_parameters(.01, 100)));
    CHECK_AT(c.shapes.number_of_shapes() == 1, std::to_string(run));
    const double covered = program::areas_of_shapes(c.points, c.shapes).area(0);
    CHECK_AT(std::fabs(covered / (length * length) - 1) < 1e-6, std::to_string(run) + ": " + std::to_string(covered));
  }
}

BOOST_AUTO_TEST_CASE(random_scenes)
{
  Totals t;
  const std::uint64_t first = argument(1, 1), count = argument(2, is_sanitized ? 10 : 60);
  for(std::uint64_t seed = first; seed < first + count; ++seed) {
    const Property_case c = Case_maker(seed).make();
    try {
      check_outputs(case_of(c.name, c.cloud, detect(c.cloud, c.parameters, c.given)), t);
    } catch(const std::range_error&) {
    } // too wide: test_properties
  }
  CHECK(count == 1 || (t.polygons > 0 && double(t.inside) > .8 * double(t.points)));
}

BOOST_AUTO_TEST_SUITE_END()
