// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The files by which every detector is judged alike: one little-endian int32 per
// point, and one line `a b c d` per shape.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_DETECTION_FILES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_DETECTION_FILES_H

#include "testing/evaluate_truth.h"

#include <cstring>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <sstream>

namespace CGAL {
namespace Tandem {
namespace benchmark {

inline std::ifstream open_file(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  if(!in)
    throw std::runtime_error(path + ": cannot be opened");
  return in;
}

inline std::vector<std::int32_t> read_labels(const std::string& path)
{
  std::ifstream in = open_file(path);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if(bytes.size() % 4 != 0)
    throw std::runtime_error(path + ": is not a sequence of int32");
  std::vector<std::int32_t> labels(bytes.size() / 4);
  if(!labels.empty())
    std::memcpy(labels.data(), bytes.data(), bytes.size());
  return labels;
}

inline std::vector<Plane> read_planes(const std::string& path)
{
  std::ifstream in = open_file(path);
  std::vector<Plane> planes;
  std::string line;
  while(std::getline(in, line)) {
    if(line.empty() || line[0] == '#')
      continue;
    std::istringstream numbers(line);
    Plane plane;
    if(!(numbers >> plane.normal.x >> plane.normal.y >> plane.normal.z >> plane.offset))
      throw std::runtime_error(path + ": plane " + std::to_string(planes.size()) + " is not four numbers");
    planes.push_back(plane);
  }
  return planes;
}

inline void write_labels(const std::string& path, const std::vector<std::int32_t>& labels)
{
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(labels.data()), std::streamsize(4 * labels.size()));
  out.close();
  if(!out)
    throw std::runtime_error(path + ": cannot be written");
}

inline void write_planes(const std::string& path, const std::vector<Plane>& planes)
{
  std::ofstream out(path);
  out << std::setprecision(17);
  for(const Plane& p : planes)
    out << p.normal.x << " " << p.normal.y << " " << p.normal.z << " " << p.offset << "\n";
  out.close();
  if(!out)
    throw std::runtime_error(path + ": cannot be written");
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_DETECTION_FILES_H
