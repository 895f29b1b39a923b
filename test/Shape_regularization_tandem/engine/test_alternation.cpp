// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The period of the alternation, by which experiments measure what it is worth:
// whatever it is, the result is valid and regularized; 1 is the method.

#include "testing/test_support.h"

#include <stdexcept>

BOOST_AUTO_TEST_SUITE(test_alternation)

Cloud noisy_house()
{
  scenes::Options options = scene_options(40000, 0.002, 0.2);
  options.normals = scenes::Normals::perturbed;
  options.normal_noise_deg = 8;
  return to_cloud(scenes::make_scene("house", options));
}

Parameters with_period(std::size_t period)
{
  Parameters p = make_parameters(0.2, 60);
  p.maximum_angle = 36.87;
  p.regularity_period = period;
  return p;
}

BOOST_AUTO_TEST_CASE(test_one_is_the_default)
{
  Parameters p = with_period(1);
  check_equal(Parameters().regularity_period, 1u, "period");
  const Cloud cloud = noisy_house();
  Parameters untouched = make_parameters(0.2, 60);
  untouched.maximum_angle = p.maximum_angle;
  check_same(detect(cloud, p), detect(cloud, untouched), "period 1");
}

BOOST_AUTO_TEST_CASE(test_periods)
{
  const Cloud cloud = noisy_house();
  const Shapes tandem = detect_valid("period 1", cloud, with_period(1));
  for(std::size_t period : {2, 7, 100000}) {
    const std::string name = "period " + std::to_string(period);
    const Shapes shapes = detect_valid(name, cloud, with_period(period));
    CHECK_AT(shapes.hash() != tandem.hash(), name + ": has no effect");
    CHECK_AT(2 * shapes.number_of_parallel_groups() < shapes.number_of_shapes(), name + ": is not regularized");
    check_same(detect<CGAL::Parallel_if_available_tag>(cloud, with_period(period)), shapes, name);
  }
}

// Between two regularity steps no shapes are tied: seen from outside, round by round.
BOOST_AUTO_TEST_CASE(test_rounds)
{
  const Cloud cloud = noisy_house();
  const auto list = CGAL::Tandem::parameters::settings(with_period(3)).point_map(First<Kernel>());
  using Traits = CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, First<Kernel>, Second<Kernel>, CGAL::Sequential_tag>;
  CGAL::Tandem::Planar_shape_detection_3<Traits> detection(cloud, list.normal_map(Second<Kernel>()));
  for(int round = 1; round <= 6 && detection.iterate(); ++round) {
    const Shapes shapes = detection.shapes();
    // Parts of one shape share their plane; shapes that are tied share directions between planes.
    const bool is_tied = shapes.number_of_parallel_groups() < shapes.number_of_coplanar_groups();
    CHECK_AT(round % 3 == 0 ? is_tied : !is_tied, "round " + std::to_string(round));
  }
}

BOOST_AUTO_TEST_CASE(test_zero_is_refused)
{
  std::string message;
  try {
    detect(noisy_house(), with_period(0));
  } catch(const std::invalid_argument& e) {
    message = e.what();
  }
  CHECK_AT(message.find("regularity_period") != std::string::npos, "message: " + message);
}

BOOST_AUTO_TEST_SUITE_END()
