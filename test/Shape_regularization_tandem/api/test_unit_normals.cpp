// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Planes that regularize_planes() calls related have unit normals.

#include "testing/checks.h"
#include "testing/plane_scene.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Shape_regularization_tandem/regularize_planes.h>

BOOST_AUTO_TEST_SUITE(test_unit_normals)

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

namespace np = CGAL::parameters;

// Planes that are orthogonal before get unit normals, too, of any length; one that is related to nothing stays.
BOOST_AUTO_TEST_CASE(test_unit_normals)
{
  Scene<Kernel> s;
  s.planes = {{0, 0, 2, 0}, {-3e-200, 0, 0, 0}, {1, 2, 4, 0}};
  for(int i = 0; i < 300; ++i) {
    const double u = i % 10, v = i / 10 % 10;
    const Kernel::Point_3 points[3] = {{u, v, 0}, {0, u, v}, {2 * u, v, -u / 2 - v / 2}};
    s.points.push_back(points[i / 100]);
    s.index.push_back(i / 100);
  }
  const auto r =
    CGAL::Tandem::regularize_planes(s.planes, s.points, np::plane_index_map(s.index_map()).maximum_angle(1));
  const Kernel::Plane_3 expected[3] = {{0, 0, 1, 0}, {-1, 0, 0, 0}, {1, 2, 4, 0}};
  check_equal(double(r.orthogonal_groups.size()), 1, "orthogonal pairs before");
  for(std::size_t i = 0; i < 3; ++i) {
    const bool has_bits = normal_of(s.planes[i]) == normal_of(expected[i]) && s.planes[i].d() == expected[i].d();
    check(has_bits && r.is_changed[i] == (i < 2), "normal of unit length where related, plane", double(i));
  }
}

BOOST_AUTO_TEST_SUITE_END()
