// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points that have tolerances of their own: those of a depth camera, and detections with them.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_TOLERANCES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_TOLERANCES_H

#include "testing/measured_violation.h"
#include "testing/test_support.h"

#include <algorithm>
#include <cmath>

// The tolerance of a point by its distance from the origin. It depends on nothing else, so that it follows the point to
// wherever it is moved in a range.
struct Range_tolerance {
  using key_type = Cloud::value_type;
  using value_type = double;
  using reference = double;
  using category = boost::readable_property_map_tag;

  double least, per_square; // at the origin, and what each squared unit of distance adds

  friend double get(const Range_tolerance& map, const key_type& item)
  {
    const auto& p = item.first;
    return map.least + map.per_square * (p.x() * p.x() + p.y() * p.y() + p.z() * p.z());
  }
};

// f(list) with the named parameters of a detection.
template <class Map, class F>
auto with_tolerances(const Parameters& parameters, const Map& map, Given given, F f)
{
  const auto list = CGAL::Tandem::parameters::settings(parameters).point_map(First<Kernel>()).maximum_distance_map(map);
  return given == Given::normals ? f(list.normal_map(Second<Kernel>())) : f(list);
}

template <class Tag = CGAL::Sequential_tag, class Map>
Shapes detect_with_tolerances(const Cloud& cloud, const Parameters& parameters, const Map& map,
                              Given given = Given::normals)
{
  return with_tolerances(parameters, map, given,
                         [&](const auto& list) { return CGAL::Tandem::detect_planes<Tag>(cloud, list); });
}

template <class Map>
std::string violation_with_tolerances(const Cloud& cloud, const Shapes& shapes, const Map& map,
                                      Given given = Given::normals)
{
  return with_tolerances(Parameters(), map, given, [&](const auto& list) { return violation_of(cloud, shapes, list); });
}

// A corridor with an end wall, and what a depth camera at its entry sees of it: noise of .0028 z^2 along the rays. Of
// items z is given as well. Labels: the walls, from 0.
struct Corridor {
  Cloud cloud;
  std::vector<int> label;

  Corridor(int columns, int rows, double end, scenes::Random& random)
  {
    for(int row = 0; row < rows; ++row)
      for(int column = 0; column < columns; ++column) {
        const double a = (column - columns / 2 + .3) / (.9 * columns), b = (row - rows / 2 + .4) / (.9 * columns);
        const double along[] = {1.2 / (std::max)(a, 1e-9), 1.3 / (std::max)(-a, 1e-9), 1.1 / (std::max)(b, 1e-9),
                                1.4 / (std::max)(-b, 1e-9), end};
        const int wall = int(std::min_element(along, along + 5) - along);
        const double z = along[wall] + .0028 * along[wall] * along[wall] * random.gaussian();
        const scenes::Vec normal[] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}};
        add(cloud, {a * z, b * z, z}, normal[wall]);
        label.push_back(wall);
      }
  }
};

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_TOLERANCES_H
