// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What must not change a result: the orientation of normals, where the cloud lies and
// in which units, points far away; and what must not be changed: the caller's range.

#include "testing/random_case.h"

#include <cmath>
#include <cstdlib>
#include <memory>

BOOST_AUTO_TEST_SUITE(test_invariances)

using scenes::Random;
using scenes::Vec;

struct Subject {
  std::string name;
  Cloud cloud;
  Parameters parameters;
};

// Coordinates that are multiples of 2^-20, so that shifts by them are exact.
Subject make_subject(const std::string& name, const scenes::Options& options, double epsilon, std::size_t minimum)
{
  const scenes::Scene scene = scenes::make_scene(name, options);
  Subject s = {name, Cloud(), make_parameters(epsilon, minimum)};
  for(const auto& item : to_cloud(scene)) {
    auto rounded = [](double x) { return std::ldexp(std::nearbyint(std::ldexp(x, 20)), -20); };
    s.cloud.emplace_back(Kernel::Point_3(rounded(item.first.x()), rounded(item.first.y()), rounded(item.first.z())),
                         item.second);
  }
  return s;
}

Cloud moved(const Cloud& cloud, const Kernel::Vector_3& shift, double scale = 1)
{
  Cloud result;
  for(const auto& item : cloud)
    result.emplace_back(CGAL::ORIGIN + scale * (item.first - CGAL::ORIGIN) + shift, item.second);
  return result;
}

void check_same_labels(const Shapes& a, const Shapes& b, const std::string& name)
{
  const long at = first_difference(a.shape_indices(), b.shape_indices());
  CHECK_AT(at < 0, name + ": the labels differ, first of point " + std::to_string(at));
  for(std::size_t s = 0; s < a.number_of_shapes() && s < b.number_of_shapes(); ++s)
    for(int c = 0; c < 3; ++c)
      CHECK_AT(a.coefficients(s)[c] == b.coefficients(s)[c], name + ": normal of shape " + std::to_string(s));
  CHECK_AT(a.data().coplanar_group == b.data().coplanar_group, name);
}

void test_flipped_normals(const Subject& s, const Shapes& expected)
{
  Random random(1);
  Cloud flipped = s.cloud;
  for(auto& item : flipped) {
    const double length = std::ldexp(random.bits() % 2 == 0 ? 1 : -1, int(random.bits() % 9) - 4);
    item.second = length * item.second;
  }
  const Shapes shapes = detect(flipped, s.parameters);
  check_same_labels(shapes, expected, s.name + ", flipped normals");
  check_same_planes(shapes, expected, s.name + ", flipped normals");
  for(auto& item : flipped)
    item.second = -1 * item.second;
  const Shapes opposite = detect(flipped, s.parameters);
  for(std::size_t i = 0; i < shapes.number_of_shapes() && i < opposite.number_of_shapes(); ++i)
    CHECK_AT(shapes.number_of_shapes() != opposite.number_of_shapes() ||
               shapes.coefficients(i) == opposite.coefficients(i),
             s.name + ", opposite normals");
}

// Shifts by multiples of the grid step: the same labels.
void test_translation(const Subject& s, const Shapes& expected, Given given)
{
  const double step = expected.statistics().grid_step;
  for(const Kernel::Vector_3& v :
      {Kernel::Vector_3(step, -3 * step, 17 * step), Kernel::Vector_3(1, 2, -3), Kernel::Vector_3(100, 100, 100),
       Kernel::Vector_3(5e5, 4.5e6, 100), Kernel::Vector_3(-6.5e5, 6.8e6, 0)}) {
    const std::string name = s.name + ", shifted by " + std::to_string(v.x()) + " " + std::to_string(v.y());
    const Cloud cloud = moved(s.cloud, v);
    const Shapes shapes = detect_valid(name, cloud, s.parameters, given);
    check_equal(shapes.statistics().grid_step, step, name + ": grid step");
    check_same_labels(shapes, expected, name);
  }
}

Parameters scaled(Parameters p, double scale)
{
  p.maximum_distance *= scale;
  p.maximum_offset *= scale;
  return p;
}

void test_scale(const Subject& s, const Shapes& expected, Given given)
{
  for(double scale : {.5, 1024., std::ldexp(1, -60), std::ldexp(1, 80)}) {
    const std::string name = s.name + ", scaled by " + std::to_string(scale);
    const Cloud cloud = moved(s.cloud, Kernel::Vector_3(0, 0, 0), scale);
    const Shapes shapes = detect_valid(name, cloud, scaled(s.parameters, scale), given);
    check_same_labels(shapes, expected, name);
  }
  for(double scale : {1000., .3048}) { // millimeters, feet: other bits, the same shapes
    const std::string name = s.name + ", scaled by " + std::to_string(scale);
    const Shapes shapes =
      detect_valid(name, moved(s.cloud, Kernel::Vector_3(0, 0, 0), scale), scaled(s.parameters, scale), given);
    check_counts(name, shapes, expected.number_of_shapes(), expected.number_of_parallel_groups(),
                 expected.number_of_coplanar_groups());
  }
}

void test_frames()
{
  const Subject subjects[] = {make_subject("cube", scene_options(6000, .001), .0071, 60),
                              make_subject("staircase", scene_options(6000), .011, 60),
                              make_subject("house", scene_options(15000, .0005, .05), .05, 60)};
  for(const Subject& s : subjects) {
    const bool is_clean = s.name != "house";
    const Shapes expected = detect_valid(s.name, s.cloud, s.parameters);
    CHECK_AT(expected.number_of_shapes() >= 6, s.name);
    test_flipped_normals(s, expected);
    test_translation(s, expected, Given::normals);
    if(!is_clean)
      continue;
    test_scale(s, expected, Given::normals);
    const Shapes estimated = detect_valid(s.name + " without normals", s.cloud, s.parameters, Given::nothing);
    test_translation(s, estimated, Given::nothing);
    test_scale(s, estimated, Given::nothing);
  }
}

// The same counts in every direction, and far from the origin, where doubles are coarse.
void test_rotation()
{
  for(double t : {0., .1, .35, 1., 3.})
    for(double far : {0., 4.5e6}) {
      const scenes::Scene scene =
        scenes::make_scene(scenes::make_cube(scenes::Frame().turned({3, -2, 1 + t}, t)), scene_options(6000, .001));
      const std::string name = "cube turned by " + std::to_string(t) + " at " + std::to_string(far);
      const Cloud cloud = moved(to_cloud(scene), Kernel::Vector_3(far / 9, far, 100));
      check_counts(name, detect_valid(name, cloud, make_parameters(.007, 60)), 6, 3, 6);
      check_counts(name + " without normals", detect_valid(name, cloud, make_parameters(.007, 60), Given::nothing), 6,
                   3, 6);
    }
}

void test_additions()
{
  const Subject s = make_subject("staircase", scene_options(6000), .01, 60);
  const Shapes expected = detect(s.cloud, s.parameters);
  Subject twice = s;
  for(const auto& item : moved(s.cloud, Kernel::Vector_3(300, -200, 50)))
    twice.cloud.push_back(item);
  const Shapes two = detect_valid("two staircases", twice.cloud, s.parameters);
  check_counts("two staircases", two, 2 * expected.number_of_shapes(), expected.number_of_parallel_groups(),
               2 * expected.number_of_coplanar_groups());
  Subject stray = s;
  Random random(4);
  for(int i = 0; i < 60; ++i) {
    const Vec p = 500 * random.direction(), n = random.direction();
    add(stray.cloud, p, n);
  }
  const Shapes shapes = detect_valid("staircase and far points", stray.cloud, s.parameters);
  check_counts("staircase and far points", shapes, 16, 2, 16);
  for(std::size_t i = s.cloud.size(); i < stray.cloud.size(); ++i)
    CHECK_AT(shapes.shape_index(i) == -1, "far point " + std::to_string(i));
}

// Counts how often each item is read.
template <class Value, Value Cloud::value_type::*member>
struct Counting_map {
  using key_type = Cloud::value_type;
  using value_type = Value;
  using reference = const Value&;
  using category = boost::readable_property_map_tag;
  const Cloud* cloud;
  std::shared_ptr<std::vector<int>> reads;

  friend reference get(const Counting_map& map, const key_type& item)
  {
    ++(*map.reads)[std::size_t(&item - map.cloud->data())];
    return item.*member;
  }
};

void test_hands_off()
{
  using Pair_type = Cloud::value_type;
  const Subject s = make_subject("house", scene_options(5000, .001, .1), .08, 40);
  const Cloud before = s.cloud;
  const Counting_map<Kernel::Point_3, &Pair_type::first> points = {
    &s.cloud, std::make_shared<std::vector<int>>(s.cloud.size(), 0)};
  const Counting_map<Kernel::Vector_3, &Pair_type::second> normals = {
    &s.cloud, std::make_shared<std::vector<int>>(s.cloud.size(), 0)};
  const auto list = CGAL::Tandem::parameters::settings(s.parameters).point_map(points);
  CGAL::Tandem::detect_planes(s.cloud, list.normal_map(normals));
  CHECK(std::memcmp(before.data(), s.cloud.data(), before.size() * sizeof before[0]) == 0);
  CHECK(std::count(points.reads->begin(), points.reads->end(), 1) == long(s.cloud.size()));
  CHECK(std::count(normals.reads->begin(), normals.reads->end(), 1) == long(s.cloud.size()));
  CGAL::Tandem::detect_planes(s.cloud, list);
  CHECK(std::memcmp(before.data(), s.cloud.data(), before.size() * sizeof before[0]) == 0);
  CHECK(std::count(points.reads->begin(), points.reads->end(), 2) == long(s.cloud.size()));
}

// Whatever the parameters are, all promises hold. An argument is the seed to try again.
void test_random_cases(std::uint64_t seed)
{
  for(std::uint64_t round = seed; round < seed + 24; ++round) {
    const Random_case c = make_random_case(round, 4000);
    detect_valid(c.name, c.cloud, c.parameters, c.given);
  }
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  test_random_cases(argument(1, 1));
  test_frames();
  test_rotation();
  test_additions();
  test_hands_off();
}

BOOST_AUTO_TEST_SUITE_END()
