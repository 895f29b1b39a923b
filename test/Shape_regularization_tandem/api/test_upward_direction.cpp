// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// upward_direction() of faces of houses, rooms and roofs, and the direction that is expected at a place.

#include "api_support.h"

#include <CGAL/Shape_regularization_tandem/upward_direction.h>

BOOST_AUTO_TEST_SUITE(test_upward_direction)

using scenes::Vec;

struct Face {
  Vec normal;
  std::size_t points;
  Vec centroid;
};

// Turned: z becomes the given axis, a unit vector other than -z.
Vec turned(const Vec& v, const Vec& axis)
{
  const Vec sum = axis + Vec{0, 0, 1};
  return (2 * dot(v, sum) / dot(sum, sum)) * sum - v; // half a turn about the middle of z and the axis
}

// Each face is a shape with a direction of its own.
CGAL::Tandem::Upward_direction up_of(const std::vector<Face>& faces, const Vec& axis, const Vec& expected = {0, 0, 1})
{
  Shapes::Data data;
  data.uncertainty.resize(faces.size());
  for(std::size_t s = 0; s < faces.size(); ++s) {
    const Vec n = turned(faces[s].normal, axis), c = turned(faces[s].centroid, axis);
    data.coefficients.push_back({n.x, n.y, n.z, 0});
    data.size.push_back(faces[s].points);
    data.parallel_group.push_back(int(s));
    data.coplanar_group.push_back(int(s));
    data.is_flipped.push_back(0);
    data.uncertainty[s].centroid = {c.x, c.y, c.z};
  }
  return CGAL::Tandem::upward_direction(Shapes(data), {expected.x, expected.y, expected.z});
}

void check_up(const CGAL::Tandem::Upward_direction& up, const Vec& direction, bool is_found, const std::string& name)
{
  const double d = dot(Vec{up.direction[0], up.direction[1], up.direction[2]}, direction);
  CHECK_AT(up.is_found == is_found && d > 1 - 1e-12, name + ": " + to_text(d));
}

const double h = std::sqrt(.5);
const std::vector<Face> room = {
  {{0, 0, 1}, 500, {0, 0, 0}}, {{.8, .6, 0}, 300, {4, 3, 1}}, {{-.6, .8, 0}, 200, {-3, 4, 1}}};
const std::vector<Face> gable = {{{h, 0, h}, 400, {1, 0, 5}},
                                 {{-h, 0, h}, 400, {-1, 0, 5}},
                                 {{1, 0, 0}, 300, {2, 0, 2}},
                                 {{0, 1, 0}, 300, {0, 4, 2}},
                                 {{0, 0, 1}, 300, {0, 0, 0}}};
const std::vector<Face> roofs = {gable[0], gable[1], {{0, h, h}, 40, {0, 9, 5}}};

BOOST_AUTO_TEST_CASE(test_axes)
{
  const Vec z = {0, 0, 1}, camera = {.1, -.9, -std::sqrt(.18)};
  check_up(up_of(room, z), z, true, "a room");
  check_up(up_of(gable, z), z, true, "more points are upright to the ridge");
  check_up(up_of(room, {0, std::sin(.1), std::cos(.1)}), z, true, "within the angle tolerance");
  for(const Vec& axis : {Vec{0, -1, 0}, Vec{0, 1, 0}, camera})
    check_up(up_of(room, axis), axis, true, "the end at which walls are higher than the floor");
  check_up(up_of(room, camera, camera), camera, true, "expected");
  check_up(up_of({room[1], room[2]}, z), z, true, "walls");
  check_up(up_of({room[1], room[2]}, camera), z, false, "walls, but no floor");
  check_up(up_of(roofs, z), z, false, "roofs");
  check_up(up_of({{{0, .6, .8}, 100, {0, 0, 0}}}, z), z, false, "one plane");
  check_up(up_of({}, z), z, false, "none");
}

BOOST_AUTO_TEST_CASE(test_fractions)
{
  const CGAL::Tandem::Upward_direction up = up_of(gable, {0, 0, 1});
  check_close(up.level, 300. / 1700, 1e-15, "level");
  check_close(up.upright, 600. / 1700, 1e-15, "upright");
}

// Munich, by its latitude and longitude; coordinates of maps; no coordinates.
BOOST_AUTO_TEST_CASE(test_expected)
{
  const double latitude = 48.1374 * CGAL_PI / 180, longitude = 11.5755 * CGAL_PI / 180, height = 520;
  const double squared_eccentricity = .00669437999014, c = std::cos(latitude), s = std::sin(latitude);
  const double radius = 6378137 / std::sqrt(1 - squared_eccentricity * s * s);
  const Vec up = {c * std::cos(longitude), c * std::sin(longitude), s};
  const std::array<double, 3> place = {(radius + height) * up.x, (radius + height) * up.y,
                                       (radius * (1 - squared_eccentricity) + height) * s};
  const std::array<double, 3> found = CGAL::Tandem::expected_upward_direction(place);
  check_close(dot(Vec{found[0], found[1], found[2]}, up), 1, 1e-13, "geocentric");
  for(const auto& other : {std::array<double, 3>{500000, 6350000, 80}, {0, 0, 0}, {not_a_number, 0, 0}, {1, 2, 3e4}})
    CHECK((CGAL::Tandem::expected_upward_direction(other) == std::array<double, 3>{0, 0, 1}));
}

BOOST_AUTO_TEST_SUITE_END()
