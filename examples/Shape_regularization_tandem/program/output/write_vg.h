// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertex groups as text (.vg): the points, their normals, and a group of positions for
// each shape or plane, as PolyFit, Easy3D and programs for kinetic reconstruction read them.

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

inline void write_vg_points(std::ostream& out, const Point_set& points, const Shapes& shapes, std::uint32_t count)
{
  out << std::setprecision(17) << "num_points: " << count << '\n';
  for(Point_set::Index i : points)
    if(is_finite(points.point(i)))
      out << points.point(i) << '\n';
  out << "num_colors: " << count << '\n' << std::setprecision(3);
  for(Point_set::Index i : points)
    if(is_finite(points.point(i))) {
      const Color c = color_of_shape(shapes.shape_index(i));
      out << c[0] / 255. << ' ' << c[1] / 255. << ' ' << c[2] / 255. << '\n';
    }
  out << "num_normals: " << count << '\n' << std::setprecision(9);
  for(Point_set::Index i : points)
    if(is_finite(points.point(i))) {
      const Kernel::Vector_3 n = normal_used(points, shapes, i);
      const bool is_usable = is_usable_normal(n);
      const double length = is_usable ? std::sqrt(n.squared_length()) : 1;
      out << (is_usable ? n / length : Kernel::Vector_3(CGAL::NULL_VECTOR)) << '\n';
    }
}

// `members` are shapes of one plane, of which the first gives color and orientation.
inline void write_vg_group(std::ostream& out, const Shapes& shapes, const std::vector<std::size_t>& members,
                           const std::string& label, const std::vector<std::uint32_t>& position)
{
  const std::size_t first = members.front();
  const auto& c = shapes.coefficients(first);
  const double sign = shapes.is_flipped(first) ? -1 : 1;
  const Color color = color_of_shape(int(first));
  std::size_t size = 0;
  for(std::size_t s : members)
    size += shapes.points(s).size();
  out << "group_type: 0\nnum_group_parameters: 4\ngroup_parameters: " << std::setprecision(17) << sign * c[0] << ' '
      << sign * c[1] << ' ' << sign * c[2] << ' ' << sign * c[3] << "\ngroup_label: " << label
      << "\ngroup_color: " << std::setprecision(3) << color[0] / 255. << ' ' << color[1] / 255. << ' '
      << color[2] / 255. << "\ngroup_num_points: " << size << '\n';
  const char* before = "";
  for(std::size_t s : members)
    for(std::size_t i : shapes.points(s)) {
      out << before << position[i];
      before = " ";
    }
  out << "\nnum_children: 0\n";
}

inline void write_vg(std::ostream& out, const Point_set& points, const Shapes& shapes, bool has_group_for_each_plane)
{
  std::uint32_t count;
  const std::vector<std::uint32_t> position = positions_in_vg(points, count);
  write_vg_points(out, points, shapes, count);
  std::vector<std::vector<std::size_t>> groups(has_group_for_each_plane ? shapes.number_of_coplanar_groups()
                                                                        : shapes.number_of_shapes());
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    groups[has_group_for_each_plane ? shapes.coplanar_group(s) : s].push_back(s);
  out << "num_groups: " << groups.size() << '\n';
  for(std::size_t g = 0; g < groups.size(); ++g)
    write_vg_group(out, shapes, groups[g], (has_group_for_each_plane ? "plane_" : "shape_") + std::to_string(g),
                   position);
}

} // namespace program

#endif // DETECT_PLANES_WRITE_VG_H
