// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parameters simplicity and regularity_period: what they change, and at which values. For regularity see
// test_analytic_scenes.

#include "testing/test_support.h"

BOOST_AUTO_TEST_SUITE(test_knobs)

namespace np = CGAL::Tandem::parameters;

// A floor that sags by 1.3 epsilon is one shape where size is worth much, and is cut where it is worth nothing.
BOOST_AUTO_TEST_CASE(test_bent_floor)
{
  constexpr double epsilon = .01, sag = 1.3 * epsilon, width = 6;
  Cloud cloud;
  scenes::Random random(1);
  for(int i = 0; i < 20000; ++i) {
    const double x = 2 * random.uniform() - 1, slope = -2 * sag * x / (width / 2);
    const double height = -sag * x * x + epsilon / 20 * random.gaussian();
    add(cloud, {x * width / 2, (random.uniform() - .5) * width, height}, {-slope, 0, 1});
  }
  std::vector<std::size_t> number;
  Parameters p = make_parameters(epsilon, 200);
  for(const double simplicity : {0., Parameters().simplicity, .3, 1.}) {
    p.simplicity = simplicity;
    number.push_back(detect_valid("bent floor", cloud, p).number_of_shapes());
  }
  CHECK(std::is_sorted(number.rbegin(), number.rend()) && number[0] > 1 && number[2] == 1);
}

// Whatever the period of the alternation is, the result is valid and regularized; 1 is the method. Between two
// regularity steps no shapes are related: seen from outside, round by round.
BOOST_AUTO_TEST_CASE(test_periods)
{
  check_equal(Parameters().regularity_period, 1u, "period");
  scenes::Options options = scene_options(20000, 0.002, 0.2);
  options.normals = scenes::Normals::perturbed;
  options.normal_noise_deg = 8;
  const Cloud cloud = to_cloud(scenes::make_scene("house", options));
  Parameters p = make_parameters(0.2, 60);
  p.maximum_angle = 36.87;
  const Shapes tandem = detect_valid("period 1", cloud, p);
  for(std::size_t period : {2, 7, 100000}) {
    const std::string name = "period " + std::to_string(period);
    p.regularity_period = period;
    const Shapes shapes = detect_valid(name, cloud, p);
    CHECK_AT(shapes.hash() != tandem.hash(), name + ": has no effect");
    CHECK_AT(2 * shapes.number_of_parallel_groups() < shapes.number_of_shapes(), name + ": is not regularized");
    check_same(detect<CGAL::Parallel_if_available_tag>(cloud, p), shapes, name);
  }
  p.regularity_period = 0;
  check_throws<std::invalid_argument>([&] { detect(cloud, p); }, {"regularity_period"}, __LINE__);
  p.regularity_period = 3;
  using Traits = CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, First<Kernel>, Second<Kernel>, CGAL::Sequential_tag>;
  CGAL::Tandem::Planar_shape_detection_3<Traits> detection(
    cloud, np::settings(p).point_map(First<Kernel>()).normal_map(Second<Kernel>()));
  for(int round = 1; round <= 6 && detection.iterate(); ++round) {
    const Shapes shapes = detection.shapes();
    // Parts of one shape share their plane; shapes that are related share directions between planes.
    const bool is_tied = shapes.number_of_parallel_groups() < shapes.number_of_coplanar_groups();
    CHECK_AT(is_tied == (round % 3 == 0), "round " + std::to_string(round));
  }
}

BOOST_AUTO_TEST_SUITE_END()
