// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertex groups as text (.vg): the points, their normals, and a group of positions for
// each shape, as PolyFit, Easy3D and programs for kinetic reconstruction read them.

#ifndef DETECT_PLANES_WRITE_VG_H
#define DETECT_PLANES_WRITE_VG_H

#include "output/write_results.h"

#include <vector>

namespace program {

constexpr std::uint32_t not_in_file = std::uint32_t(-1);

// The position of each point in the file. The readers know no NaN and no infinity, so such points are left out.
inline std::vector<std::uint32_t> positions_in_vg(const Point_set& points, std::uint32_t& count)
{
  std::vector<std::uint32_t> position;
  count = 0;
  for(Point_set::Index i : points)
    position.push_back(is_finite(points.point(i)) ? count++ : not_in_file);
  return position;
}

// The readers take numbers of single precision: digits for that are enough where the input has no more.
template <class Real>
void write_vg_coordinates(std::ostream& out, const Point_set& points)
{
  for(Point_set::Index i : points)
    if(const Kernel::Point_3& p = points.point(i); is_finite(p)) {
      write_shortest(out, Real(p.x()), ' ');
      write_shortest(out, Real(p.y()), ' ');
      write_shortest(out, Real(p.z()), '\n');
    }
}

// Normals of length 1, to a hundredth of a degree. The null vector, where a point has none.
inline void write_vg_normals(std::ostream& out, const Point_set& points, const Shapes& shapes)
{
  const auto rounded = [](double x) { return std::round(1e4 * x) / 1e4 + 0.; }; // no -0
  for(Point_set::Index i : points)
    if(is_finite(points.point(i))) {
      const Kernel::Vector_3 n = normal_used(points, shapes, i);
      const double length = is_usable_normal(n) ? std::sqrt(n.squared_length()) : 0;
      const Kernel::Vector_3 unit = length > 0 ? n / length : Kernel::Vector_3(CGAL::NULL_VECTOR);
      write_shortest(out, rounded(unit.x()), ' ');
      write_shortest(out, rounded(unit.y()), ' ');
      write_shortest(out, rounded(unit.z()), '\n');
    }
}

// Colors of points are left out: groups have one.
inline void write_vg_points(std::ostream& out, const Point_set& points, const Shapes& shapes, std::uint32_t count)
{
  out << "num_points: " << count << '\n';
  if(needs_double(points, [&](Point_set::Index i) { return points.point(i); }))
    write_vg_coordinates<double>(out, points);
  else
    write_vg_coordinates<float>(out, points);
  out << "num_colors: 0\nnum_normals: " << count << '\n';
  write_vg_normals(out, points, shapes);
}

inline void write_vg_group(std::ostream& out, const Shapes& shapes, std::size_t s,
                           const std::vector<std::uint32_t>& position)
{
  const auto& c = shapes.coefficients(s);
  const double sign = shapes.is_flipped(s) ? -1 : 1;
  const Color color = color_of_shape(int(s));
  out << "group_type: 0\nnum_group_parameters: 4\ngroup_parameters: " << std::setprecision(17) << sign * c[0] << ' '
      << sign * c[1] << ' ' << sign * c[2] << ' ' << sign * c[3] << "\ngroup_label: shape_" << s
      << "\ngroup_color: " << std::setprecision(3) << color[0] / 255. << ' ' << color[1] / 255. << ' '
      << color[2] / 255. << "\ngroup_num_points: " << shapes.points(s).size() << '\n';
  const char* before = "";
  for(std::size_t i : shapes.points(s)) {
    out << before << position[i];
    before = " ";
  }
  out << "\nnum_children: 0\n";
}

inline void write_vg(std::ostream& out, const Point_set& points, const Shapes& shapes)
{
  std::uint32_t count;
  const std::vector<std::uint32_t> position = positions_in_vg(points, count);
  write_vg_points(out, points, shapes, count);
  out << "num_groups: " << shapes.number_of_shapes() << '\n';
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    write_vg_group(out, shapes, s, position);
}

} // namespace program

#endif // DETECT_PLANES_WRITE_VG_H
