// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a generated cloud with ground truth: a binary PLY with the true face of each point as `label`.

#include "clouds/ply_cloud.h"
#include "scenes/scene_normals.h"
#include "scenes/scenes.h"

#include <boost/program_options.hpp>

#include <iostream>

namespace scenes = CGAL::Tandem::scenes;
namespace po = boost::program_options;
using CGAL::Tandem::benchmark::Ply_cloud;

namespace {

struct Request {
  std::string scene, output, normals;
  scenes::Options options;
};

po::options_description make_description(Request& r)
{
  po::options_description visible("make_scene SCENE OUTPUT.ply [options]");
  visible.add_options()("help", "this text")("points", po::value(&r.options.points)->default_value(100000),
                                             "number of points")("noise", po::value(&r.options.noise)->default_value(0),
                                                                 "sigma of the noise, fraction of the diagonal")(
    "outliers", po::value(&r.options.outliers)->default_value(0), "ratio of the points that lie anywhere")(
    "varying-density", po::bool_switch(&r.options.varies_density), "density as seen from scanners")(
    "normals", po::value(&r.normals)->default_value("blended"), "exact, perturbed, blended, pca or none")(
    "normal-noise", po::value(&r.options.normal_noise_deg)->default_value(0), "degrees, for perturbed and blended")(
    "seed", po::value(&r.options.seed)->default_value(1), "seed of the random numbers");
  return visible;
}

Request parse(int argc, char** argv)
{
  Request r;
  po::options_description visible = make_description(r), all;
  all.add(visible).add_options()("scene", po::value(&r.scene)->required())("output", po::value(&r.output)->required());
  po::positional_options_description positions;
  positions.add("scene", 1).add("output", 1);
  po::variables_map values;
  po::store(po::command_line_parser(argc, argv).options(all).positional(positions).run(), values);
  if(values.count("help") || argc < 2) {
    std::cout << visible << "\nScenes:";
    for(const std::string& name : scenes::scene_names())
      std::cout << " " << name;
    std::cout << "\n";
    std::exit(0);
  }
  po::notify(values);
  return r;
}

scenes::Scene generate(Request r)
{
  r.options.normals = r.normals == "exact"       ? scenes::Normals::exact
                      : r.normals == "perturbed" ? scenes::Normals::perturbed
                                                 : scenes::Normals::none;
  scenes::Scene scene = scenes::make_scene(r.scene, r.options);
  if(r.normals == "blended")
    scenes::set_blended_normals(scene, r.options.normal_noise_deg, r.options.seed);
  else if(r.normals == "pca")
    scene.normals = scenes::pca_normals(scene.points);
  else if(r.normals != "exact" && r.normals != "perturbed" && r.normals != "none")
    throw std::invalid_argument("unknown kind of normals: " + r.normals);
  return scene;
}

} // namespace

int main(int argc, char** argv)
try {
  Request request = parse(argc, argv);
  scenes::Scene scene = generate(request);
  CGAL::Tandem::benchmark::write_ply(request.output, {scene.points, scene.normals, scene.label});
  std::cout << request.scene << ": " << scene.points.size() << " points, " << scene.faces.size() << " faces, diagonal "
            << scene.diagonal << "\n";
  return 0;
} catch(const std::exception& e) {
  std::cerr << "make_scene: " << e.what() << "\n";
  return 1;
}
