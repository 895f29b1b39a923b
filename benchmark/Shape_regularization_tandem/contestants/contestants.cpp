// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Contestant.h"

#include <malloc.h>

namespace CGAL::Tandem::benchmark {

std::vector<Contestant> contestants()
{
  static const std::vector<Contestant> all = [] {
    std::vector<Contestant> list;
    for(auto family : {tandem_contestants, cgal_contestants, pcl_contestants})
      for(const Contestant& c : family())
        list.push_back(c);
    return list;
  }();
  return all;
}

Contestant contestant(const std::string& name)
{
  for(const Contestant& c : contestants())
    if(c.name == name)
      return c;
  throw std::invalid_argument("there is no contestant " + name);
}

Run run_after(const Contestant& contestant, const Ply_cloud& cloud, const Task& task, const Run& base)
{
  // What is freed goes back to the system at once: else what comes next would use it again, and seem to need less.
  mallopt(M_MMAP_THRESHOLD, 128 * 1024);
  Run failed;
  try {
    if(contestant.base.empty() || base.finished)
      return contestant.step(cloud, task, base);
    failed.error = contestant.base + " did not finish";
  } catch(const std::exception& e) {
    failed.error = e.what();
  }
  return failed;
}

Run run(const Contestant& c, const Ply_cloud& cloud, const Task& task)
{
  return run_after(c, cloud, task, c.base.empty() ? Run() : run(contestant(c.base), cloud, task));
}

Detection cleaned(const Ply_cloud& cloud, const std::vector<Vec>& normals, const Task& task, Detection detection)
{
  const double minimum_cosine = std::cos(task.maximum_angle_deg * 0.017453292519943295);
  for(std::size_t i = 0; i < cloud.points.size(); ++i) {
    if(detection.label[i] < 0)
      continue;
    const Plane& plane = detection.planes[std::size_t(detection.label[i])];
    if(distance(plane, cloud.points[i]) > task.maximum_distance || cosine(plane, normals[i]) < minimum_cosine)
      detection.label[i] = -1;
  }
  std::vector<std::size_t> size = shape_sizes(detection);
  std::vector<std::int32_t> renamed(size.size(), -1);
  std::vector<Plane> kept;
  for(std::size_t s = 0; s < size.size(); ++s)
    if(size[s] >= task.minimum_region_size) {
      renamed[s] = std::int32_t(kept.size());
      kept.push_back(detection.planes[s]);
    }
  for(std::int32_t& label : detection.label)
    label = label < 0 ? -1 : renamed[std::size_t(label)];
  detection.planes = kept;
  return detection;
}

} // namespace CGAL::Tandem::benchmark
