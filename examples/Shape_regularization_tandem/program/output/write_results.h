// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The colored cloud, the labels and the planes. Everything is written exactly, so
// that the guarantees can be checked from the files.

#ifndef DETECT_PLANES_WRITE_RESULTS_H
#define DETECT_PLANES_WRITE_RESULTS_H

#include "input/read_cloud.h"
#include "output/Binary_writer.h"
#include "output/shape_color.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <ostream>
#include <string>

namespace program {

using Shapes = CGAL::Tandem::Planar_shapes_3<Kernel>;

inline Kernel::Vector_3 normal_used(const Point_set& points, const Shapes& shapes, Point_set::Index i)
{
  return shapes.has_estimated_normals() ? shapes.estimated_normal(i) : points.normal(i);
}

inline bool fits_float(double x) { return !std::isfinite(x) || double(float(x)) == x; }

template <class Get_vector>
bool needs_double(const Point_set& points, Get_vector get_vector)
{
  return std::any_of(points.begin(), points.end(), [&](Point_set::Index i) {
    const auto& v = get_vector(i);
    return !fits_float(v.x()) || !fits_float(v.y()) || !fits_float(v.z());
  });
}

inline void write_ply(std::ostream& out, const Point_set& points, const Shapes& shapes)
{
  const auto normal = [&](Point_set::Index i) { return normal_used(points, shapes, i); };
  // One type for coordinates and normals: some readers want them to agree.
  const bool is_double =
    needs_double(points, [&](Point_set::Index i) { return points.point(i); }) || needs_double(points, normal);
  const char* type = is_double ? "double" : "float";
  out << "ply\nformat binary_little_endian 1.0\ncomment detect_planes of Tandem\nelement vertex " << points.size();
  for(const char* name : {"x", "y", "z", "nx", "ny", "nz"})
    out << "\nproperty " << type << ' ' << name;
  out << "\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty int shape\nend_header\n";

  Binary_writer binary(out);
  for(Point_set::Index i : points) {
    const Kernel::Point_3& p = points.point(i);
    const Kernel::Vector_3 n = normal(i);
    for(double x : {p.x(), p.y(), p.z(), n.x(), n.y(), n.z()})
      binary.write_real(x, is_double);
    const int shape = shapes.shape_index(i);
    for(std::uint8_t channel : color_of_shape(shape))
      binary.write(channel);
    binary.write(std::int32_t(shape));
  }
}

inline void write_labels(std::ostream& out, const Shapes& shapes)
{
  Binary_writer binary(out);
  for(std::int32_t shape : shapes.shape_indices())
    binary.write(shape);
}

inline void write_planes(std::ostream& out, const Shapes& shapes)
{
  out << std::setprecision(17);
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    const auto& c = shapes.coefficients(s);
    out << c[0] << ' ' << c[1] << ' ' << c[2] << ' ' << c[3] << '\n';
  }
}

} // namespace program

#endif // DETECT_PLANES_WRITE_RESULTS_H
