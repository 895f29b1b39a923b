// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The estimate knows the noise: of surfaces next to others, of low roofs, of copies and of depth in steps, and with points
// that are far from all others.

#include "testing/checks.h"
#include "testing/noisy_clouds.h"

#include <CGAL/Shape_regularization_tandem/estimate_noise.h>
#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>

#include <string>
#include <utility>

BOOST_AUTO_TEST_SUITE(test_estimated_distance)

using namespace noisy_clouds;
using CGAL::Tandem::estimate_noise;
using CGAL::Tandem::estimate_parameters;

// Whether the value is between two others times the scale.
#define CHECK_BETWEEN(value, low, high, scale, where)                                                                  \
  CHECK_AT((value) >= (low) * (scale) && (value) <= (high) * (scale),                                                  \
           (where) + ": " + std::to_string((value) / (scale)))

struct Estimate : CGAL::Tandem::Distance_estimate {
  double distance;

  explicit Estimate(const Points& points)
    : distance(estimate_parameters(points, CGAL::parameters::all_default(), this).maximum_distance)
  {}
  bool mentions(const std::string& word) const { return note.find(word) != std::string::npos; }
};

std::string name(const std::string& what, double value, unsigned seed)
{
  return what + " " + std::to_string(value) + ", seed " + std::to_string(seed);
}

constexpr double scales[] = {1, 1, 1000, .01};

// Noise from a tenth of the spacing to ten times the spacing.
BOOST_AUTO_TEST_CASE(test_noise)
{
  unsigned seed = 0;
  for(const double noise_per_spacing : {.1, .3, 1., 3., 10.})
    for(const std::size_t n : {std::size_t(30000), std::size_t(90000)}) {
      Random random(++seed);
      const Pose pose(seed, scales[seed % 4]);
      const double side = std::sqrt(double(n)), noise = noise_per_spacing * .977;
      Points plane;
      add_patch(plane, n, {{0, 0, 0}, {side, 0, 0}, {0, side, 0}}, noise, random);
      const double estimate = estimate_noise(pose(plane));
      CHECK_BETWEEN(estimate / noise, .75, noise_per_spacing < 5 ? 1.25 : 1.5, pose.scale,
                    name("plane", noise_per_spacing, seed));
      if(noise_per_spacing > 5)
        continue;
      const double area = 4 * 3 + 4 * 2.5 + 3 * 2.5, spacing = .977 * std::sqrt(area / double(n));
      const double of_room = estimate_noise(pose(room(n, noise_per_spacing * spacing, random)));
      CHECK_BETWEEN(of_room / (noise_per_spacing * spacing), .75, 1.3, pose.scale,
                    name("room", noise_per_spacing, seed));
    }
}

// Noise of three times the spacing, and faces of few points: hardly a neighborhood is thin.
BOOST_AUTO_TEST_CASE(test_noisy_faces)
{
  for(unsigned seed = 1; seed <= 3; ++seed) {
    Random random(seed);
    const Pose pose(seed + 10, scales[seed % 4]);
    const double noise = 3 * .977 * std::sqrt(29.5 / 3000);
    const double estimate = estimate_noise(pose(room(3000, noise, random)));
    CHECK_BETWEEN(estimate / noise, .7, 1.3, pose.scale, name("noisy room", noise, seed));
  }
}

using Oriented = std::pair<Point, Vector>;

// Two sides of a wall, .12 apart.
BOOST_AUTO_TEST_CASE(test_sheets)
{
  for(unsigned seed = 1; seed <= 4; ++seed) {
    Random random(seed);
    const Pose pose(seed + 20, scales[seed % 4]);
    Points points;
    for(const double y : {0., .12})
      add_patch(points, 2000, {{0, y, 0}, {4, 0, 0}, {0, 0, 2.5}}, .005, random);
    points = pose(points);
    const Estimate bare(points);
    CHECK_BETWEEN(bare.distance, .01, .03, pose.scale, name("sheets", 0, seed));
    CHECK_AT(bare.mentions("another one"), bare.note);
    std::vector<Oriented> oriented;
    for(std::size_t i = 0; i < points.size(); ++i)
      oriented.emplace_back(points[i], pose.turned({0, i < 2000 ? -1. : 1., 0}));
    CGAL::Tandem::Distance_estimate estimate;
    const double distance =
      estimate_parameters(oriented,
                          CGAL::Tandem::parameters::point_map(CGAL::First_of_pair_property_map<Oriented>())
                            .normal_map(CGAL::Second_of_pair_property_map<Oriented>()),
                          &estimate)
        .maximum_distance;
    CHECK_BETWEEN(distance, .01, .03, pose.scale, name("oriented sheets", 0, seed));
    CHECK_AT(estimate.note.empty() && !estimate.noise_varies, estimate.note);
  }
}

BOOST_AUTO_TEST_CASE(test_ridges)
{
  for(unsigned seed = 1; seed <= 4; ++seed)
    for(const std::size_t n : {std::size_t(2500), std::size_t(4000), std::size_t(20000)}) {
      Random random(seed);
      const Pose pose(seed + 40, scales[seed % 4]);
      const Estimate estimate(pose(ridge(n, 3 + seed, .01, random)));
      CHECK_BETWEEN(estimate.distance, .022, .045, pose.scale, name("ridge of", double(n), seed));
      CHECK_AT(estimate.note.empty(), estimate.note);
    }
}

// One tilted plane: epsilon covers most of a step, and not two.
BOOST_AUTO_TEST_CASE(test_steps)
{
  unsigned seed = 0;
  for(const double step : {.045, .0285, .06})
    for(const double degrees : {5., 8.}) {
      Random random(++seed);
      const Pose pose(seed + 60, scales[seed % 4]);
      const Estimate estimate(pose(steps(50 + 10 * int(seed), step, degrees, .2, random)));
      CHECK_BETWEEN(estimate.distance, .8 * step, 1.6 * step, pose.scale, name("steps of", step, seed));
      CHECK_AT(estimate.mentions("steps"), estimate.note);
    }
}

// Copies, also such that are not exact, count once.
BOOST_AUTO_TEST_CASE(test_copies)
{
  unsigned seed = 0;
  for(const double jitter : {0., 1e-7, 1e-5, 1e-3})
    for(const int copies : {4, 8, 15}) {
      Random random(++seed);
      const Pose pose(seed + 80, scales[seed % 4]);
      Points points = room(900, .004, random);
      for(Point& p : points)
        p = {std::round(100 * p.x()) / 100, std::round(100 * p.y()) / 100, std::round(100 * p.z()) / 100};
      const Estimate estimate(pose(copied(points, copies, jitter, random)));
      CHECK_BETWEEN(estimate.distance, .008, .03, pose.scale, name("copies, jitter", jitter * 1e6, seed));
    }
}

// Few points that are far from all others change nothing; many are part of the cloud.
BOOST_AUTO_TEST_CASE(test_far_points)
{
  Random random(5);
  const Points near = Pose(5, 1)(room(6000, .004, random));
  const double distance = Estimate(near).distance;
  Points far;
  for(const Point& p : near)
    far.push_back(p + Vector(694386, 5155487, 380));
  far.insert(far.end(), 20, Point(0, 0, 0));
  CHECK_BETWEEN(Estimate(far).distance, .9, 1.1, distance, std::string("zeros"));
  far.resize(6000);
  far.emplace_back(1e12, -1e9, 3);
  far.emplace_back(-1e13, 0, 3);
  CHECK_BETWEEN(Estimate(far).distance, .9, 1.1, distance, std::string("outliers"));
}

// Without noise it is a share of the spacing; bent surfaces are mentioned.
BOOST_AUTO_TEST_CASE(test_smooth)
{
  Random random(6);
  Points sphere;
  for(int i = 0; i < 20000; ++i) {
    const Vector v(random.normal(), random.normal(), random.normal());
    sphere.push_back(CGAL::ORIGIN + v / std::sqrt(v.squared_length()));
  }
  const double spacing = std::sqrt(4 * 3.14159 / 20000);
  const Estimate estimate(sphere);
  CHECK_BETWEEN(estimate.distance, .2, 1, spacing, std::string("sphere"));
  CHECK(estimate_noise(room(6000, 0, random)) < 1e-6);
}

// Noise that grows with the range varies for certain.
BOOST_AUTO_TEST_CASE(test_corridors)
{
  unsigned seed = 100;
  for(const int width : {120, 200, 320})
    for(const double end : {4.5, 5., 5.5}) {
      Random random(++seed);
      const Pose pose(seed, scales[seed % 4]);
      const Estimate estimate(pose(Corridor(width, width * 3 / 4, end, random).points));
      CHECK_BETWEEN(estimate.distance, .03, .16, pose.scale, name("corridor", end, seed));
      CHECK_AT(estimate.noise_varies && estimate.mentions("varies"),
               name("corridor", end, seed) + ": " + estimate.note);
    }
}

// What grows by little from wall to wall does not, nor does what differs between neighbors: bushes before the walls of a
// room.
BOOST_AUTO_TEST_CASE(test_other_variation)
{
  for(unsigned seed = 1; seed <= 3; ++seed) {
    Random random(seed);
    const Pose pose(seed + 120, scales[seed % 4]);
    Points scanned;
    for(const Point& p : room(30000, 0, random)) {
      const Vector ray = p - Point(1, 1, 1);
      scanned.push_back(p + .002 * (1 + std::sqrt(ray.squared_length()) / 3) * random.normal() * ray);
    }
    CHECK_AT(!Estimate(pose(scanned)).noise_varies, name("room", 0, seed));
    Points overgrown = room(30000, .002, random);
    for(int bush = 0; bush < 60; ++bush) {
      const Point center(random.uniform(0, 4), random.uniform(0, 3), random.uniform(0, 2));
      const double radius = random.uniform(.1, .4);
      for(int i = 0; i < 300; ++i)
        overgrown.push_back(center + radius * Vector(random.normal(), random.normal(), .3 * random.normal()));
    }
    CHECK_AT(!Estimate(pose(overgrown)).noise_varies, name("overgrown room", 0, seed));
  }
}

BOOST_AUTO_TEST_SUITE_END()
