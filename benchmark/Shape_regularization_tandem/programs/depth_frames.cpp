// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A room as a depth camera sees it, whose noise grows with the square of the range, also with depths in steps: the F of
// labels (criteria/segmentation.h) of Tandem with the best single tolerance of a sweep, without a tolerance, with one
// for each point that is estimated, and with the true noise; and of CGAL's region growing with the best of the same sweep.
// Normals are estimated, those of region growing by PCA of 20 neighbors. Its CMake target has the same name.
//   depth_frames [PART...]      only frames whose name contains one of the PARTs

#include "clouds/labeled_frames.h"
#include "contestants/contestants.h"
#include "criteria/segmentation.h"

#include <CGAL/Shape_regularization_tandem/distance_of_noise.h>
#include <CGAL/Shape_regularization_tandem/estimate_local_distances.h>
#include <CGAL/Simple_cartesian.h>

#include <cstdio>

using namespace CGAL::Tandem::benchmark;

namespace {

constexpr double sweep[] = {.0125, .018, .025, .035, .05, .07, .1, .14};

struct Scored {
  double f = -1, epsilon = 0;
};

Scored score(const std::string& method, const Named_cloud& cloud, double epsilon)
{
  Task task = cloud.task;
  task.maximum_distance = epsilon;
  task.estimates_normals = contestant(method).is_tandem;
  const Run run = contestant(method).run(cloud.cloud, task);
  return {evaluate_segmentation(cloud.truth, run.detection, task.minimum_region_size).f, epsilon};
}

Scored best_of_sweep(const std::string& method, const Named_cloud& cloud)
{
  Scored best;
  for(const double epsilon : sweep) {
    const Scored s = score(method, cloud, epsilon);
    if(s.f > best.f)
      best = s;
  }
  return best;
}

// With a tolerance for each point.
Scored score_with(Named_cloud cloud, std::vector<double> tolerances)
{
  cloud.cloud.tolerances = std::move(tolerances);
  return score("tandem-sequential", cloud, 0);
}

std::vector<double> local_tolerances(const Named_cloud& cloud)
{
  std::vector<CGAL::Simple_cartesian<double>::Point_3> points;
  for(const Vec& p : cloud.cloud.points)
    points.emplace_back(p.x, p.y, p.z);
  return CGAL::Tandem::estimate_local_distances(points);
}

std::vector<double> true_tolerances(const Depth_frame& frame, const Named_cloud& cloud)
{
  std::vector<double> tolerances;
  for(const Vec& p : cloud.cloud.points)
    tolerances.push_back(CGAL::Tandem::distance_of_noise(frame.sigma_at(p)));
  return tolerances;
}

bool is_wanted(const std::string& name, const std::vector<std::string>& parts)
{
  return parts.empty() || std::any_of(parts.begin(), parts.end(),
                                      [&](const std::string& p) { return name.find(p) != std::string::npos; });
}

} // namespace

int main(int argc, char** argv)
try {
  const std::vector<std::string> parts(argv + 1, argv + argc);
  std::printf("%-32s growing (eps)   one (eps)     auto (eps)    local  noise\n", "frame");
  double sum[5] = {0, 0, 0, 0, 0};
  int count = 0;
  for(const Depth_frame& frame : depth_frames()) {
    if(!is_wanted(frame.frame.name, parts))
      continue;
    const Named_cloud cloud = make_cloud(frame.frame);
    const Scored growing = best_of_sweep("growing-cached", cloud), one = best_of_sweep("tandem-sequential", cloud);
    const Scored automatic = score("tandem-sequential", cloud, 0);
    const Scored local = score_with(cloud, local_tolerances(cloud)),
                 noise = score_with(cloud, true_tolerances(frame, cloud));
    std::printf("%-32s %.3f (%.4f)  %.3f (%.4f)  %.3f         %.3f  %.3f\n", frame.frame.name.c_str(), growing.f,
                growing.epsilon, one.f, one.epsilon, automatic.f, local.f, noise.f);
    std::fflush(stdout);
    const double f[5] = {growing.f, one.f, automatic.f, local.f, noise.f};
    for(int i = 0; i < 5; ++i)
      sum[i] += f[i];
    ++count;
  }
  if(count > 0)
    std::printf("%-32s %.3f           %.3f           %.3f         %.3f  %.3f\n", "mean", sum[0] / count, sum[1] / count,
                sum[2] / count, sum[3] / count, sum[4] / count);
  return 0;
} catch(const std::exception& e) {
  std::fprintf(stderr, "depth_frames: %s\n", e.what());
  return 1;
}
