// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An angle that may have been meant as a cosine is told in the statistics, whether it is a named parameter or from
// the settings.

#include "testing/box_cloud.h"
#include "testing/checks.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>
#include <CGAL/Shape_regularization_tandem/is_valid_result.h>

#include <string>

BOOST_AUTO_TEST_SUITE(test_angle_note)

namespace np = CGAL::Tandem::parameters;
using CGAL::Tandem::angle_note;
using CGAL::Tandem::detect_planes;

std::string note_of(double maximum_angle, double angle_tolerance)
{
  CGAL::Tandem::Parameters p;
  p.maximum_angle = maximum_angle;
  p.angle_tolerance = angle_tolerance;
  return angle_note(p);
}

void test_values()
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
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  test_values();
  const Pairs<Epick> points = make_pairs<Epick>(make_box_cloud());
  const auto maps = np::point_map(First<Epick>()).normal_map(Second<Epick>());
  const auto shapes = detect_planes(points, maps.maximum_angle(.9));
  CHECK(shapes.statistics().angle_note == note_of(.9, 8));
  CHECK(detect_planes(points, maps).statistics().angle_note.empty());
  CGAL::Tandem::Parameters settings;
  settings.angle_tolerance = .99;
  CHECK(detect_planes(points, maps.settings(settings)).statistics().angle_note == note_of(25, .99));
  std::string why;
  CHECK_AT(CGAL::Tandem::is_valid_result(points, shapes, maps, &why), why);
}

BOOST_AUTO_TEST_SUITE_END()
