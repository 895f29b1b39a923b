// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Least squares planes of labeled points, by Eigen: an own way, so that what is
// measured does not measure itself.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_FIT_PLANE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_FIT_PLANE_H

#include "plane_relations.h"

#include <Eigen/Eigenvalues>

namespace CGAL::Tandem::benchmark {

// The plane of each label 0 .. count - 1; a label with fewer than three points gets z = 0.
inline std::vector<Plane> fit_planes(const std::vector<Vec>& points, const std::vector<std::int32_t>& label,
                                     std::size_t count)
{
  std::vector<Eigen::Vector3d> sum(count, Eigen::Vector3d::Zero());
  std::vector<Eigen::Matrix3d> scatter(count, Eigen::Matrix3d::Zero());
  std::vector<std::size_t> size(count, 0);
  auto eigen = [](const Vec& v) { return Eigen::Vector3d(v.x, v.y, v.z); };
  auto for_each_labeled = [&](auto action) {
    for(std::size_t i = 0; i < points.size(); ++i)
      if(label[i] >= 0 && std::size_t(label[i]) < count)
        action(std::size_t(label[i]), eigen(points[i]));
  };
  for_each_labeled([&](std::size_t s, const Eigen::Vector3d& p) {
    sum[s] += p;
    ++size[s];
  });
  for_each_labeled([&](std::size_t s, const Eigen::Vector3d& p) {
    Eigen::Vector3d q = p - sum[s] / double(size[s]);
    scatter[s] += q * q.transpose();
  });
  std::vector<Plane> planes(count, Plane{{0, 0, 1}, 0});
  for(std::size_t s = 0; s < count; ++s) {
    if(size[s] < 3)
      continue;
    Eigen::Vector3d n = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter[s]).eigenvectors().col(0);
    planes[s] = {{n[0], n[1], n[2]}, -n.dot(sum[s] / double(size[s]))};
  }
  return planes;
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_FIT_PLANE_H
