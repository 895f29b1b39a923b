// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How good the outlines of shapes are, and their closed surface: for a cloud, or for the house of the generated scenes, whose areas are known.
//   outline_figures CLOUD.ply MAXIMUM_DISTANCE MAXIMUM_ANGLE MINIMUM_REGION_SIZE [FOLDER]
// For the shapes with most points FOLDER gets I.points and I.outline, in the plane of the shape, for gnuplot.
//   outline_figures house [POINTS [NOISE, a share of the diagonal]]

#include "criteria/surface_figures.h"

#include "clouds/ply_cloud.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>

#include <fstream>
#include <iostream>
#include <string>

using namespace CGAL::Tandem::benchmark;
namespace scenes = CGAL::Tandem::scenes;

namespace {

constexpr double epsilon_of_house = .03, angle_of_house = 25;
constexpr std::size_t smallest_of_house = 100;

Outline_cloud cloud_of(const std::vector<scenes::Vec>& points, const std::vector<scenes::Vec>& normals)
{
  Outline_cloud cloud;
  for(std::size_t i = 0; i < points.size(); ++i) {
    const scenes::Vec &p = points[i], n = normals.empty() ? scenes::Vec{0, 0, 0} : normals[i];
    cloud.emplace_back(Outline_kernel::Point_3(p.x, p.y, p.z), Outline_kernel::Vector_3(n.x, n.y, n.z));
  }
  return cloud;
}

Outline_shapes detect(const Outline_cloud& cloud, bool has_normals, const CGAL::Tandem::Parameters& parameters)
{
  const auto np = CGAL::Tandem::parameters::settings(parameters).point_map(Outline_point_map());
  return has_normals ? CGAL::Tandem::detect_planes(
                         cloud, np.normal_map(CGAL::Second_of_pair_property_map<Outline_cloud::value_type>()))
                     : CGAL::Tandem::detect_planes(cloud, np);
}

CGAL::Tandem::Parameters parameters_of(double distance, double angle, std::size_t smallest)
{
  CGAL::Tandem::Parameters p;
  p.maximum_distance = p.maximum_offset = distance;
  p.maximum_angle = angle;
  p.minimum_region_size = smallest;
  return p;
}

void measure_house(std::size_t points, double noise)
{
  scenes::Options options;
  options.points = points;
  options.noise = noise;
  const scenes::Model model = scenes::make_house();
  const scenes::Scene scene = scenes::make_scene(model, options);
  const Outline_cloud cloud = cloud_of(scene.points, scene.normals);
  const Outline_shapes shapes = detect(cloud, true, parameters_of(epsilon_of_house, angle_of_house, smallest_of_house));
  const Outline_areas areas =
    CGAL::Tandem::polygons(shapes, cloud, CGAL::Tandem::parameters::point_map(Outline_point_map()));
  print(figures_of(cloud, shapes, areas));
  print_surface(cloud, shapes);
  const Area_errors errors = errors_of(model, scene, shapes, areas);
  std::cout << "truth " << errors.truth << " missing " << errors.missing / errors.truth << " surplus "
            << errors.surplus / errors.truth << "\n";
}

void write_plots(const std::string& folder, const Outline_cloud& cloud, const Outline_shapes& shapes,
                 const Outline_areas& areas)
{
  constexpr std::size_t largest_number = 12;
  for(std::size_t s = 0; s < shapes.number_of_shapes() && s < largest_number; ++s) {
    const auto& c = shapes.coefficients(s);
    const Outline_kernel::Vector_3 n(c[0], c[1], c[2]);
    const bool is_level = std::fabs(c[2]) > .9;
    const Outline_kernel::Vector_3 across =
      is_level ? Outline_kernel::Vector_3(c[2], 0, -c[0]) : Outline_kernel::Vector_3(-c[1], c[0], 0);
    const Outline_kernel::Vector_3 u = across / std::sqrt(across.squared_length()), v = CGAL::cross_product(n, u);
    const auto write = [&](std::ostream& out, const Outline_kernel::Point_3& p) {
      out << u * (p - CGAL::ORIGIN) << ' ' << v * (p - CGAL::ORIGIN) << '\n';
    };
    std::ofstream points(folder + '/' + std::to_string(s) + ".points"),
      outline(folder + '/' + std::to_string(s) + ".outline");
    for(std::size_t i : shapes.points(s))
      write(points, cloud[i].first);
    for(const auto& edge : edges_of(areas, s)) {
      write(outline, edge.source());
      write(outline, edge.target());
      outline << '\n';
    }
    if(!points || !outline)
      throw std::runtime_error(folder + " cannot be written to");
  }
}

} // namespace

int main(int argc, char** argv)
try {
  const std::string name = argc > 1 ? argv[1] : "";
  if(name == "house" && argc <= 4) {
    measure_house(argc > 2 ? std::stoul(argv[2]) : 100000, argc > 3 ? std::stod(argv[3]) : .0004);
    return 0;
  }
  if(argc != 5 && argc != 6)
    throw std::invalid_argument(
      "usage: outline_figures CLOUD.ply DISTANCE ANGLE SIZE [FOLDER] | house [POINTS [NOISE]]");
  const Ply_cloud input = read_ply(name);
  const Outline_cloud cloud = cloud_of(input.points, input.normals);
  const Outline_shapes shapes =
    detect(cloud, input.has_normals(), parameters_of(std::stod(argv[2]), std::stod(argv[3]), std::stoul(argv[4])));
  const Outline_areas areas =
    CGAL::Tandem::polygons(shapes, cloud, CGAL::Tandem::parameters::point_map(Outline_point_map()));
  print(figures_of(cloud, shapes, areas));
  print_surface(cloud, shapes);
  if(argc == 6)
    write_plots(argv[5], cloud, shapes, areas);
  return 0;
} catch(const std::exception& e) {
  std::cerr << "outline_figures: " << e.what() << "\n";
  return 1;
}
