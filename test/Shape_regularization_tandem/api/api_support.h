// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of this folder share: each call of the package with another kernel, range or list takes long to compile.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_API_SUPPORT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_API_SUPPORT_H

#include "testing/test_support.h"

#include <CGAL/Shape_regularization_tandem/is_valid_result.h>

#include <limits>

namespace np = CGAL::Tandem::parameters;

const auto positions = np::point_map(First<Kernel>());
const auto maps = positions.normal_map(Second<Kernel>());
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

using CGAL::Tandem::internal::to_text;

inline Cloud make_box(int points_a_face = 1500) { return make_pairs<Kernel>(make_box_cloud(points_a_face)); }

// The exception has all of the words.
#define CHECK_REFUSED(expression, ...) check_throws<std::invalid_argument>([&] { expression; }, {__VA_ARGS__}, __LINE__)

// In another kernel than that of the other tests.
template <class Other>
auto detect_in(const Pairs<Other>& cloud, const Parameters& parameters)
{
  return CGAL::Tandem::detect_planes<CGAL::Sequential_tag>(
    cloud, np::settings(parameters).point_map(First<Other>()).normal_map(Second<Other>()));
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_API_SUPPORT_H
