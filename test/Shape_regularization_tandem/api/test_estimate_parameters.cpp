// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The estimate follows the noise, the spacing and the unit of a cloud, and not the order of its points. It knows the
// noise: of surfaces next to others, of low roofs, of copies and of depth in steps. What is given is kept. Tolerances
// of points follow the noise about them.

#include "api_support.h"
#include "testing/tolerances.h"

#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>

#include <functional>
#include <map>

BOOST_AUTO_TEST_SUITE(test_estimate_parameters)

using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Points = std::vector<Point>;
using scenes::Random;
using scenes::Vec;
using Tag = CGAL::Sequential_tag;
using CGAL::Tandem::estimate_local_distances;
using CGAL::Tandem::estimate_noise;
using CGAL::Tandem::estimate_parameters;

struct Estimate : CGAL::Tandem::Distance_estimate {
  Parameters parameters;
  double distance;

  explicit Estimate(const Points& points)
    : parameters(estimate_parameters<Tag>(points, CGAL::parameters::Default_named_parameters(), this)),
      distance(parameters.maximum_distance)
  {}
  bool mentions(const std::string& word) const { return note.find(word) != std::string::npos; }
};

double distance_of(const Points& points) { return Estimate(points).distance; }

Points points_of(const Cloud& cloud)
{
  Points points;
  for(const auto& p : cloud)
    points.push_back(p.first);
  return points;
}

Points make_points(int points_a_face, float noise)
{
  return points_of(make_pairs<Kernel>(make_box_cloud(points_a_face, noise)));
}

Points transformed(const Points& points, double scale, const Vector& shift)
{
  Points out;
  for(const auto& p : points)
    out.push_back(CGAL::ORIGIN + (scale * (p - CGAL::ORIGIN) + shift));
  return out;
}

// Turned and moved as a seed says, and scaled.
Points posed(Points points, unsigned seed, double scale)
{
  Random random(seed);
  const scenes::Frame frame = scenes::Frame().turned(random.direction(), .7).at(50 * random.direction());
  for(Point& p : points) {
    const Vec q = frame.point({p.x(), p.y(), p.z()});
    p = {q.x, q.y, q.z};
  }
  return transformed(points, scale, {0, 0, 0});
}

void check_near(double value, double expected, double tolerance, const std::string& what)
{
  check_close(value, expected, tolerance * expected, what);
}

BOOST_AUTO_TEST_CASE(test_rule)
{
  // Uniform on a triangle-shaped distribution of +-noise: sigma = noise / sqrt(6).
  check_near(distance_of(make_points(10000, .04f)), 3 * .04 / std::sqrt(6.), .25, "of noise");
  // Without noise it is a fraction of the spacing that grows with the number of points.
  for(int n : {1500, 6000})
    check_near(distance_of(make_points(n, 0)), .019 * std::pow(6.6 * n, 5. / 16) * std::sqrt(.63 / n), .3,
               "of spacing");
  const Points points = make_points(1500, .002f);
  const Estimate estimate(points);
  CHECK(estimate.parameters.minimum_region_size == std::size_t(.3 * std::sqrt(double(points.size())) + .5));
  CHECK(estimate.parameters.maximum_offset == estimate.distance);
}

BOOST_AUTO_TEST_CASE(test_motions)
{
  Points points = make_points(1500, .002f);
  const double distance = distance_of(points);
  std::shuffle(points.begin(), points.end(), std::mt19937(3));
  CHECK(distance_of(points) == distance);
  CHECK(estimate_parameters(points).maximum_distance == distance); // by threads
  CHECK(distance_of(transformed(points, 1024, {0, 0, 0})) == 1024 * distance);
  CHECK(distance_of(transformed(points, .0078125, {0, 0, 0})) == .0078125 * distance);
  check_near(distance_of(transformed(points, .3048, {0, 0, 0})), .3048 * distance, .05, "in feet");
  check_near(distance_of(transformed(points, 1, {500000, 4500000, 100})), distance, .05, "far away");
}

// In their own names, which count before settings.
BOOST_AUTO_TEST_CASE(test_given)
{
  Parameters settings;
  settings.simplicity = .02;
  settings.angle_tolerance = 3;
  const std::vector<Vector> directions = {{1, 2, 3}};
  const auto lengths = np::settings(settings).maximum_distance(.5).maximum_offset(0.).maximum_angle(30);
  const auto sizes = lengths.angle_tolerance(4).minimum_region_size(77).regularity(.3).surfel_size(.1).k_neighbors(20u);
  const auto switches =
    sizes.regularize_parallelism(false).regularize_orthogonality(true).regularize_coplanarity(false);
  const auto list = switches.cell_size(100).fixed_directions(directions).symmetry_direction(Vector(3, 2, 1));
  const Parameters p = estimate_parameters<Tag>(make_points(300, .002f), list);
  CHECK(p.maximum_distance == .5 && p.maximum_angle == 30 && p.angle_tolerance == 4 && p.maximum_offset == 0);
  CHECK(p.minimum_region_size == 77 && p.simplicity == .02 && p.regularity == .3 && p.surfel_size == .1);
  CHECK(p.k_neighbors == 20 && p.cell_size == 100 && !p.regularize_parallelism && p.regularize_orthogonality);
  CHECK(!p.regularize_coplanarity && p.regularize_axis_symmetry);
  using Direction = std::array<double, 3>;
  CHECK(p.fixed_directions == std::vector<Direction>({{1, 2, 3}}) && p.symmetry_direction == (Direction{3, 2, 1}));
}

// Names that some versions of CGAL have, and that this package adds to the others: each begins a list.
BOOST_AUTO_TEST_CASE(test_names_of_cgal)
{
  const auto estimate = [](const auto& list) { return estimate_parameters<Tag>(Points(), list); };
  CHECK(estimate(CGAL::parameters::maximum_distance(.5)).maximum_offset == .5);
  CHECK(estimate(CGAL::parameters::minimum_region_size(77)).minimum_region_size == 77);
  CHECK(estimate(CGAL::parameters::k_neighbors(20)).k_neighbors == 20);
  CHECK(estimate(CGAL::parameters::angle_tolerance(4)).angle_tolerance == 4);
}

BOOST_AUTO_TEST_CASE(test_degenerate)
{
  for(const Points& points :
      {Points(), Points{{1, 2, 3}}, Points(50, {0, 0, 0}), Points(50, {1e200, 0, 0}), Points{{0, 0, 0}, {1, 0, 0}}})
    CHECK(distance_of(points) > 0);
  CHECK(distance_of(Points(50, {1e300, 0, 0})) == 1e270); // the largest that is allowed
  const Points points = make_points(300, .002f);
  for(double unit : {1e-322, 1e-300, 1e-280})
    CHECK_AT(distance_of(transformed(points, unit, {0, 0, 0})) == 1e-270, std::to_string(std::log10(unit)));
  CHECK(distance_of(transformed(points, 1e276, {0, 0, 0})) == 1e270);
  for(double x : {1e290, 1e308, 1.7e308}) {
    const Points wide = {{x, 0, 0}, {-x, 0, 0}, {0, x, 0}};
    check_throws<std::range_error>([&] { distance_of(wide); }, {"extent", "2^24 times the largest maximum_distance"},
                                   __LINE__);
  }
  CHECK(Estimate(Points()).parameters.minimum_region_size >= 3);
}

struct Parallelogram {
  Vec origin, u, v;
};

// n points of a parallelogram.
void add_patch(Points& points, std::size_t n, const Parallelogram& patch, double noise, Random& random)
{
  const Vec normal = unit(cross(patch.u, patch.v));
  for(std::size_t i = 0; i < n; ++i) {
    const double a = random.uniform(), b = random.uniform(), c = noise * random.gaussian();
    const Vec p = patch.origin + a * patch.u + b * patch.v + c * normal;
    points.emplace_back(p.x, p.y, p.z);
  }
}

// Floor and two walls.
Points room(std::size_t n, double noise, Random& random)
{
  Points points;
  for(const Parallelogram& patch : {Parallelogram{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}},
                                    {{0, 3, 0}, {4, 0, 0}, {0, 0, 2.5}},
                                    {{4, 0, 0}, {0, 3, 0}, {0, 0, 2.5}}})
    add_patch(points, n / 3, patch, noise, random);
  return points;
}

// Noise from a tenth of the spacing to ten times the spacing, within the factors that the manual has.
BOOST_AUTO_TEST_CASE(test_noise)
{
  unsigned seed = 0;
  for(const double noise_per_spacing : {.1, .3, 1., 3., 10.}) {
    Random random(++seed);
    const double scale = seed % 2 == 0 ? 1000 : .01;
    const auto check = [&](const Points& points, double noise, double most) {
      const double ratio = estimate_noise<Tag>(posed(points, seed, scale)) / noise / scale;
      CHECK_AT(ratio > 1 / most && ratio < most, std::to_string(noise_per_spacing) + ": " + std::to_string(ratio));
    };
    const std::size_t n = 15000;
    const double width = std::sqrt(double(n)), noise = noise_per_spacing * .977;
    Points plane;
    add_patch(plane, n, {{0, 0, 0}, {width, 0, 0}, {0, width, 0}}, noise, random);
    check(plane, noise, noise_per_spacing < 5 ? 1.25 : 1.5);
    const double area = 4 * 3 + 4 * 2.5 + 3 * 2.5, of_room = noise * std::sqrt(area / double(n));
    if(noise_per_spacing < 5)
      check(room(n, of_room, random), of_room, 1.3);
    CHECK(estimate_noise<Tag>(room(6000, 0, random)) < 1e-6);
  }
}

// Two sides of a wall, .12 apart.
Points sheets(Random& random)
{
  Points points;
  for(const double y : {0., .12})
    add_patch(points, 2000, {{0, y, 0}, {4, 0, 0}, {0, 0, 2.5}}, .005, random);
  return points;
}

// Copies of points that are rounded to a hundredth, also such that are not exact.
Points rounded_copies(int copies, double jitter, Random& random)
{
  const auto rounded = [](double c) { return std::round(100 * c) / 100; };
  Points all;
  for(const Point& p : room(900, .004, random))
    for(int i = 0; i < copies; ++i) {
      const Vec d = jitter * random.gaussian_vector();
      all.emplace_back(rounded(p.x()) + d.x, rounded(p.y()) + d.y, rounded(p.z()) + d.z);
    }
  return all;
}

// A low roof of two sides that are 4 degrees apart.
Points ridge(std::size_t n, Random& random)
{
  Points points;
  for(std::size_t i = 0; i < n; ++i) {
    const double x = 12 * random.uniform() - 6, y = 10 * random.uniform();
    points.emplace_back(x, y, 5 - std::fabs(x) * .03492 + .01 * random.gaussian());
  }
  return points;
}

// A tilted plane whose height is rounded to steps, with noise of a fifth of one.
Points steps(double step, double slope, Random& random)
{
  Points points;
  for(int i = 0; i < 80; ++i)
    for(int j = 0; j < 80; ++j) {
      const double x = i / 39.5, y = j / 39.5;
      points.emplace_back(x, y, step * std::round((slope * x + .31 * slope * y) / step + .2 * random.gaussian()));
    }
  return points;
}

// The distance, in the unit of the points, and what its note mentions: null where there is none. Of steps it covers
// most of one, and not two.
BOOST_AUTO_TEST_CASE(test_scenes)
{
  struct Scene {
    const char* name;
    std::function<Points(Random&)> make;
    double low, high;
    const char* note;
  };
  const auto steps_of = [](double step, double slope) {
    return [=](Random& random) { return steps(step, slope, random); };
  };
  const auto copies_of = [](int copies, double jitter) {
    return [=](Random& random) { return rounded_copies(copies, jitter, random); };
  };
  const auto ridge_of = [](std::size_t n) { return [=](Random& random) { return ridge(n, random); }; };
  const auto corridor = [](Random& random) { return points_of(Corridor(200, 150, 4.5, random).cloud); };
  const std::vector<Scene> all = {{"sheets", sheets, .01, .03, "a second one"},
                                  {"small ridge", ridge_of(2500), .022, .045, nullptr},
                                  {"large ridge", ridge_of(20000), .022, .045, nullptr},
                                  {"coarse steps", steps_of(.06, .0875), .048, .096, "steps"},
                                  {"fine steps", steps_of(.0285, .1405), .0228, .0456, "steps"},
                                  {"exact copies", copies_of(4, 0), .008, .03, ""},
                                  {"copies", copies_of(15, 1e-5), .008, .03, ""},
                                  {"rough copies", copies_of(15, 1e-3), .008, .03, ""},
                                  {"corridor", corridor, .03, .16, "varies"}};
  for(const Scene& scene : all)
    for(unsigned seed = 1; seed <= 2; ++seed) {
      Random random(seed);
      const double scale = seed == 1 ? 1000 : .01;
      const Estimate estimate(posed(scene.make(random), seed, scale));
      const double plain = estimate.distance / scale;
      const std::string what = scene.name + (": " + std::to_string(plain) + ", " + estimate.note);
      CHECK_AT(plain >= scene.low && plain <= scene.high, what);
      CHECK_AT(scene.note == nullptr ? estimate.note.empty() : estimate.mentions(scene.note), what);
      CHECK_AT(estimate.noise_varies == (std::string(scene.name) == "corridor"), what);
    }
}

// Houses with gable roofs on one ground, 12 points a square unit.
Points village(int houses, double noise, Random& random)
{
  Points points;
  for(int i = 0; i < houses; ++i) {
    const double x = 25 * (i % 6), y = 25 * (i / 6), ridge = 5 + 4 * random.uniform();
    const auto add = [&](const Parallelogram& patch) {
      add_patch(points, std::size_t(12 * length(cross(patch.u, patch.v))), patch, noise, random);
    };
    add({{x, y, 5}, {9, 0, 0}, {0, 4, ridge - 5}});
    add({{x, y + 8, 5}, {9, 0, 0}, {0, -4, ridge - 5}});
    add({{x + 9, y - 8, 0}, {16, 0, 0}, {0, 25, 0}});
    add({{x, y - 8, 0}, {9, 0, 0}, {0, 8, 0}});
    add({{x, y + 8, 0}, {9, 0, 0}, {0, 9, 0}});
  }
  return points;
}

// A roof has nearly one tolerance, of however many the tile is, and its minimum size does not grow with a large tile.
BOOST_AUTO_TEST_CASE(test_tiles)
{
  for(unsigned seed = 1; seed <= 3; ++seed) {
    const double noise = .015 + .01 * seed;
    Random random(seed);
    const double one = distance_of(posed(village(1, noise, random), seed, 1));
    check_near(one, 2.8 * noise, .12, "one house");
    for(const int houses : {4, 16})
      check_near(distance_of(posed(village(houses, noise, random), seed, 1)), one, .2, std::to_string(houses));
    const Points large = village(48, noise, random);
    const Parameters p = Estimate(large).parameters;
    check_near(p.maximum_distance, one, .2, "large");
    const double spacing = .28, size = 400 * p.maximum_distance / spacing;
    check_near(double(p.minimum_region_size), (std::max)(100., size), .1, "minimum size");
    // The same, if the distance is given.
    CHECK(estimate_parameters<Tag>(large, CGAL::parameters::maximum_distance(p.maximum_distance)).minimum_region_size ==
          p.minimum_region_size);
  }
}

// Trees beside a roof are noisy, but they do not vary as the range does, and the tolerance is not theirs.
BOOST_AUTO_TEST_CASE(test_trees)
{
  for(unsigned seed = 1; seed <= 3; ++seed) {
    Random random(seed);
    Points points = village(3, .03, random);
    for(int i = 0; i < 4500; ++i) {
      Vec d = unit(random.gaussian_vector());
      d = (3 - .35 * std::fabs(random.gaussian())) * Vec{d.x, d.y, .8 * std::fabs(d.z)};
      points.emplace_back(d.x + 16 + 25 * (i % 3), d.y - 4, d.z + 5);
    }
    const Estimate estimate(posed(points, seed, 1));
    CHECK_AT(!estimate.noise_varies && estimate.distance < .35, std::to_string(estimate.distance));
  }
}

// Where normals tell the sides of a wall from each other, nothing is near them.
BOOST_AUTO_TEST_CASE(test_oriented_sheets)
{
  Random random(1);
  Cloud oriented;
  for(const Point& p : sheets(random))
    oriented.emplace_back(p, Vector(0, p.y() < .06 ? -1 : 1, 0));
  CGAL::Tandem::Distance_estimate estimate;
  check_near(estimate_parameters<Tag>(oriented, maps, &estimate).maximum_distance, .02, .5, "oriented sheets");
  CHECK_AT(estimate.note.empty() && !estimate.noise_varies, estimate.note);
}

// The tolerances of the points of a corridor, in units of the true noise. The end wall is apart from its edges.
BOOST_AUTO_TEST_CASE(test_local_in_corridor)
{
  Random random(1);
  const Corridor corridor(200, 150, 5, random);
  const Points points = points_of(corridor.cloud);
  const std::vector<double> distance = estimate_local_distances<Tag>(points);
  const double per_noise =
    CGAL::Tandem::internal::tuning::estimation::local_margin * distance_of(points) / estimate_noise<Tag>(points);
  std::map<int, std::array<double, 3>> sums; // by depth; 0: the end wall. Of points, ratios, errors.
  for(std::size_t i = 0; i < points.size(); ++i) {
    const double z = points[i].z(), to_wall = std::fabs(corridor.cloud[i].second * (points[i] - CGAL::ORIGIN));
    const double ratio = distance[i] / (per_noise * .0028 * z * to_wall); // noise along the ray is .0028 z^2
    const bool is_inner = corridor.label[i] == 4 && std::fabs(points[i].x()) < .8 && std::fabs(points[i].y()) < .8;
    if(!is_inner && !(z >= 2.2 && z < 4.2))
      continue;
    auto& [count, sum, error] = sums[is_inner ? 0 : int(z / .4)];
    ++count;
    sum += ratio;
    error += std::fabs(ratio - 1);
  }
  CHECK(sums.size() == 7);
  for(const auto& [depth, s] : sums)
    CHECK_AT(std::fabs(s[1] / s[0] - 1) < (depth > 0 ? .15 : .25) && (depth == 0 || s[2] / s[0] < .15),
             std::to_string(depth) + ": " + std::to_string(s[1] / s[0]) + ", " + std::to_string(s[2] / s[0]));
}

// Where the noise is the same everywhere, so are the tolerances, and they are that of the cloud. Their values, and not
// their order, count.
BOOST_AUTO_TEST_CASE(test_local_of_even_noise)
{
  Random random(3);
  const Points points = posed(room(12000, .004, random), 3, 100), smooth = room(3000, 0, random);
  const std::vector<double> distance = estimate_local_distances<Tag>(points);
  const double expected = distance_of(points);
  for(const double d : distance)
    check_near(d, expected, .3, "tolerance");
  CHECK(estimate_local_distances<Tag>(smooth) == std::vector<double>(smooth.size(), distance_of(smooth)));
  std::vector<double> again = estimate_local_distances(Points(points.rbegin(), points.rend())); // by threads
  std::reverse(again.begin(), again.end());
  CHECK(again == distance);
}

BOOST_AUTO_TEST_CASE(test_degenerate_local)
{
  CHECK(estimate_local_distances<Tag>(Points()).empty());
  const auto distance = estimate_local_distances<Tag>(Points{{0, 0, 0}, {not_a_number, 0, 0}, {1, 0, 0}});
  CHECK(distance.size() == 3 && distance[0] > 0 && std::isnan(distance[1]) && distance[2] == distance[0]);
  for(const double d : estimate_local_distances<Tag>(Points(50, {1, 2, 3})))
    CHECK(d > 0);
}

BOOST_AUTO_TEST_SUITE_END()
