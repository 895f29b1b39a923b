// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Coordinates in the plane of a shape.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_PLANE_FRAME_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_PLANE_FRAME_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/models/Polygon_table.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL::Tandem::internal::outlines {

using Shapes = CGAL::Tandem::Planar_shapes_3<Kernel>;

// Of the angle between lines, or planes, that are intersected, about 15 degrees: flatter ones do not tell well where.
constexpr double smallest_sine = .25;

// Of a list that is not empty, which gets another order.
template <class Number>
Number median(std::vector<Number>& all)
{
  const auto middle = all.begin() + std::ptrdiff_t(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

inline Kernel::Point_3 point_at(const Position& p) { return Kernel::Point_3(p[0], p[1], p[2]); }

// Coordinates in the plane of a shape, with the lengths and angles in space. They decide what is connected how; vertices
// are computed in space.
class Plane_frame {
public:
  Plane_frame() = default;
  Plane_frame(const Shapes& shapes, std::size_t s, const Kernel::Point_3& origin) : origin(origin)
  {
    const Kernel::Vector_3 normal = shapes.plane(s).orthogonal_vector();
    const std::size_t steepest = steepest_axis(shapes.coefficients(s));
    const Kernel::Vector_3 across =
      CGAL::cross_product(Kernel::Vector_3(steepest == 1, steepest == 2, steepest == 0), normal);
    first = across / std::sqrt(across.squared_length());
    second = CGAL::cross_product(normal, first);
  }

  Kernel::Point_2 flat(const Kernel::Point_3& p) const
  {
    const Kernel::Vector_3 v = p - origin;
    return Kernel::Point_2(first * v, second * v);
  }

  Kernel::Vector_2 flat(const Kernel::Vector_3& v) const { return Kernel::Vector_2(first * v, second * v); }

  Kernel::Point_3 lifted(const Kernel::Point_2& p) const { return origin + p.x() * first + p.y() * second; }

private:
  Kernel::Point_3 origin;
  Kernel::Vector_3 first, second;
};

// A power of two, in which the largest coordinate of the shapes is between 1/2 and 1, so that squares and products of
// lengths are far from the bounds of doubles. Numbers that are not close to these bounds keep all their bits.
class Unit {
public:
  template <class Point>
  Unit(const std::vector<Point>& points, const Shapes& shapes)
  {
    double largest = 0;
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      for(std::uint32_t i : shapes.points(s))
        largest = (std::max)(largest, largest_coordinate(points[i]));
    std::frexp(largest, &exponent);
  }

  explicit Unit(const std::vector<Position>& points)
  {
    double largest = 0;
    for(const Position& p : points)
      largest = (std::max)(largest, largest_coordinate(p));
    std::frexp(largest, &exponent);
  }

  double in(double length) const { return std::ldexp(length, -exponent); }
  Kernel::Point_3 in(const Kernel::Point_3& p) const { return Kernel::Point_3(in(p.x()), in(p.y()), in(p.z())); }
  Kernel::Point_3 in(const Position& p) const { return Kernel::Point_3(in(p[0]), in(p[1]), in(p[2])); }
  Shapes::Coefficients in(const Shapes::Coefficients& c) const { return {c[0], c[1], c[2], in(c[3])}; }

  double out(double length) const { return std::ldexp(length, exponent); }
  double area_out(double area) const { return out(out(area)); }
  Position out(const Position& p) const { return {out(p[0]), out(p[1]), out(p[2])}; }

  // As it is after it was written, in this unit.
  Position written(const Position& p) const
  {
    const Position q = out(p);
    return {in(q[0]), in(q[1]), in(q[2])};
  }

private:
  template <class Point>
  static double largest_coordinate(const Point& p)
  {
    return (std::max)({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])});
  }

  int exponent = 0;
};

// --- Points on one to three planes

using Plane_row = std::array<long double, 4>; // a x + b y + c z + d = 0
using Plane_rows = std::array<Plane_row, 3>;

// Where three planes meet, by Cramer's rule, twice: the second time of what is left over.
inline std::array<long double, 3> common_point(const Plane_rows& rows, const std::array<long double, 3>& start)
{
  const auto minor = [&](int i, int j, int k, int l) { return rows[i][k] * rows[j][l] - rows[i][l] * rows[j][k]; };
  const auto cofactors = [&](int i) { // of row i: the cross product of the other two
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    return std::array<long double, 3>{minor(j, k, 1, 2), minor(j, k, 2, 0), minor(j, k, 0, 1)};
  };
  const auto c = cofactors(0);
  const long double determinant = rows[0][0] * c[0] + rows[0][1] * c[1] + rows[0][2] * c[2];
  std::array<long double, 3> x = start;
  for(int round = 0; round < 2; ++round) {
    std::array<long double, 3> step = {0, 0, 0};
    for(int i = 0; i < 3; ++i) {
      const Plane_row& r = rows[i];
      const long double rest = r[0] * x[0] + r[1] * x[1] + r[2] * x[2] + r[3];
      for(int k = 0; k < 3; ++k)
        step[k] -= cofactors(i)[k] * rest / determinant;
    }
    for(int k = 0; k < 3; ++k)
      x[k] += step[k];
  }
  return x;
}

// The point of one to three planes, in general position, that is closest to `p`. Coordinates that are free are rounded
// first, so that no doubles are closer to the planes.
inline Position point_on_planes(const std::vector<Shapes::Coefficients>& planes, const Kernel::Point_3& p)
{
  Plane_rows rows = {};
  std::array<long double, 3> x = {p.x(), p.y(), p.z()};
  for(std::size_t i = 0; i < planes.size() && i < rows.size(); ++i)
    rows[i] = {planes[i][0], planes[i][1], planes[i][2], planes[i][3]};
  const auto fix = [&](std::size_t row, std::size_t axis) { // the coordinate stays what it is, rounded
    rows[row] = {0, 0, 0, -static_cast<long double>(double(x[axis]))};
    rows[row][axis] = 1;
  };
  if(planes.size() == 1) {
    const Plane_row r = rows[0];
    const long double height = r[0] * x[0] + r[1] * x[1] + r[2] * x[2] + r[3];
    for(std::size_t k = 0; k < 3; ++k)
      x[k] -= height * r[k];
    const std::size_t steepest = steepest_axis(r);
    fix(1, (steepest + 1) % 3);
    fix(2, (steepest + 2) % 3);
  } else if(planes.size() == 2) {
    Plane_row line = {rows[0][1] * rows[1][2] - rows[0][2] * rows[1][1],
                      rows[0][2] * rows[1][0] - rows[0][0] * rows[1][2],
                      rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0], 0};
    line[3] = -(line[0] * x[0] + line[1] * x[1] + line[2] * x[2]);
    rows[2] = line;
    x = common_point(rows, x);
    fix(2, steepest_axis(line));
  }
  x = common_point(rows, x);
  return {double(x[0]), double(x[1]), double(x[2])};
}

} // namespace CGAL::Tandem::internal::outlines

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_PLANE_FRAME_H
