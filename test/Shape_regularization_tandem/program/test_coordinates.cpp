// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the program reads of coordinates, of --noise and of --tolerance-column: warnings where coordinates are wrong and
// none where they are not, and the tolerances of points.

#include "testing/checks.h"

#include "warnings.h"
#include "input/input_settings.h"
#include "Options.h"

#include <cmath>
#include <iomanip>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_coordinates)

using program::Point_set;
using Point = program::Kernel::Point_3;

// Floor and walls with noise, in map coordinates or others.
Point_set make_room(unsigned seed, std::size_t n, const Point& corner, double noise)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal(0, noise);
  Point_set points;
  for(std::size_t i = 0; i < n; ++i) {
    double p[3] = {4 * unit(random), 3 * unit(random), 2.5 * unit(random)};
    p[i % 3] = normal(random);
    points.insert(Point(corner.x() + p[0], corner.y() + p[1], corner.z() + p[2]));
  }
  return points;
}

template <class F>
Point_set changed(const Point_set& points, const F& f)
{
  Point_set result;
  for(Point_set::Index i : points) {
    const Point& p = points.point(i);
    result.insert(Point(f(p.x()), f(p.y()), f(p.z())));
  }
  return result;
}

// All warnings, with a blank between them.
std::string warnings_of(const Point_set& points, double tolerance)
{
  const program::Ranks alone;
  std::string text;
  for(const std::string& warning : program::cloud_warnings(points, program::box_of(points, alone), tolerance, alone))
    text += warning + ' ';
  return text;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

double as_float(double x) { return double(float(x)); }

void check_steps(unsigned seed)
{
  const Point_set room = make_room(seed, 4000, Point(694386.2, 5155487.5, 380), .004);
  CHECK_AT(warnings_of(room, .02).empty(), warnings_of(room, .02));
  const std::string rounded = warnings_of(changed(room, as_float), .02);
  CHECK_AT(has(rounded, "x in steps of 0.0625, y in steps of 0.5,") && has(rounded, "doubles"), rounded);
  CHECK_AT(!has(rounded, "z in steps"), rounded);
  CHECK_AT(has(warnings_of(changed(room, as_float), 1.), " y in steps of 0.5, while"), std::to_string(seed));
  CHECK_AT(warnings_of(changed(room, as_float), 3.).empty(), std::to_string(seed));
  const Point_set near = make_room(seed, 4000, Point(-2, -1, .5), .004);
  CHECK_AT(warnings_of(changed(near, as_float), .0001).empty(), std::to_string(seed));
  // As streams write by default.
  const auto six_digits = [](double x) { return std::stod(program::sentence(std::setprecision(6), x)); };
  const Point_set site =
    changed(make_room(seed, 20000, Point(69438.62, 51554.875, 380), .004), [](double x) { return 10 * x; });
  const std::string digits = warnings_of(changed(site, six_digits), .1);
  CHECK_AT(has(digits, "rounded, x in steps of 1, y in steps of 1, while") && has(digits, "more digits"), digits);
  // Millimeters, copies on a grid, and rasters of meters, also at half of them, are no rounded coordinates.
  const Point_set millimeters = changed(near, [](double x) { return std::round(1000 * x); });
  CHECK_AT(warnings_of(millimeters, 12).empty(), std::to_string(seed));
  Point_set copies, raster;
  for(Point_set::Index i : make_room(seed, 900, Point(0, 0, 0), .004))
    for(int k = 0; k < 8; ++k)
      copies.insert(Point(.01 * std::round(100 * near.point(i).x()), .01 * std::round(100 * near.point(i).y()),
                          .01 * std::round(100 * near.point(i).z())));
  CHECK_AT(warnings_of(copies, .015).empty(), warnings_of(copies, .015));
  std::mt19937 random(seed);
  for(int i = 0; i < 80; ++i)
    for(int j = 0; j < 60; ++j)
      raster.insert(Point(694386 + i, 5155487.5 + j, 380 + .1 * i + .01 * double(random() % 100)));
  CHECK_AT(warnings_of(raster, .2).empty(), warnings_of(raster, .2));
}

void check_degrees(unsigned seed)
{
  const Point_set town = make_room(seed, 3000, Point(0, 0, 380), .004);
  Point_set degrees;
  for(Point_set::Index i : town) {
    const Point& p = town.point(i);
    degrees.insert(Point(-71.06 + p.x() / 400, 42.36 + p.y() / 300, p.z() * 10));
  }
  const std::string warning = warnings_of(degrees, .1);
  CHECK_AT(has(warning, "look like degrees") && has(warning, "UTM"), warning);
  CHECK(warnings_of(town, .02).empty());
  CHECK(warnings_of(changed(town, [](double x) { return .01 * x; }), .0002).empty());
}

void check_zeros(unsigned seed)
{
  const auto with_zeros = [](Point_set points, int zeros) {
    for(int i = 0; i < zeros; ++i)
      points.insert(Point(0, 0, 0));
    return points;
  };
  const Point_set far = make_room(seed, 2000, Point(694386.2, 5155487.5, 380), .004);
  const Point_set camera = make_room(seed, 2000, Point(-2, -1.5, .6), .004);
  const Point_set around = make_room(seed, 2000, Point(-2, -1.5, -1), .004);
  for(const Point_set& cloud : {far, camera}) {
    CHECK(has(warnings_of(with_zeros(cloud, 20), .02), "20 points are exactly at 0 0 0"));
    CHECK(warnings_of(with_zeros(cloud, 2), .02).empty());
  }
  CHECK(warnings_of(with_zeros(around, 20), .02).empty());
  CHECK(has(warnings_of(with_zeros(around, 500), .02), "--ignore-zeros"));
}

void check_noise()
{
  const auto is = [](const char* text, double c0, double c1, double c2) {
    const auto c = program::parse_noise(text).c;
    CHECK_AT(c[0] == c0 && c[1] == c1 && c[2] == c2, text);
  };
  is("0.001 + 0.0028*r^2", .001, 0, .0028);
  is("2.8e-3r^2+.001", .001, 0, .0028);
  is(" r * r * 2.8e-3 - 1e-3 r + -0.5 ", -.5, -.001, .0028);
  is("R**2", 0, 0, 1);
  is("r\u00b2 + r^1 + r^0", 1, 1, 1);
  is("0.5*0.5 r", 0, .25, 0);
  is("1+1", 2, 0, 0);
  for(const char* text : {"", "+", "0", "r - r", "1 2", "r^3", "r*r*r", "r^", "2*", "1e999", "(r)", "0,5", "inf", "nan",
                          "a + b*r", "r^-1", "r/2", "1e-3x", "2 r 3"}) {
    std::string message;
    try {
      program::parse_noise(text);
    } catch(const std::invalid_argument& e) {
      message = e.what();
    }
    CHECK_AT(has(message, "--noise is '" + std::string(text) + "', which "), text);
  }
  CHECK(program::parse_noise("1 + 2r + 3r^2")(2) == 17);
}

void check_names()
{
  const std::vector<std::string> names = {"x", "_", "", "-", "__", "scalar_Sigma", "sigma"};
  const auto found = [&](const char* wanted) {
    try {
      return program::find_name(names, wanted, "field");
    } catch(const std::runtime_error& e) {
      CHECK_AT(has(e.what(), "has no field '" + std::string(wanted) + "'") &&
                 has(e.what(), "it has x, scalar_Sigma, sigma"),
               e.what());
      return names.size();
    }
  };
  CHECK(found("sigma") == 6 && found("Sigma") == 5 && found(" SIG_ma") == 5);
  for(const char* wanted : {"_", "", "-", "__", " ", "''", "si"})
    CHECK_AT(found(wanted) == names.size(), wanted);
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  check_noise();
  check_names();
  for(unsigned seed : {1u, 2u, 3u}) {
    check_steps(seed);
    check_degrees(seed);
    check_zeros(seed);
  }
}

BOOST_AUTO_TEST_SUITE_END()
