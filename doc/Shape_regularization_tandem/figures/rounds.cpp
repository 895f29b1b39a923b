// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What there is after the rounds 1, 2 and 3 of a detection, and at its end: rows of the table of the manual, and files
// as detect_planes --labels and --planes writes them.
//   rounds CLOUD.ply MAXIMUM_DISTANCE MAXIMUM_ANGLE MINIMUM_REGION_SIZE FOLDER
// writes FOLDER/round_1.labels, FOLDER/round_1.planes, ...

#include "clouds/read_ply.h"

#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Simple_cartesian.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;
using Traits = CGAL::Tandem::Tandem_traits_3<Kernel, std::vector<Point_with_normal>, Point_map, Normal_map>;

void look(const CGAL::Tandem::Planar_shapes_3<Kernel>& shapes, const std::string& when, const std::string& path)
{
  const CGAL::Tandem::Statistics& s = shapes.statistics();
  std::printf("| %s | %zu | %zu | %zu | %.2f | %.1f %% |\n", when.c_str(), s.number_of_shapes, s.number_of_directions,
              s.number_of_planes, s.complexity, 100 * s.coverage);
  std::ofstream labels(path + ".labels", std::ios::binary), planes(path + ".planes");
  for(const std::int32_t label : shapes.shape_indices())
    labels.write(reinterpret_cast<const char*>(&label), sizeof label);
  for(std::size_t i = 0; i < shapes.number_of_shapes(); ++i) {
    const auto& c = shapes.coefficients(i);
    planes << c[0] << ' ' << c[1] << ' ' << c[2] << ' ' << c[3] << '\n';
  }
}

} // namespace

int main(int argc, char** argv)
try {
  if(argc != 6)
    throw std::runtime_error("usage: rounds CLOUD.ply MAXIMUM_DISTANCE MAXIMUM_ANGLE MINIMUM_REGION_SIZE FOLDER");
  const CGAL::Tandem::benchmark::Ply_cloud cloud = CGAL::Tandem::benchmark::read_ply(argv[1]);
  const auto points = CGAL::Tandem::benchmark::points_with_normals<Kernel>(cloud.points, cloud.normals);
  const std::string folder = argv[5] + std::string("/");
  CGAL::Tandem::Planar_shape_detection_3<Traits> detection(
    points, CGAL::Tandem::parameters::maximum_distance(std::atof(argv[2]))
              .maximum_angle(std::atof(argv[3]))
              .minimum_region_size(std::size_t(std::atol(argv[4])))
              .point_map(Point_map())
              .normal_map(Normal_map()));
  for(int round = 1; detection.iterate(); ++round)
    look(detection.shapes(), "round " + std::to_string(round), folder + "round_" + std::to_string(round));
  detection.finish();
  look(detection.shapes(), "the end game", folder + "round_last");
  return 0;
} catch(const std::exception& e) {
  std::fprintf(stderr, "rounds: %s\n", e.what());
  return 1;
}
