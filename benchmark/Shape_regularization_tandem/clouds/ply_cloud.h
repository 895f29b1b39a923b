// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clouds of the measuring programs, and PLY files of them (read_ply.h reads such files).

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PLY_CLOUD_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PLY_CLOUD_H

#include "scenes/scenes.h"

#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

namespace CGAL::Tandem::benchmark {

using scenes::Vec;

struct Ply_cloud {
  std::vector<Vec> points;
  std::vector<Vec> normals;        // empty if there are none
  std::vector<std::int32_t> label; // empty if there is none
  bool is_double = false;          // whether the coordinates are more than floats, and shall be stored so

  bool has_normals() const { return !normals.empty(); }
  bool has_label() const { return !label.empty(); }
};

// Selection sampling: exactly `count` points, in their order.
inline Ply_cloud subset(const Ply_cloud& cloud, std::size_t count)
{
  Ply_cloud result;
  result.is_double = cloud.is_double;
  scenes::Random random(42);
  const std::size_t n = cloud.points.size();
  for(std::size_t i = 0, chosen = 0; i < n && chosen < count; ++i) {
    if(random.uniform() * double(n - i) >= double(count - chosen))
      continue;
    ++chosen;
    result.points.push_back(cloud.points[i]);
    if(cloud.has_normals())
      result.normals.push_back(cloud.normals[i]);
    if(cloud.has_label())
      result.label.push_back(cloud.label[i]);
  }
  return result;
}

// As a range for the functions of the package; null normals where there are none.
template <class Kernel>
auto points_with_normals(const std::vector<Vec>& points, const std::vector<Vec>& normals)
{
  using Number = typename Kernel::FT;
  std::vector<std::pair<typename Kernel::Point_3, typename Kernel::Vector_3>> result;
  result.reserve(points.size());
  for(std::size_t i = 0; i < points.size(); ++i) {
    const Vec &p = points[i], n = normals.empty() ? Vec{0, 0, 0} : normals[i];
    result.emplace_back(typename Kernel::Point_3(Number(p.x), Number(p.y), Number(p.z)),
                        typename Kernel::Vector_3(Number(n.x), Number(n.y), Number(n.z)));
  }
  return result;
}

template <class T>
void append(std::string& bytes, T value)
{
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

inline std::string ply_header(const Ply_cloud& cloud)
{
  std::ostringstream header;
  const char* type = cloud.is_double ? "double" : "float";
  header << "ply\nformat binary_little_endian 1.0\nelement vertex " << cloud.points.size() << "\n";
  for(const char* name : {"x", "y", "z"})
    header << "property " << type << " " << name << "\n";
  if(cloud.has_normals())
    header << "property float nx\nproperty float ny\nproperty float nz\n";
  if(cloud.has_label())
    header << "property int label\n";
  header << "end_header\n";
  return header.str();
}

inline void write_ply(const std::string& path, const Ply_cloud& cloud)
{
  std::string bytes = ply_header(cloud);
  auto append_all = [&](const Vec& v, bool is_double) {
    for(double c : {v.x, v.y, v.z}) {
      if(is_double)
        append(bytes, c);
      else
        append(bytes, float(c));
    }
  };
  for(std::size_t i = 0; i < cloud.points.size(); ++i) {
    append_all(cloud.points[i], cloud.is_double);
    if(cloud.has_normals())
      append_all(cloud.normals[i], false);
    if(cloud.has_label())
      append(bytes, cloud.label[i]);
  }
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), std::streamsize(bytes.size()));
  out.close();
  if(!out)
    throw std::runtime_error(path + ": cannot be written");
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PLY_CLOUD_H
