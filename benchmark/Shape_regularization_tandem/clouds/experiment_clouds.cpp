// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "experiment_clouds.h"
#include "scene_normals.h"
#include "scenes/scene_twins.h"

namespace CGAL::Tandem::benchmark {

Named_cloud cloud_of(const std::string& name, scenes::Scene scene, const Task& task)
{
  Named_cloud c{
    name, "generated", {std::move(scene.points), std::move(scene.normals), scene.label, true}, {scene.label, {}}, task};
  for(const scenes::Truth_face& f : scene.faces)
    c.truth.faces.push_back({f.normal, f.offset});
  return c;
}

Named_cloud twin_cloud(const std::string& name, std::size_t points, std::uint64_t seed)
{
  const scenes::Twin& twin = scenes::twin(name);
  scenes::Scene scene = scenes::make_twin(twin, points, seed);
  scene.normals = scenes::pca_normals(scene.points);
  Task task;
  task.maximum_distance = twin.epsilon;
  task.maximum_angle_deg = twin.alpha_deg;
  task.minimum_region_size = twin.minimum(points);
  task.cluster_epsilon = twin.gap * std::sqrt(500000. / double(points)); // as the spacing
  return cloud_of(name, std::move(scene), task);
}

Named_cloud noisy_house(const House& house)
{
  scenes::Options o;
  o.points = house.points;
  o.noise = house.noise;
  o.outliers = house.outliers;
  o.normals = scenes::Normals::none;
  o.seed = house.seed;
  scenes::Scene scene = scenes::make_scene("house", o);
  scenes::set_blended_normals(scene, 4000 * house.noise, house.seed);
  Task task;
  task.maximum_distance = (std::max)(0.04, 3 * house.noise * scene.diagonal);
  task.maximum_angle_deg = 36.87;
  task.minimum_region_size = (std::max)(std::size_t(40), house.points / 1000);
  task.cluster_epsilon = 0.2;
  return cloud_of("house", std::move(scene), task);
}

Named_cloud house_scan(std::size_t points)
{
  scenes::Options o;
  o.points = points;
  o.noise = 0.0005;
  o.outliers = 0.02;
  o.varies_density = true;
  o.normals = scenes::Normals::perturbed;
  Task task;
  task.maximum_distance = 0.06;
  task.minimum_region_size = (std::max)(std::size_t(20), points / 2000);
  task.cluster_epsilon = 0.2;
  return cloud_of("scan", scenes::make_scene("house", o), task);
}

} // namespace CGAL::Tandem::benchmark
