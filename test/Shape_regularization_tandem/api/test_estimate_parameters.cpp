// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The estimate follows the noise, the spacing and the unit of a cloud, and not the order of its points. It knows the
// noise: of surfaces next to others, of low roofs, of copies and of depth in steps, and with points that are far from all
// others. What is given is kept. Tolerances of points follow the noise about them.

#include "testing/box_cloud.h"
#include "testing/noisy_clouds.h"

#include <CGAL/Shape_regularization_tandem/estimate_local_distances.h>
#include <CGAL/Shape_regularization_tandem/estimate_noise.h>
#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>

#include <numeric>

BOOST_AUTO_TEST_SUITE(test_estimate_parameters)

namespace np = CGAL::Tandem::parameters;
using namespace noisy_clouds;
using CGAL::Tandem::estimate_local_distances;
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

Points make_points(int points_a_face, float noise)
{
  Points points;
  for(const auto& p : make_pairs<Kernel>(make_box_cloud(points_a_face, noise)))
    points.push_back(p.first);
  return points;
}

Points transformed(const Points& points, double scale, const Kernel::Vector_3& shift)
{
  Points out;
  for(const auto& p : points)
    out.push_back(CGAL::ORIGIN + (scale * (p - CGAL::ORIGIN) + shift));
  return out;
}

double distance_of(const Points& points) { return estimate_parameters(points).maximum_distance; }

bool is_near(double a, double b, double tolerance) { return std::fabs(a - b) <= tolerance * b; }

BOOST_AUTO_TEST_CASE(test_rule)
{
  // Uniform on a triangle-shaped distribution of +-noise: sigma = noise / sqrt(6).
  for(float noise : {.004f, .04f})
    CHECK_AT(is_near(distance_of(make_points(10000, noise)), 3 * noise / std::sqrt(6.), .25), std::to_string(noise));
  // Without noise it is a share of the spacing that grows with the number of points.
  for(int n : {1500, 6000}) {
    const double share = .017 * std::pow(6.6 * n, 5. / 16);
    CHECK_AT(is_near(distance_of(make_points(n, 0)), share * std::sqrt(.63 / n), .3), std::to_string(n));
  }
  const Points points = make_points(1500, .002f);
  CHECK(estimate_parameters(points).minimum_region_size == std::size_t(.3 * std::sqrt(double(points.size())) + .5));
  CHECK(estimate_parameters(points).maximum_offset == distance_of(points));
}

BOOST_AUTO_TEST_CASE(test_motions)
{
  Points points = make_points(1500, .002f);
  const double distance = distance_of(points);
  std::mt19937 random(3);
  std::shuffle(points.begin(), points.end(), random);
  CHECK(distance_of(points) == distance);
  CHECK(estimate_parameters<CGAL::Sequential_tag>(points).maximum_distance == distance);
  CHECK(distance_of(transformed(points, 1024, {0, 0, 0})) == 1024 * distance);
  CHECK(distance_of(transformed(points, .0078125, {0, 0, 0})) == .0078125 * distance);
  CHECK(is_near(distance_of(transformed(points, .3048, {0, 0, 0})), .3048 * distance, .05));
  CHECK(is_near(distance_of(transformed(points, 1, {500000, 4500000, 100})), distance, .05));
}

BOOST_AUTO_TEST_CASE(test_given)
{
  const Points points = make_points(300, .002f);
  const auto p = estimate_parameters(points, np::maximum_distance(.5).k_neighbors(20).cell_size(100));
  CHECK(p.maximum_distance == .5 && p.maximum_offset == .5 && p.k_neighbors == 20 && p.cell_size == 100);
  const auto q = estimate_parameters(points, np::maximum_offset(0.).minimum_region_size(77).maximum_angle(30));
  CHECK(q.maximum_offset == 0 && q.minimum_region_size == 77 && q.maximum_angle == 30 && q.maximum_distance > 0);
  CGAL::Tandem::Parameters settings;
  settings.maximum_offset = .25;
  settings.angle_tolerance = 3;
  const auto r = estimate_parameters(points, np::settings(settings).angle_tolerance(4));
  CHECK(r.maximum_offset == .25 && r.angle_tolerance == 4);
}

// Names that some versions of CGAL have, and that this package adds to the others.
BOOST_AUTO_TEST_CASE(test_names_of_cgal)
{
  const Points points = make_points(300, .002f);
  const CGAL::Identity_property_map<Kernel::Point_3> map;
  const auto p = estimate_parameters(points, CGAL::parameters::maximum_distance(.5).point_map(map));
  CHECK(p.maximum_distance == .5);
  CHECK(estimate_parameters(points, CGAL::parameters::minimum_region_size(77)).minimum_region_size == 77);
  CHECK(estimate_parameters(points, CGAL::parameters::k_neighbors(20)).k_neighbors == 20);
  CHECK(estimate_parameters(points, CGAL::parameters::angle_tolerance(4)).angle_tolerance == 4);
  CHECK(estimate_parameters(points, CGAL::parameters::all_default()).angle_tolerance == 8);
}

BOOST_AUTO_TEST_CASE(test_degenerate)
{
  CHECK(distance_of({}) > 0);
  CHECK(distance_of({{1, 2, 3}}) > 0);
  CHECK(distance_of(Points(50, {0, 0, 0})) > 0);
  CHECK(distance_of(Points(50, {1e200, 0, 0})) > 0);
  CHECK(distance_of(Points(50, {1e300, 0, 0})) == 1e270); // the largest that is allowed
  CHECK(distance_of({{0, 0, 0}, {1, 0, 0}}) > 0);
  const Points points = make_points(300, .002f);
  for(double unit : {1e-322, 1e-300, 1e-280})
    CHECK_AT(distance_of(transformed(points, unit, {0, 0, 0})) == 1e-270, std::to_string(std::log10(unit)));
  CHECK(distance_of(transformed(points, 1e276, {0, 0, 0})) == 1e270);
  for(double x : {1e290, 1e308, 1.7e308})
    check_throws<std::range_error>(
      [&] {
        distance_of({{x, 0, 0}, {-x, 0, 0}, {0, x, 0}});
      },
      {"extent", "2^24 times the largest maximum_distance"}, __LINE__);
  CHECK(estimate_parameters(Points()).minimum_region_size >= 3);
}

// Noise from a tenth of the spacing to ten times the spacing.
BOOST_AUTO_TEST_CASE(test_noise)
{
  unsigned seed = 0;
  for(const double noise_per_spacing : {.1, .3, 1., 3., 10.}) {
    Random random(++seed);
    const Pose pose(seed, scales[seed % 4]);
    const std::size_t n = 15000;
    const double side = std::sqrt(double(n)), noise = noise_per_spacing * .977;
    Points plane;
    add_patch(plane, n, {{0, 0, 0}, {side, 0, 0}, {0, side, 0}}, noise, random);
    CHECK_BETWEEN(estimate_noise(pose(plane)) / noise, .75, noise_per_spacing < 5 ? 1.25 : 1.5, pose.scale,
                  name("plane", noise_per_spacing, seed));
    const double area = 4 * 3 + 4 * 2.5 + 3 * 2.5, of_room = noise * std::sqrt(area / double(n));
    if(noise_per_spacing < 5)
      CHECK_BETWEEN(estimate_noise(pose(room(n, of_room, random))) / of_room, .75, 1.3, pose.scale,
                    name("room", noise_per_spacing, seed));
  }
}

using Oriented = std::pair<Point, Vector>;

// Two sides of a wall, .12 apart.
BOOST_AUTO_TEST_CASE(test_sheets)
{
  for(unsigned seed = 1; seed <= 2; ++seed) {
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
    const double distance = estimate_parameters(oriented,
                                                np::point_map(CGAL::First_of_pair_property_map<Oriented>())
                                                  .normal_map(CGAL::Second_of_pair_property_map<Oriented>()),
                                                &estimate)
                              .maximum_distance;
    CHECK_BETWEEN(distance, .01, .03, pose.scale, name("oriented sheets", 0, seed));
    CHECK_AT(estimate.note.empty() && !estimate.noise_varies, estimate.note);
  }
}

BOOST_AUTO_TEST_CASE(test_ridges)
{
  for(unsigned seed = 1; seed <= 2; ++seed)
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
    for(const int copies : {4, 15}) {
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
BOOST_AUTO_TEST_CASE(test_points_far_away)
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
  for(const int width : {120, 200})
    for(const double end : {4.5, 5.5}) {
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
  for(unsigned seed = 1; seed <= 2; ++seed) {
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

// A corridor and its tolerances, in units of the true noise.
struct Measured_corridor {
  Corridor corridor;
  std::vector<double> ratio;

  Measured_corridor(int width, int height, Random& random)
    : corridor(width, height, 5, random), ratio(estimate_local_distances(corridor.points))
  {
    const double per_noise = CGAL::Tandem::internal::tuning::estimation::local_margin * distance_of(corridor.points) /
                             estimate_noise(corridor.points);
    for(std::size_t i = 0; i < ratio.size(); ++i)
      ratio[i] /= per_noise * corridor.noise[i];
  }

  // Mean and mean absolute error of the points that are chosen.
  template <class F>
  std::array<double, 2> compare(F is_chosen) const
  {
    double sum = 0, error = 0, count = 0;
    for(std::size_t i = 0; i < ratio.size(); ++i)
      if(is_chosen(i)) {
        sum += ratio[i];
        error += std::fabs(ratio[i] - 1);
        ++count;
      }
    return {sum / count, error / count};
  }
};

BOOST_AUTO_TEST_CASE(test_local_in_corridor)
{
  Random random(1);
  const Measured_corridor measured(200, 150, random);
  const Corridor& corridor = measured.corridor;
  const auto depth = [&](std::size_t i) { return corridor.points[i].z(); };
  for(const double z : {2.2, 2.6, 3., 3.4, 3.8}) {
    const auto [mean, error] = measured.compare([&](std::size_t i) { return depth(i) >= z && depth(i) < z + .4; });
    CHECK_AT(mean > .85 && mean < 1.15 && error < .15,
             std::to_string(z) + ": " + std::to_string(mean) + ", " + std::to_string(error));
  }
  const auto is_inner = [&](std::size_t i) {
    return corridor.is_end[i] && std::fabs(corridor.points[i].x()) < .8 && std::fabs(corridor.points[i].y()) < .8;
  };
  const auto [mean, error] = measured.compare(is_inner);
  CHECK_AT(mean > .75 && mean < 1.25, "end wall: " + std::to_string(mean) + ", " + std::to_string(error));
}

// Where the noise is the same everywhere, so are the tolerances, and they are that of the cloud.
BOOST_AUTO_TEST_CASE(test_local_of_even_noise)
{
  Random random(3);
  const Points points = Pose(3, 100)(room(12000, .004, random));
  const double distance = distance_of(points);
  for(const double d : estimate_local_distances(points))
    CHECK_AT(d > .7 * distance && d < 1.3 * distance, std::to_string(d / distance));
}

// The values of the points, and not their order, count.
BOOST_AUTO_TEST_CASE(test_order_local)
{
  Random random(4);
  const Corridor corridor(80, 60, 5, random);
  const std::vector<double> distance = estimate_local_distances(corridor.points);
  CHECK(estimate_local_distances<CGAL::Sequential_tag>(corridor.points) == distance);
  const Points reversed(corridor.points.rbegin(), corridor.points.rend());
  std::vector<double> again = estimate_local_distances(reversed);
  std::reverse(again.begin(), again.end());
  CHECK(again == distance);
}

BOOST_AUTO_TEST_CASE(test_degenerate_local)
{
  CHECK(estimate_local_distances(Points()).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto distance = estimate_local_distances(Points{{0, 0, 0}, {nan, 0, 0}, {1, 0, 0}});
  CHECK(distance.size() == 3 && distance[0] > 0 && std::isnan(distance[1]) && distance[2] == distance[0]);
  for(const double d : estimate_local_distances(Points(50, {1, 2, 3})))
    CHECK(d > 0);
  // Without noise all have the same.
  Random random(6);
  const Points points = room(3000, 0, random);
  const double estimate = distance_of(points);
  for(const double d : estimate_local_distances(points))
    CHECK(d == estimate);
}

BOOST_AUTO_TEST_SUITE_END()
