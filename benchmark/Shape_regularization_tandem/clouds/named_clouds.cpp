// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "named_clouds.h"
#include "label_files.h"
#include "scenes/scene_normals.h"
#include "scenes/scenes.h"

#include <cstdio>
#include <cstdlib>

namespace CGAL::Tandem::benchmark {

Named_cloud cloud_of(const std::string& name, scenes::Scene scene, const Task& task)
{
  Named_cloud c{
    name, "generated", {std::move(scene.points), std::move(scene.normals), scene.label, true}, {scene.label, {}}, task};
  for(const scenes::Truth_face& f : scene.faces)
    c.truth.faces.push_back({f.normal, f.offset});
  return c;
}

Named_cloud make_cloud(const scenes::Labeled_scene& labeled)
{
  scenes::Scene scene = labeled.make();
  if(labeled.normal_noise_deg < 0)
    scene.normals = scenes::pca_normals(scene.points);
  else
    scenes::set_blended_normals(scene, labeled.normal_noise_deg, labeled.seed);
  Task task;
  task.maximum_distance = labeled.epsilon;
  task.maximum_angle_deg = labeled.alpha_deg;
  task.minimum_region_size = labeled.minimum;
  return cloud_of(labeled.name, std::move(scene), task);
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

namespace {

// Empty if there is no such file. Samples that the script has fetched lie beside the results.
std::string find_file(const std::string& name, const Experiment_options& options)
{
  for(const std::string& folder : {options.data, options.output + "/clouds"})
    for(const char* ending : {"", ".xz"})
      if(!folder.empty() && std::ifstream(folder + "/" + name + ending))
        return folder + "/" + name + ending;
  return "";
}

// Of a cell or an argument.
double number(const std::string& what, const std::string& text, double smallest, double largest = 1e270)
{
  const double value = std::stod(text);
  if(!(value >= smallest && value <= largest))
    throw std::invalid_argument(what + " cannot be " + text);
  return value;
}

double number_or_zero(const Row& row, const std::string& column)
{
  return cell(row, column).empty() ? 0 : number(column, cell(row, column), 0);
}

std::size_t points_of(const Row& row, const Experiment_options& options)
{
  return std::size_t(number_or_zero(row, options.is_quick ? "quick" : "points"));
}

Ply_cloud read_file(const std::string& path, const Experiment_options& options)
{
  if(path.size() < 3 || path.substr(path.size() - 3) != ".xz")
    return read_ply(path);
  const std::string copy = options.output + "/cloud.ply";
  if(path.find('\'') != std::string::npos || std::system(("xz -dc '" + path + "' > '" + copy + "'").c_str()) != 0)
    throw std::runtime_error(path + ": cannot be decompressed by xz");
  Ply_cloud cloud = read_ply(copy);
  std::remove(copy.c_str());
  return cloud;
}

void load_file(const Row& row, const Experiment_options& options, Named_cloud& named)
{
  const std::string name = cell(row, "file"), path = find_file(name, options);
  if(path.empty())
    throw std::runtime_error(name + ": is not in the folder of clouds (TANDEM_DATA)");
  named.cloud = read_file(path, options);
  const std::size_t points = points_of(row, options), all = named.cloud.points.size();
  named.origin = name;
  if(points > 0 && points < all) {
    named.cloud = subset(named.cloud, points);
    named.origin += ", a random subset of " + std::to_string(points);
  }
  if(cell(row, "truth") == "labels")
    named.truth = make_truth(named.cloud.points, named.cloud.label);
}

void generate(const Row& row, const Experiment_options& options, Named_cloud& named)
{
  scenes::Options o;
  o.points = points_of(row, options);
  o.noise = number_or_zero(row, "noise");
  o.outliers = number_or_zero(row, "outliers");
  o.varies_density = cell(row, "density") == "scanner";
  o.normals = scenes::Normals::none;
  scenes::Scene scene = scenes::make_scene(cell(row, "scene"), o);
  scenes::set_blended_normals(scene, number_or_zero(row, "normal_noise"), o.seed);
  named = cloud_of(named.name, std::move(scene), named.task);
}

void complete_normals(Named_cloud& named)
{
  if(named.cloud.has_normals() || named.cloud.points.empty())
    return;
  named.cloud.normals = scenes::pca_normals(named.cloud.points);
  named.origin += "; normals by PCA of 20 neighbors";
}

} // namespace

std::vector<Row> cloud_table() { return read_csv(TANDEM_BENCHMARK_SOURCES "/clouds.csv"); }

bool is_available(const Row& row, const Experiment_options& options)
{
  if(options.is_quick && points_of(row, options) == 0)
    return false;
  return cell(row, "file").empty() || !find_file(cell(row, "file"), options).empty();
}

Named_cloud load_cloud(const Row& row, const Experiment_options& options)
{
  Named_cloud named;
  named.name = cell(row, "name");
  named.task.maximum_distance = number("epsilon", cell(row, "epsilon"), 0);
  named.task.maximum_angle_deg = number("alpha", cell(row, "alpha"), 0.1, 89.9);
  named.task.minimum_region_size = std::size_t(number("minimum", cell(row, "minimum"), 3));
  named.task.cluster_epsilon = number("cluster", cell(row, "cluster"), -1);
  named.task.threads = options.threads;
  if(cell(row, "file").empty())
    generate(row, options, named);
  else
    load_file(row, options, named);
  complete_normals(named);
  return named;
}

Named_cloud load_own_cloud(std::vector<std::string> arguments)
{
  Named_cloud named;
  if(arguments.size() > 1 && arguments[1].find_first_not_of("0123456789.eE+-") != std::string::npos) {
    named.truth.label = read_text_labels(arguments[1]);
    arguments.erase(arguments.begin() + 1);
  }
  if(arguments.size() < 4 || arguments.size() > 5)
    throw std::invalid_argument("a cloud of your own needs FILE [LABELS] EPSILON ALPHA MINIMUM [CLUSTER_EPSILON]");
  const std::string& path = arguments[0];
  const std::size_t begin = path.find_last_of('/') + 1; // 0 where there is none
  named.name = path.substr(begin, path.find_last_of('.') > begin ? path.find_last_of('.') - begin : std::string::npos);
  named.origin = path;
  named.task.maximum_distance = number("EPSILON", arguments[1], 1e-270);
  named.task.maximum_angle_deg = number("ALPHA", arguments[2], 0.1, 89.9);
  named.task.minimum_region_size = std::size_t(number("MINIMUM", arguments[3], 3));
  if(arguments.size() == 5)
    named.task.cluster_epsilon = number("CLUSTER_EPSILON", arguments[4], -1);
  named.cloud = read_cloud(path);
  if(!named.truth.label.empty())
    named.truth = make_truth(named.cloud.points, named.truth.label);
  complete_normals(named);
  return named;
}

} // namespace CGAL::Tandem::benchmark
