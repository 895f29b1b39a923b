// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labeled clouds of a user: a PLY file, or text with x y z or x y z nx ny nz in a line; and a text file with one label
// a line.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_LABEL_FILES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_LABEL_FILES_H

#include "read_ply.h"
#include "testing/evaluate_truth.h"
#include "testing/fit_plane.h"

#include <map>

namespace CGAL::Tandem::benchmark {

inline Ply_cloud read_cloud(const std::string& path)
{
  if(path.size() > 4 && path.substr(path.size() - 4) == ".ply")
    return read_ply(path);
  std::ifstream in(path);
  Ply_points points;
  if(!in || !IO::read_XYZ(in, points))
    throw std::runtime_error(path + ": cannot be read as lines of x y z or x y z nx ny nz");
  Ply_cloud cloud = to_cloud(points);
  for(const Vec& n : cloud.normals)
    if(dot(n, n) == 0)
      throw std::runtime_error(path + ": not all points have a normal");
  return cloud;
}

// Numbered from 0 in the order of their first points; -1 for none. A negative label is none. Where no label is
// negative, 0 is none.
inline std::vector<std::int32_t> read_text_labels(const std::string& path)
{
  std::ifstream in(path);
  if(!in)
    throw std::runtime_error(path + ": cannot be opened");
  std::vector<long> given;
  for(long label; in >> label;)
    given.push_back(label);
  if(!in.eof())
    throw std::runtime_error(path + ": line " + std::to_string(given.size() + 1) + " is no label");
  const bool has_negative = std::any_of(given.begin(), given.end(), [](long label) { return label < 0; });
  std::map<long, std::int32_t> number;
  std::vector<std::int32_t> result;
  for(long label : given)
    result.push_back(label < (has_negative ? 0 : 1) ? -1
                                                    : number.emplace(label, std::int32_t(number.size())).first->second);
  return result;
}

// The planes of the faces are fitted to their points.
inline Truth make_truth(const std::vector<Vec>& points, const std::vector<std::int32_t>& label)
{
  if(label.size() != points.size())
    throw std::runtime_error("there are " + std::to_string(label.size()) + " labels for " +
                             std::to_string(points.size()) + " points");
  const std::size_t faces = label.empty() ? 0 : std::size_t(1 + *std::max_element(label.begin(), label.end()));
  return {label, fit_planes(points, label, faces)};
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_LABEL_FILES_H
