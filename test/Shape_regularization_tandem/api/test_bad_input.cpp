// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bad data gets a result, misuse gets an exception that names the parameter, its
// value and the allowed range. An angle that may have been meant as a cosine is told in the statistics.

#include "api_support.h"

BOOST_AUTO_TEST_SUITE(test_bad_input)

// Valid results with the expected number of shapes, and valid ones with estimated parameters.
void check_answer(const std::string& name, const Cloud& cloud, std::size_t expected)
{
  const Parameters given = make_parameters(.006, 100);
  Parameters alone = given;
  alone.regularize_parallelism = alone.regularize_orthogonality = alone.regularize_coplanarity = false;
  check_equal(detect_valid(name, cloud, given).number_of_shapes(), expected, name);
  check_equal(detect_valid(name, cloud, alone).number_of_shapes(), expected, name + ", nothing regularized");
  check_equal(detect_valid(name, cloud, given, Given::nothing).number_of_shapes(), expected, name + ", no normals");
  for(Given has : {Given::normals, Given::nothing})
    check_equal(detect_valid(name, cloud, Parameters(), has).number_of_points(), cloud.size(), name);
}

BOOST_AUTO_TEST_CASE(test_degenerate_clouds)
{
  const Cloud::value_type item = {{1, 2, 3}, {0, 0, 1}};
  check_answer("empty", {}, 0);
  for(std::size_t copies : {1, 3, 20})
    check_answer("equal points", Cloud(copies, item), 0);
  check_answer("only invalid coordinates", Cloud(100, {{not_a_number, 0, 0}, {0, 0, 1}}), 0);
  Cloud line, flat, twice = make_box(400);
  for(int i = 0; i < 3000; ++i)
    add(line, {.001 * i, .002 * i, -.003 * i}, {2, -1, 0});
  for(int i = 0; i < 3000; ++i)
    add(flat, {.01 * (i % 60), .01 * (i / 60), 5}, {0, 0, -3});
  check_answer("perfectly flat", flat, 1);
  const Cloud once = twice;
  twice.insert(twice.end(), once.begin(), once.end());
  check_answer("exact duplicates", twice, 6);
  // No plane is defined; whatever the result is, it has to be valid.
  for(const Cloud& cloud : {line, Cloud(3000, item)})
    for(Given given : {Given::normals, Given::nothing})
      for(double distance : {0., .01})
        detect_valid("no plane is defined", cloud, make_parameters(distance, 0), given);
}

// Points that cannot be used are counted and change nothing for the others, also where their values are kept as floats.
BOOST_AUTO_TEST_CASE(test_invalid_points)
{
  const std::vector<Box_point> clean = make_box_cloud();
  std::vector<Box_point> cloud;
  std::vector<std::size_t> position;
  const float nan = float(not_a_number), infinite = float(infinity);
  for(std::size_t i = 0; i < clean.size(); ++i) {
    const auto& p = clean[i].position;
    if(i % 10 == 0)
      cloud.push_back({{i % 20 ? nan : p[0], p[1], i % 20 ? p[2] : -infinite}, clean[i].normal});
    if(i % 15 == 0)
      cloud.push_back({p, {0, i % 30 ? 0 : nan, i % 45 ? 0 : infinite}});
    position.push_back(cloud.size());
    cloud.push_back(clean[i]);
  }
  const Parameters given = make_parameters(.006, 50);
  const Shapes expected = detect(make_pairs<Kernel>(clean), given);
  const Shapes shapes = detect_valid("invalid points", make_pairs<Kernel>(cloud), given);
  CHECK(shapes.statistics().number_of_ignored_coordinates == (clean.size() + 9) / 10);
  CHECK(shapes.statistics().number_of_ignored_normals == (clean.size() + 14) / 15);
  CHECK(shapes.statistics().number_of_points == cloud.size());
  std::vector<std::int32_t> mapped;
  for(std::size_t i : position)
    mapped.push_back(shapes.shape_index(i));
  CHECK(shapes.hash(mapped, shapes.data().coefficients) == expected.hash());
  using Float = CGAL::Simple_cartesian<float>;
  CHECK(detect_in<Float>(make_pairs<Float>(cloud), given).hash() == shapes.hash());
  const Cloud no_normals(100, {{0, 0, 0}, {0, 0, 0}});
  CHECK(detect(no_normals, given).statistics().number_of_ignored_normals == 100);
}

// A plane with exact normals is found at the smallest angle, however it lies. Packing turns its normals by less.
BOOST_AUTO_TEST_CASE(test_smallest_angle)
{
  scenes::Random random(7);
  for(int run = 0; run < 10; ++run) {
    const scenes::Vec n = random.direction(), u = unit(cross(n, random.direction())), v = cross(n, u);
    Cloud cloud;
    for(int i = 0; i < 2000; ++i)
      add(cloud, random.uniform() * u + random.uniform() * v, n);
    Parameters given = make_parameters(run % 2 ? .02 : .2, 0);
    given.maximum_angle = CGAL::Tandem::internal::smallest_angle_deg;
    const Shapes shapes = detect_valid("smallest angle", cloud, given);
    CHECK_AT(shapes.number_of_shapes() == 1 && shapes.statistics().coverage == 1, std::to_string(run));
  }
}

// Of points, of none and of an estimate.
void check_refused(const Parameters& p, std::initializer_list<const char*> words)
{
  const Cloud cloud = make_box(50);
  check_throws<CGAL::Tandem::Parameter_error>([&] { detect(cloud, p); }, words, __LINE__);
  check_throws<CGAL::Tandem::Parameter_error>([&] { detect(Cloud(), p); }, words, __LINE__);
  check_throws<CGAL::Tandem::Parameter_error>([&] { CGAL::Tandem::estimate_parameters(cloud, positions.settings(p)); },
                                              words, __LINE__);
}

BOOST_AUTO_TEST_CASE(test_misuse)
{
  struct Case {
    double Parameters::*member;
    const char *name, *range;
    std::vector<double> wrong;
  };
  for(const Case& c :
      {Case{&Parameters::maximum_distance, "maximum_distance", "a length above 0", {-.5, not_a_number, infinity}},
       Case{&Parameters::maximum_angle, "maximum_angle", "[0.05, 90)", {0, .005, 90, not_a_number}},
       Case{&Parameters::angle_tolerance, "angle_tolerance", "[0, 45)", {-1, 45}},
       Case{&Parameters::maximum_offset, "maximum_offset", "a length from 0", {-1}},
       Case{&Parameters::simplicity, "simplicity is ", "[0, 1]", {-1, not_a_number, infinity, 1e9}},
       Case{&Parameters::regularity, "regularity is ", "[0, 10]", {-1, not_a_number, infinity, 1e9}},
       Case{&Parameters::surfel_size, "surfel_size is ", "[0, 0.55]", {-1, not_a_number, infinity, 1e9}}})
    for(const double wrong : c.wrong) {
      Parameters p;
      p.*c.member = wrong;
      check_refused(p, {c.name, to_text(wrong).c_str(), c.range});
    }
  Parameters rounded;
  rounded.maximum_angle = .005;
  check_refused(rounded, {"rounding of normals"});
  try {
    detect(Cloud(), rounded);
    fail("no exception");
  } catch(const CGAL::Tandem::Parameter_error& e) {
    check_equal(e.name() + ", " + e.value() + ", " + e.range().substr(0, 10), "maximum_angle, 0.005, [0.05, 90)",
                "fields");
  }
}

// 0 means in settings what is estimated: as a named parameter it is refused, as negative ones are.
BOOST_AUTO_TEST_CASE(test_misuse_of_counts)
{
  const auto refuse = [](std::array<int, 4> v, std::size_t wrong, const char* name, const char* range) {
    const auto list = positions.maximum_distance(v[0]).minimum_region_size(v[1]).k_neighbors(v[2]).cell_size(v[3]);
    CHECK_REFUSED(CGAL::Tandem::estimate_parameters(Cloud(), list), name, to_text(v[wrong]).c_str(), range);
  };
  refuse({0, 50, 12, 100}, 0, "maximum_distance", "a length above 0");
  for(const int wrong : {0, -5, 2})
    refuse({1, wrong, 12, 100}, 1, "minimum_region_size", "[3, 2147483648]");
  for(const int wrong : {2, 0, 65, -1})
    refuse({1, 50, wrong, 100}, 2, "k_neighbors", "[3, 64]");
  for(const int wrong : {63, 65537})
    refuse({1, 50, 12, wrong}, 3, "cell_size", "[64, 65536]");
  Parameters p;
  p.k_neighbors = 100;
  check_refused(p, {"k_neighbors", "100", "[3, 64]"});
}

// The grid is coarsened as long as epsilon keeps 16 steps; then there is an exception.
BOOST_AUTO_TEST_CASE(test_extent)
{
  Cloud cloud = make_box(600);
  const Parameters given = make_parameters(.006, 50);
  CHECK(!detect(cloud, given).statistics().is_grid_coarse);
  add(cloud, {20000, 0, 0}, {0, 0, 1});
  const Shapes shapes = detect_valid("coarse grid", cloud, given);
  CHECK(shapes.statistics().is_grid_coarse && shapes.number_of_shapes() == 6);
  // One in a twentieth of the points may be too far away; more may not.
  add(cloud, {2e6, 0, 0}, {0, 0, 1});
  cloud[0].first = {1e300, 0, 0};
  cloud[1].first = {-1.7e308, 0, 1.7e308};
  for(const Parameters& p : {given, Parameters()}) {
    const Shapes of_huge = detect_valid("far points", cloud, p);
    CHECK(of_huge.statistics().number_of_far_points >= 2 && of_huge.number_of_shapes() == 6);
  }
  const auto move_tenth = [&](const Kernel::Point_3& place) {
    for(std::size_t i = 0; i < cloud.size() / 10; ++i)
      cloud[i].first = place;
  };
  move_tenth({2e6, 0, 0});
  check_throws<CGAL::Tandem::Parameter_error>([&] { detect(cloud, given); },
                                              {"maximum_distance", "0.006", "extent", "2e+06", "2^24"}, __LINE__);
  move_tenth({-1.7e308, 0, 1.7e308});
  check_throws<std::range_error>([&] { detect(cloud, Parameters(), Given::nothing); },
                                 {"extent", "1.7e+308", "2^24 times the largest maximum_distance"}, __LINE__);
}

// Units in which lengths have no sensible value: whatever the result is, it is valid.
BOOST_AUTO_TEST_CASE(test_extreme_coordinates)
{
  const auto check_all = [&](const Cloud& cloud, const std::string& name, std::initializer_list<double> distances) {
    Parameters large_offset;
    large_offset.maximum_offset = 1e270;
    detect_valid(name + ", large offset", cloud, large_offset);
    detect_valid(name, cloud, Parameters(), Given::nothing);
    for(double distance : distances)
      detect_valid(name + ", distance " + to_text(distance), cloud, make_parameters(distance, 0));
  };
  for(double unit : {1e-322, 1e-300, 1e-272, 1e-269, 1e268, 1e272})
    check_all(transformed(make_box(300), unit), to_text(unit), {0});
  for(double x : {5e-324, 1e-310, 1e-250, 1e300, 1.7e308, -1.7e308})
    check_all(Cloud(200, {{x, x, -x}, {0, 0, 1}}), "equal points at " + to_text(x), {0, 1e-270, 1e-20, .01, 1e270});
}

BOOST_AUTO_TEST_CASE(test_angle_note)
{
  const std::string of_normals = "the maximum angle is 0.9 degrees: if that was meant as a cosine, pass 25.8";
  const std::string of_planes = "the angle tolerance is 0.99 degrees: if that was meant as a cosine, pass 8.1";
  const Cloud cloud = make_box(300);
  const auto check = [&](double maximum_angle, double angle_tolerance, const std::string& expected) {
    Parameters p = make_parameters(.006, 50);
    p.maximum_angle = maximum_angle;
    p.angle_tolerance = angle_tolerance;
    check_equal(detect(cloud, p).statistics().angle_note, expected, "note");
  };
  check(25, 8, "");
  check(1, 1, "");
  check(90 - 1e-9, .5, ""); // no cosine of an angle below 45 degrees
  check(.9, 8, of_normals);
  check(25, .99, of_planes);
  check(.9, .99, of_normals + "; " + of_planes);
}

BOOST_AUTO_TEST_SUITE_END()
