// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any number of shapes beside each other, as a detection and the outlines would have made them.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MANY_SHAPES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MANY_SHAPES_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Border_finder.h>

#include <cmath>
#include <vector>

namespace outlines = CGAL::Tandem::internal::outlines;

// Walls of 1 x 1 that stand in rows, each on a floor of its own, or all on one floor.
struct Many_shapes {
  std::vector<outlines::Kernel::Point_3> points;
  outlines::Shapes shapes;
  std::vector<outlines::Shape_points> all;

  Many_shapes(std::size_t number_of_walls, bool has_floor)
  {
    const std::size_t row = std::size_t(std::sqrt(double(number_of_walls)));
    CGAL::Tandem::Shapes_data data;
    std::vector<std::vector<Point>> members;
    if(has_floor)
      members.emplace_back();
    for(std::size_t i = 0; i < number_of_walls; ++i) {
      const double x = 2. * double(i % row), y = 2. * double(i / row);
      if(!has_floor)
        members.emplace_back();
      add_square({x, y, 0}, {0, 1, 0}, members[has_floor ? 0 : members.size() - 1]);
      members.emplace_back();
      add_square({x, y, 0}, {0, 0, 1}, members.back());
    }
    // The walls of a row of walls are in one plane.
    for(std::size_t s = 0; s < members.size(); ++s) {
      const bool is_wall = has_floor ? s > 0 : s % 2 == 1;
      const double y = members[s][0].y();
      data.coefficients.push_back(is_wall ? Coefficients{0, 1, 0, -y} : Coefficients{0, 0, 1, 0});
      data.parallel_group.push_back(is_wall);
      data.coplanar_group.push_back(is_wall ? 1 + int(y / 2) : 0);
    }
    fill(data, members);
  }

private:
  using Point = outlines::Kernel::Point_3;
  using Vector = outlines::Kernel::Vector_3;
  using Coefficients = outlines::Shapes::Coefficients;

  static void add_square(const Point& corner, const Vector& up, std::vector<Point>& result)
  {
    for(int i = 0; i < 64; ++i)
      result.push_back(corner + Vector((i % 8) / 7., 0, 0) + (i / 8) / 7. * up);
  }

  void fill(CGAL::Tandem::Shapes_data& data, const std::vector<std::vector<Point>>& members)
  {
    std::vector<std::int32_t> labels;
    for(const auto& list : members)
      for(const Point& p : list) {
        points.push_back(p);
        labels.push_back(std::int32_t(&list - members.data()));
      }
    data.shape_of = std::move(labels);
    data.is_flipped.resize(members.size());
    data.parameters.maximum_distance = .01;
    shapes = outlines::Shapes(data);
    const outlines::Unit unit(points, shapes);
    for(std::size_t s = 0; s < members.size(); ++s) {
      all.push_back({outlines::Plane_frame(shapes, s, unit.in(members[s][0])), {}, {}, {}});
      for(const Point& p : members[s]) {
        all.back().points.push_back(unit.in(p));
        all.back().spacing.push_back(float(unit.in(1 / 7.)));
      }
    }
  }
};

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MANY_SHAPES_H
