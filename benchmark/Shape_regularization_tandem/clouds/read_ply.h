// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads a PLY file, with a property `label` of any number type, or `shape` as detect_planes writes it.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_READ_PLY_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_READ_PLY_H

#include "ply_cloud.h"

#include <CGAL/Point_set_3.h>
#include <CGAL/Point_set_3/IO.h>
#include <CGAL/Simple_cartesian.h>

#include <stdexcept>

namespace CGAL::Tandem::benchmark {

using Ply_points = Point_set_3<Simple_cartesian<double>::Point_3>;

template <class T>
void read_label(const Ply_points& points, std::vector<std::int32_t>& label)
{
  for(const char* name : {"shape", "label"}) {
    const auto found = points.property_map<T>(name);
    if(!found.second)
      continue;
    label.clear();
    for(const auto& i : points)
      label.push_back(std::int32_t(found.first[i]));
  }
}

template <class... T>
std::vector<std::int32_t> label_of(const Ply_points& points)
{
  std::vector<std::int32_t> label;
  (read_label<T>(points, label), ...);
  return label;
}

inline Ply_cloud to_cloud(const Ply_points& points)
{
  Ply_cloud cloud;
  for(const auto& i : points) {
    const auto& p = points.point(i);
    cloud.points.push_back({p.x(), p.y(), p.z()});
    for(const double c : {p.x(), p.y(), p.z()})
      cloud.is_double = cloud.is_double || double(float(c)) != c;
    if(points.has_normal_map())
      cloud.normals.push_back({points.normal(i).x(), points.normal(i).y(), points.normal(i).z()});
  }
  cloud.label =
    label_of<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t, float, double>(
      points);
  return cloud;
}

inline Ply_cloud read_ply(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  Ply_points points;
  if(!in || !IO::read_PLY(in, points))
    throw std::runtime_error(path + ": cannot be read as a PLY file of points");
  return to_cloud(points);
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_READ_PLY_H
