// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bad data gets a result, misuse gets an exception that names the parameter, its
// value and the allowed range. An angle that may have been meant as a cosine is told in the statistics.

#include "testing/box_cloud.h"
#include "testing/measured_violation.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>

#include <limits>

BOOST_AUTO_TEST_SUITE(test_bad_input)

namespace np = CGAL::Tandem::parameters;
using CGAL::Tandem::detect_planes;
using CGAL::Tandem::estimate_parameters;

const auto positions = np::point_map(First<Epick>());
const auto maps = positions.normal_map(Second<Epick>());
const float nan_value = std::numeric_limits<float>::quiet_NaN();
const float infinite = std::numeric_limits<float>::infinity();

// A valid result with the expected number of shapes, with and without normals and parameters.
void check_answer(const std::vector<Box_point>& cloud, std::size_t shapes, const std::string& name)
{
  const Pairs<Epick> points = make_pairs<Epick>(cloud);
  const auto check = [&](const auto& list, std::size_t expected, const std::string& what) {
    const auto result = detect_planes(points, list);
    CHECK_AT(result.number_of_points() == points.size(), what);
    CHECK_AT(result.number_of_shapes() == expected, what + ": " + std::to_string(result.number_of_shapes()));
    check_equal(violation_of(points, result, list), "", what);
  };
  const auto given = maps.maximum_distance(.006).minimum_region_size(100);
  check(given, shapes, name + ", normals");
  check(given.regularize_parallelism(false).regularize_orthogonality(false).regularize_coplanarity(false), shapes,
        name + ", nothing regularized");
  check(positions.maximum_distance(.006).minimum_region_size(100), shapes, name + ", no normals");
  using Float = CGAL::Simple_cartesian<float>; // whose values are kept as floats
  const auto floats = np::point_map(First<Float>()).normal_map(Second<Float>()).maximum_distance(.006);
  CHECK_AT(detect_planes(make_pairs<Float>(cloud), floats).hash() ==
             detect_planes(points, maps.maximum_distance(.006)).hash(),
           name + ", float");
  for(const auto& result : {detect_planes(points, maps), detect_planes(points, positions)}) // with estimated parameters
    CHECK_AT(result.number_of_points() == points.size(), name);
}

std::vector<Box_point> repeat(std::size_t n, Box_point p) { return std::vector<Box_point>(n, p); }

BOOST_AUTO_TEST_CASE(test_degenerate_clouds)
{
  const Box_point p = {{1, 2, 3}, {0, 0, 1}};
  check_answer({}, 0, "empty");
  check_answer({p}, 0, "one point");
  check_answer(repeat(3, p), 0, "three equal points");
  check_answer(repeat(20, p), 0, "20 equal points");
  std::vector<Box_point> line, flat, twice = make_box_cloud(400);
  for(int i = 0; i < 3000; ++i)
    line.push_back({{.001f * float(i), .002f * float(i), -.003f * float(i)}, {2, -1, 0}});
  for(int i = 0; i < 3000; ++i)
    flat.push_back({{.01f * float(i % 60), .01f * float(i / 60), 5}, {0, 0, -3}});
  check_answer(flat, 1, "perfectly flat");
  const std::vector<Box_point> once = twice;
  twice.insert(twice.end(), once.begin(), once.end());
  check_answer(twice, 6, "exact duplicates");

  // No plane is defined; whatever the result is, it has to be valid.
  for(const auto& cloud : {line, repeat(3000, p)}) {
    const Pairs<Epick> points = make_pairs<Epick>(cloud);
    for(const auto& result : {detect_planes(points, positions), detect_planes(points, positions.maximum_distance(.01))})
      check_equal(violation_of(points, result, positions), "", "no plane is defined");
    check_equal(violation_of(points, detect_planes(points, maps), maps), "", "no plane is defined");
  }
}

// Points that cannot be used are counted and change nothing for the others.
BOOST_AUTO_TEST_CASE(test_invalid_points)
{
  const std::vector<Box_point> clean = make_box_cloud();
  std::vector<Box_point> cloud;
  std::vector<std::size_t> position;
  for(std::size_t i = 0; i < clean.size(); ++i) {
    const auto& p = clean[i].position;
    if(i % 10 == 0)
      cloud.push_back({{i % 20 ? nan_value : p[0], p[1], i % 20 ? p[2] : -infinite}, clean[i].normal});
    if(i % 15 == 0)
      cloud.push_back({p, {0, i % 30 ? 0 : nan_value, i % 45 ? 0 : infinite}});
    position.push_back(cloud.size());
    cloud.push_back(clean[i]);
  }
  const auto given = maps.maximum_distance(.006);
  const auto expected = detect_planes(make_pairs<Epick>(clean), given);
  const Pairs<Epick> points = make_pairs<Epick>(cloud);
  const auto shapes = detect_planes(points, given.minimum_region_size(expected.parameters().minimum_region_size));
  CHECK(shapes.statistics().number_of_ignored_coordinates == (clean.size() + 9) / 10);
  CHECK(shapes.statistics().number_of_ignored_normals == (clean.size() + 14) / 15);
  CHECK(shapes.statistics().number_of_points == cloud.size());
  check_equal(violation_of(points, shapes, given), "", "with invalid points");
  std::vector<std::int32_t> mapped;
  for(std::size_t i : position)
    mapped.push_back(shapes.shape_index(i));
  CHECK(shapes.hash(mapped, shapes.data().coefficients) == expected.hash());

  const std::vector<Box_point> nothing = repeat(100, {{nan_value, 0, 0}, {0, 0, 1}});
  check_answer(nothing, 0, "only invalid coordinates");
  CHECK(detect_planes(make_pairs<Epick>(repeat(100, {{0, 0, 0}, {0, 0, 0}})), given)
          .statistics()
          .number_of_ignored_normals == 100);
}

// Normals of any length mean the same.
BOOST_AUTO_TEST_CASE(test_lengths_of_normals)
{
  const std::vector<Box_point> clean = make_box_cloud(600);
  const auto given = maps.maximum_distance(.006);
  const Pairs<Epick> points = make_pairs<Epick>(clean);
  const std::uint64_t hash = detect_planes(points, given).hash();
  for(double factor : {0x1p-900, 0x1p-1, 0x1p+700, -1.}) {
    Pairs<Epick> scaled = points;
    for(auto& p : scaled)
      p.second = factor * p.second;
    CHECK_AT(detect_planes(scaled, given).hash() == hash, std::to_string(factor));
  }
}

// A plane with exact normals is found at the smallest angle, however it lies. Packing turns its normals by less.
BOOST_AUTO_TEST_CASE(test_smallest_angle)
{
  const double smallest = CGAL::Tandem::smallest_angle_deg;
  std::mt19937 random(7);
  std::normal_distribution<double> gauss(0, 1);
  for(int run = 0; run < 20; ++run) {
    const auto unit = [](const Epick::Vector_3& v) { return v / std::sqrt(v.squared_length()); };
    const Epick::Vector_3 normal = unit({gauss(random), gauss(random), gauss(random)});
    const Epick::Vector_3 u = unit(CGAL::cross_product(normal, {gauss(random), gauss(random), gauss(random)}));
    const Epick::Vector_3 v = CGAL::cross_product(normal, u);
    Pairs<Epick> points;
    for(int i = 0; i < 2000; ++i)
      points.push_back({CGAL::ORIGIN + double(random_unit(random)) * u + double(random_unit(random)) * v, normal});
    const auto given = maps.maximum_distance(run % 2 ? .02 : .2);
    const auto shapes = detect_planes(points, given.maximum_angle(smallest));
    CHECK_AT(shapes.number_of_shapes() == 1 && shapes.statistics().coverage == 1, std::to_string(run));
    check_equal(violation_of(points, shapes, given.maximum_angle(smallest)), "", std::to_string(run));
  }
}

template <class NP>
void check_refused(const NP& list, std::initializer_list<const char*> words, int line)
{
  const Pairs<Epick> points = make_pairs<Epick>(make_box_cloud(50));
  const Pairs<Epick> none;
  const auto all = list.point_map(First<Epick>());
  check_throws<std::invalid_argument>([&] { detect_planes(points, all); }, words, line);
  check_throws<std::invalid_argument>([&] { detect_planes(none, all); }, words, line);
  check_throws<std::invalid_argument>([&] { estimate_parameters(points, all); }, words, line);
}

BOOST_AUTO_TEST_CASE(test_misuse)
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for(const double wrong : {0., -.5, nan, inf})
    check_refused(np::maximum_distance(wrong),
                  {"maximum_distance", CGAL::Tandem::to_text(wrong).c_str(), "(0, infinity)"}, __LINE__);
  for(const double wrong : {0., .005, 90., nan})
    check_refused(np::maximum_angle(wrong), {"maximum_angle", CGAL::Tandem::to_text(wrong).c_str(), "[0.05, 90)"},
                  __LINE__);
  check_refused(np::maximum_angle(.005), {"rounding of normals"}, __LINE__);
  for(const double wrong : {-1., 45.})
    check_refused(np::angle_tolerance(wrong), {"angle_tolerance", CGAL::Tandem::to_text(wrong).c_str(), "[0, 45)"},
                  __LINE__);
  check_refused(np::maximum_offset(-1.), {"maximum_offset", "-1", "[0, infinity)"}, __LINE__);
  for(const int wrong : {0, -5, 2})
    check_refused(np::minimum_region_size(wrong),
                  {"minimum_region_size", std::to_string(wrong).c_str(), "[3, 2147483648]"}, __LINE__);
  for(const double wrong : {-1., nan, inf, 1e9}) {
    check_refused(np::simplicity(wrong), {"simplicity is ", "[0, 1]"}, __LINE__);
    check_refused(np::regularity(wrong), {"regularity is ", "[0, 10]"}, __LINE__);
    check_refused(np::surfel_size(wrong), {"surfel_size is ", "[0, 0.55]"}, __LINE__);
  }
  for(const int wrong : {2, 0, 65, -1})
    check_refused(np::k_neighbors(wrong), {"k_neighbors", std::to_string(wrong).c_str(), "[3, 64]"}, __LINE__);
  check_refused(np::k_neighbors(65u), {"k_neighbors", "65", "[3, 64]"}, __LINE__);
  for(const int wrong : {63, 65537})
    check_refused(np::cell_size(wrong), {"cell_size", std::to_string(wrong).c_str(), "[64, 65536]"}, __LINE__);
  CGAL::Tandem::Parameters settings;
  settings.k_neighbors = 100;
  check_refused(np::settings(settings), {"k_neighbors", "100", "[3, 64]"}, __LINE__);
}

// The grid is coarsened as long as epsilon keeps 16 steps; then there is an exception.
BOOST_AUTO_TEST_CASE(test_extent)
{
  std::vector<Box_point> cloud = make_box_cloud(600);
  const auto given = maps.maximum_distance(.006).minimum_region_size(50);
  CHECK(!detect_planes(make_pairs<Epick>(cloud), given).statistics().is_grid_coarse);
  cloud.push_back({{20000, 0, 0}, {0, 0, 1}});
  const auto shapes = detect_planes(make_pairs<Epick>(cloud), given);
  CHECK(shapes.statistics().is_grid_coarse);
  CHECK(shapes.number_of_shapes() == 6);
  check_equal(violation_of(make_pairs<Epick>(cloud), shapes, given), "", "coarse grid");
  cloud.push_back({{2e6f, 0, 0}, {0, 0, 1}});
  // One in a twentieth of the points may be too far away; more may not.
  Pairs<Epick> huge = make_pairs<Epick>(cloud);
  huge[0].first = Epick::Point_3(1e300, 0, 0);
  huge[1].first = Epick::Point_3(-1.7e308, 0, 1.7e308);
  for(const bool is_given : {true, false}) {
    const auto of_huge = is_given ? detect_planes(huge, given) : detect_planes(huge, maps);
    CHECK(of_huge.statistics().number_of_far_points >= 2 && of_huge.number_of_shapes() == 6);
    check_equal(violation_of(huge, of_huge, given), "", "far points");
  }
  for(std::size_t i = 0; i < huge.size() / 10; ++i)
    huge[i].first = Epick::Point_3(2e6, 0, 0);
  check_throws<std::range_error>([&] { detect_planes(huge, given); },
                                 {"maximum_distance", "0.006", "extent", "2e+06", "2^24"}, __LINE__);
  for(std::size_t i = 0; i < huge.size() / 10; ++i)
    huge[i].first = Epick::Point_3(-1.7e308, 0, 1.7e308);
  check_throws<std::range_error>([&] { detect_planes(huge, positions); },
                                 {"extent", "1.7e+308", "2^24 times the largest maximum_distance"}, __LINE__);
}

// The box in another unit, in which lengths have no sensible value.
Pairs<Epick> make_scaled_box(double unit)
{
  Pairs<Epick> points = make_pairs<Epick>(make_box_cloud(300));
  for(auto& p : points)
    p.first = CGAL::ORIGIN + unit * (p.first - CGAL::ORIGIN);
  return points;
}

// Whatever the result is, it is valid.
BOOST_AUTO_TEST_CASE(test_extreme_coordinates)
{
  const auto check = [](const Pairs<Epick>& points, const auto& list, const std::string& name) {
    const auto shapes = detect_planes(points, list);
    CHECK_AT(shapes.number_of_points() == points.size(), name);
    check_equal(violation_of(points, shapes, list), "", name);
  };
  const auto check_all = [&](const Pairs<Epick>& points, const std::string& name) {
    check(points, positions, name);
    check(points, maps, name + ", normals");
    check(points, maps.maximum_offset(1e270), name + ", large offset");
  };
  for(double unit : {1e-322, 1e-300, 1e-272, 1e-269, 1e268, 1e272})
    check_all(make_scaled_box(unit), CGAL::Tandem::to_text(unit));
  for(double x : {5e-324, 1e-310, 1e-250, 1e300, 1.7e308, -1.7e308}) {
    const Pairs<Epick> points(200, {{x, x, -x}, {0, 0, 1}});
    const std::string name = "equal points at " + CGAL::Tandem::to_text(x);
    check_all(points, name);
    for(double distance : {1e-270, 1e-20, .01, 1e270})
      check(points, maps.maximum_distance(distance), name + ", distance " + CGAL::Tandem::to_text(distance));
  }
}

std::string note_of(double maximum_angle, double angle_tolerance)
{
  CGAL::Tandem::Parameters p;
  p.maximum_angle = maximum_angle;
  p.angle_tolerance = angle_tolerance;
  return CGAL::Tandem::angle_note(p);
}

BOOST_AUTO_TEST_CASE(test_angle_note)
{
  const std::string of_normals = "maximum_angle is 0.9 degrees: if that was meant as a cosine, pass 25.8";
  const std::string of_planes = "angle_tolerance is 0.99 degrees: if that was meant as a cosine, pass 8.1";
  CHECK(note_of(25, 8).empty());
  CHECK(note_of(1, 1).empty());
  CHECK(note_of(1, 0).empty());
  CHECK(note_of(90 - 1e-9, .5).empty()); // no cosine of an angle below 45 degrees
  CHECK(note_of(.9, 8) == of_normals);
  CHECK(note_of(25, .99) == of_planes);
  CHECK(note_of(.9, .99) == of_normals + "; " + of_planes);
  const Pairs<Epick> points = make_pairs<Epick>(make_box_cloud(300));
  CHECK(detect_planes(points, maps.maximum_angle(.9)).statistics().angle_note == of_normals);
  CHECK(detect_planes(points, maps).statistics().angle_note.empty());
  CGAL::Tandem::Parameters settings;
  settings.angle_tolerance = .99;
  CHECK(detect_planes(points, maps.settings(settings)).statistics().angle_note == of_planes);
}

BOOST_AUTO_TEST_SUITE_END()
