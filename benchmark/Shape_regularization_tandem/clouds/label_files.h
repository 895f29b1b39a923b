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

// Empty lines and those that begin with # are skipped.
inline Ply_cloud read_text_cloud(const std::string& path)
{
  std::ifstream in(path);
  if(!in)
    throw std::runtime_error(path + ": cannot be opened");
  Ply_cloud cloud;
  cloud.is_double = true;
  std::string line;
  for(std::size_t at = 1; std::getline(in, line); ++at) {
    std::istringstream words(line);
    Vec p, n;
    if(line.empty() || line[0] == '#')
      continue;
    if(!(words >> p.x >> p.y >> p.z))
      throw std::runtime_error(path + ": line " + std::to_string(at) + " is no point");
    cloud.points.push_back(p);
    if(words >> n.x >> n.y >> n.z)
      cloud.normals.push_back(n);
  }
  if(cloud.has_normals() && cloud.normals.size() != cloud.points.size())
    throw std::runtime_error(path + ": not all points have a normal");
  return cloud;
}

inline Ply_cloud read_cloud(const std::string& path)
{
  const bool is_ply = path.size() > 4 && path.substr(path.size() - 4) == ".ply";
  return is_ply ? read_ply(path) : read_text_cloud(path);
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
