// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The score of a result beside its definition, computed by brute force in double from labels and planes; and the parts
// of it in integers.

#include "testing/test_support.h"

#include <CGAL/Tandem/internal/score/Score.h>

#include <map>

BOOST_AUTO_TEST_SUITE(test_score)

using CGAL::Tandem::Result_score;
using CGAL::Tandem::internal::fixed_log2;
using CGAL::Tandem::internal::Score;
using scenes::Vec;

bool are_near(double a, double b, double margin) { return std::fabs(a - b) <= margin; }

BOOST_AUTO_TEST_CASE(test_logarithm)
{
  for(std::uint64_t n = 1; n < std::uint64_t(1) << 40; n += 1 + n / 97)
    CHECK_AT(are_near(double(fixed_log2(n)) / 65536, std::log2(double(n)), 6e-5), std::to_string(n));
  for(int bit = 0; bit < 64; ++bit)
    CHECK_AT(fixed_log2(std::uint64_t(1) << bit) == std::int64_t(bit) << 16, std::to_string(bit));
}

BOOST_AUTO_TEST_CASE(test_parts)
{
  const double unit = double(Score::unit);
  scenes::Random random(1);
  for(int i = 0; i < 2000; ++i) {
    const std::uint64_t minimum = 3 + random.bits() % 500;
    const int k = 3 + int(random.bits() % 40);
    const double simplicity = i == 0 ? Parameters().simplicity : random.uniform(),
                 regularity = i == 0 ? .1 : 10 * random.uniform();
    const Score score = i == 0 ? Score(minimum, k) : Score(minimum, k, simplicity, regularity);
    const std::string where = "case " + std::to_string(i);
    const std::int64_t n = 1 + std::int64_t(std::exp2(36 * random.uniform()));
    const double bonus = simplicity * double(n) * std::log2(double(n) / double(minimum));
    const double rounding = 1e-3 * simplicity * double(n) + (.1 * double(n) + 1) / unit;
    CHECK_AT(are_near(double(score.size_bonus(n)) / unit, bonus, rounding), where);
    const double derivative = double(score.size_bonus(2 * n) - score.size_bonus(n)) / double(n); // at about 1.47 n
    CHECK_AT(score.point_bonus(n) <= derivative + 2 && derivative <= double(score.point_bonus(2 * n)) + 2, where);
    CHECK_AT(are_near(double(score.price()) / unit, -.3 * double(minimum), 1 / unit), where);
    CHECK_AT(are_near(double(score.freedom(700)) / unit, -regularity * (double(minimum) + 70), .01), where);
    CHECK_AT(are_near(double(score.links(24, 4)) / unit, -(.5 * 24 + 1.5 * 4) / k, 1 / unit), where);
    const std::int64_t epsilon = std::int64_t(37) << 28;
    const double fraction = 2 * random.uniform() - 1;
    const std::int64_t d = std::int64_t(fraction * double(epsilon)), weight = Score::weight({epsilon, 0}, d);
    CHECK_AT(are_near(double(weight), unit * (1 - fraction * fraction), 1), where);
    CHECK_AT(Score::weight({epsilon, 0}, epsilon + 5) == 0, where);
  }
  CHECK(Score(100, 12).size_bonus(0) == 0);
  CHECK(Score(~std::uint64_t(0), 12).price() < 0);
}

// Of planes that meet, up to those that are far apart, with normals to one side or to both.
BOOST_AUTO_TEST_CASE(test_continuity)
{
  using namespace CGAL::Tandem::internal;
  const double unit = double(Score::unit), epsilon = 60;
  const Tolerance tolerance = make_tolerance(epsilon, .9);
  scenes::Random random(2);
  Contact contact;
  double weight = 0, x = 0;
  for(int i = 0; i < 2000; ++i) {
    const Grid_point p = {std::int32_t(random.bits() % 2000), std::int32_t(random.bits() % 2000), 0, no_normal};
    const double step = i < 4     ? i % 2
                        : i < 8   ? std::ldexp(1, i + 12)
                        : i < 100 ? 100 * random.uniform()
                                  : 1.2 * random.uniform();
    const double sign = i % 3 == 0 ? 1 : -1, slope = .2 * random.gaussian(), length = std::sqrt(1 + slope * slope);
    const Vector n = {slope / length, 0, 1 / length};
    const double at_p = n.x * p.x;
    const auto a = rounded({n, at_p + .3 * epsilon}), b = rounded({sign * n, sign * (at_p + (.3 + step) * epsilon)});
    const double w = (std::max)(0., 1 - step * step);
    const std::int64_t got = continuity_at(a, b, p, tolerance);
    const std::string where = std::to_string(step) + (sign < 0 ? " and opposite normals" : "");
    CHECK_AT(are_near(double(got), unit * w * w, 3) && (step > 0 || got == Score::unit), where);
    check_equal(continuity_at(b, a, p, tolerance), got, where + ", in the other order");
    const std::uint64_t links = 1 + random.bits() % 70000;
    contact.add(links, p);
    x += double(links) * p.x;
    weight += double(links);
  }
  CHECK(contact.links == weight && are_near(contact.center().x, x / weight, 1));
  // Planes that meet, and turn by up to twice alpha and by right angles.
  for(double degrees : {0., .01, 1., 5., 15., 25., 25.8, 25.9, 52., 90.}) {
    const double sine = std::sin(degrees * std::acos(-1) / 180), cosine = std::cos(degrees * std::acos(-1) / 180);
    const std::int64_t got =
      continuity_at(rounded({{0, 0, 1}, 7}), rounded({{sine, 0, cosine}, 7 * cosine}), {0, 5, 7, no_normal}, tolerance);
    check_close(double(got), unit * (std::max)(0., 1 - sine * sine / (1 - .9 * .9)), 2, std::to_string(degrees));
  }
}

// k nearest neighbors of all points, in double.
std::vector<std::vector<std::size_t>> brute_force_neighbors(const std::vector<Vec>& points, std::size_t k)
{
  std::vector<std::vector<std::size_t>> rows;
  for(std::size_t i = 0; i < points.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> all;
    for(std::size_t j = 0; j < points.size(); ++j)
      if(j != i)
        all.emplace_back(dot(points[j] - points[i], points[j] - points[i]), j);
    std::nth_element(all.begin(), all.begin() + std::ptrdiff_t(k), all.end());
    rows.emplace_back();
    for(std::size_t j = 0; j < k; ++j)
      rows.back().push_back(all[j].second);
  }
  return rows;
}

// The definition in Score.h. All terms but that of the directions: see result/test_freedom.cpp.
Result_score brute_force(const std::vector<Vec>& points, const Shapes& shapes)
{
  Result_score score;
  const CGAL::Tandem::Parameters& p = shapes.parameters();
  const double epsilon = p.maximum_distance, m = double(p.minimum_region_size);
  const auto rows = brute_force_neighbors(points, p.k_neighbors);
  std::vector<double> size(shapes.number_of_shapes(), 0);
  for(std::size_t i = 0; i < points.size(); ++i) {
    const int s = shapes.shape_index(i);
    for(std::size_t j : rows[i]) {
      const int t = shapes.shape_index(j);
      if(s != t)
        score.links -= (s < 0 || t < 0 ? 3 : 1) * .5 / double(p.k_neighbors);
    }
    if(s < 0)
      continue;
    ++size[std::size_t(s)];
    const auto& c = shapes.coefficients(std::size_t(s));
    const double d = c[0] * points[i].x + c[1] * points[i].y + c[2] * points[i].z + c[3];
    score.fit += 1 - d * d / epsilon / epsilon;
  }
  for(double n : size) {
    score.size += p.simplicity * n * std::log2(n / m);
    score.price -= .3 * m;
  }
  std::map<std::size_t, double> largest; // of the shapes of a plane
  for(std::size_t i = 0; i < size.size(); ++i)
    largest[shapes.coplanar_group(i)] = (std::max)(largest[shapes.coplanar_group(i)], size[i]);
  for(const auto& plane : largest)
    score.freedom -= .1 * m + .01 * plane.second;
  return score;
}

void check_result(const std::string& name, double maximum_distance, std::size_t minimum, double noise)
{
  scenes::Options options = scene_options(4000, noise, .05);
  options.normals = scenes::Normals::perturbed;
  scenes::Scene scene = scenes::make_scene(name, options);
  for(std::size_t i = 0; i < scene.normals.size(); i += 2) // normals are not oriented
    scene.normals[i] = -1. * scene.normals[i];
  const Shapes shapes = detect_valid(name, to_cloud(scene), points_only(maximum_distance, minimum));
  const Result_score found = shapes.statistics().score, expected = brute_force(scene.points, shapes);
  const double points = double(shapes.statistics().number_of_assigned_points);
  CHECK_AT(shapes.number_of_shapes() > 2, name);
  CHECK_AT(are_near(found.fit, expected.fit, .005 * points), name);
  CHECK_AT(are_near(found.links, expected.links, .002 * std::fabs(expected.links)),
           name); // neighbors at equal distance
  CHECK_AT(are_near(found.size, expected.size, 1e-4 * points), name);
  CHECK_AT(are_near(found.price, expected.price, .01), name);
  CHECK_AT(are_near(found.total(), found.fit + found.links + found.size + found.price + found.freedom, 1e-9), name);
  // The degrees of freedom of directions are priced by shapes that have from m points to those of the largest.
  const double directions = double(shapes.statistics().degrees_of_freedom - shapes.statistics().number_of_planes);
  const double largest = double(shapes.points(0).size()), m = double(minimum),
               of_directions = expected.freedom - found.freedom;
  CHECK_AT(of_directions >= directions * (.1 * m + .01 * m) - .01, name);
  CHECK_AT(of_directions <= directions * (.1 * m + .01 * largest) + .01, name);
}

BOOST_AUTO_TEST_CASE(test_results)
{
  check_result("house", .15, 20, .0005);
  check_result("indoor", .05, 15, .0005);
}

BOOST_AUTO_TEST_SUITE_END()
