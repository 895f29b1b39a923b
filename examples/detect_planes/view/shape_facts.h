// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the view tells of a shape beyond what the detection knows of it.

#ifndef DETECT_PLANES_SHAPE_FACTS_H
#define DETECT_PLANES_SHAPE_FACTS_H

#include "view/Unit.h"
#include "view/write_points.h"

#include <CGAL/linear_least_squares_fitting_3.h>

#include <array>
#include <cmath>
#include <vector>

namespace program {

struct Shape_facts {
  std::array<double, 3> centroid;
  double mean_distance = 0;               // of its points to its plane
  double turned_degrees = 0, shifted = 0; // its plane, against the least-squares plane of its points
};

// The shift is measured at the centroid of the points, through which the least-squares plane passes.
inline Shape_facts facts_of_shape(const Point_set& points, const Shapes& shapes, const Unit& unit, std::size_t s)
{
  if(shapes.points(s).empty()) // a known plane
    return {};
  const auto point = [&](std::size_t i) { return unit.in(point_at(points, i)); };
  const Kernel::Point_3 origin = point(shapes.points(s)[0]);
  const Shapes::Coefficients c = unit.in(shapes.coefficients(s));
  const Kernel::Vector_3 normal(c[0], c[1], c[2]);
  const auto height = [&](const Kernel::Point_3& p) {
    return std::fma(c[0], p.x(), std::fma(c[1], p.y(), std::fma(c[2], p.z(), c[3])));
  };
  double sum = 0;
  std::vector<Kernel::Point_3> members; // relative to one of them: coordinates may be large
  for(std::uint32_t i : shapes.points(s)) {
    const Kernel::Point_3 p = point(i);
    members.push_back(CGAL::ORIGIN + (p - origin));
    sum += std::fabs(height(p));
  }
  Kernel::Plane_3 own;
  Kernel::Point_3 centroid;
  CGAL::linear_least_squares_fitting_3(members.begin(), members.end(), own, centroid, CGAL::Dimension_tag<0>());
  const Kernel::Vector_3 n = own.orthogonal_vector();
  const double sine = std::sqrt(CGAL::cross_product(n, normal).squared_length() / n.squared_length());
  centroid = origin + (centroid - CGAL::ORIGIN);
  Shape_facts facts;
  facts.mean_distance = unit.out(sum / double(members.size()));
  facts.turned_degrees = std::asin((std::min)(sine, 1.)) * 180 / CGAL_PI;
  facts.centroid = {unit.out(centroid.x()), unit.out(centroid.y()), unit.out(centroid.z())};
  facts.shifted = unit.out(std::fabs(height(centroid)));
  return facts;
}

} // namespace program

#endif // DETECT_PLANES_SHAPE_FACTS_H
