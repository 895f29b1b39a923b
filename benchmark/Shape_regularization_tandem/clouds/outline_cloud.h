// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clouds with their shapes, for the figures of outlines and surfaces: of a file, or the house of the generated scenes.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_OUTLINE_CLOUD_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_OUTLINE_CLOUD_H

#include "clouds/read_ply.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/property_map.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::Tandem::benchmark {

using Outline_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Outline_cloud = std::vector<std::pair<Outline_kernel::Point_3, Outline_kernel::Vector_3>>;
using Outline_point_map = CGAL::First_of_pair_property_map<Outline_cloud::value_type>;
using Outline_shapes = Planar_shapes_3<Outline_kernel>;

struct Cloud_with_shapes {
  Outline_cloud cloud;
  Outline_shapes shapes;
};

constexpr const char* cloud_arguments = "CLOUD.ply DISTANCE ANGLE SIZE | house [POINTS [NOISE]]";

inline Outline_shapes shapes_of(const Outline_cloud& cloud, bool has_normals, const Parameters& parameters)
{
  const auto np = parameters::settings(parameters).point_map(Outline_point_map());
  return has_normals
           ? detect_planes(cloud, np.normal_map(CGAL::Second_of_pair_property_map<Outline_cloud::value_type>()))
           : detect_planes(cloud, np);
}

inline Parameters outline_parameters(double distance, double angle, std::size_t smallest)
{
  Parameters p;
  p.maximum_distance = p.maximum_offset = distance;
  p.maximum_angle = angle;
  p.minimum_region_size = smallest;
  return p;
}

// The arguments are those of cloud_arguments. The noise of the house is a fraction of the diagonal.
inline Cloud_with_shapes cloud_with_shapes(const std::vector<std::string>& arguments)
{
  if(arguments.size() == 4) {
    const Ply_cloud input = read_ply(arguments[0]);
    Outline_cloud cloud = points_with_normals<Outline_kernel>(input.points, input.normals);
    const Parameters p = outline_parameters(std::stod(arguments[1]), std::stod(arguments[2]), std::stoul(arguments[3]));
    Outline_shapes shapes = shapes_of(cloud, input.has_normals(), p);
    return {std::move(cloud), std::move(shapes)};
  }
  if(arguments.empty() || arguments.size() > 3 || arguments[0] != "house")
    throw std::invalid_argument(std::string("usage: ") + cloud_arguments);
  scenes::Options options;
  options.points = arguments.size() > 1 ? std::stoul(arguments[1]) : 100000;
  options.noise = arguments.size() > 2 ? std::stod(arguments[2]) : .0004;
  const scenes::Scene scene = scenes::make_scene(scenes::make_house(), options);
  Outline_cloud cloud = points_with_normals<Outline_kernel>(scene.points, scene.normals);
  Outline_shapes shapes = shapes_of(cloud, true, outline_parameters(.03, 25, 100));
  return {std::move(cloud), std::move(shapes)};
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_OUTLINE_CLOUD_H
