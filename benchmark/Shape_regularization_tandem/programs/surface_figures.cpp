// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closed surfaces of the planes of a cloud, by closed_surface().
//   surface_figures CLOUD.ply MAXIMUM_DISTANCE MAXIMUM_ANGLE MINIMUM_REGION_SIZE
//   surface_figures house [POINTS [NOISE, a share of the diagonal]]

#include "clouds/outline_cloud.h"
#include "criteria/surface_figures.h"

#include <CGAL/Shape_regularization_tandem/adapters.h>
#include <CGAL/Shape_regularization_tandem/closed_surface.h>

#include <chrono>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace CGAL::Tandem::benchmark;

int main(int argc, char** argv)
try {
  const Cloud_with_shapes input = cloud_with_shapes(std::vector<std::string>(argv + 1, argv + argc));
  const auto start = std::chrono::steady_clock::now();
  const auto surface =
    CGAL::Tandem::closed_surface(input.shapes, input.cloud, CGAL::Tandem::parameters::point_map(Outline_point_map()));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::cout << "planes " << surface.number_of_planes << " ";
  if(surface.is_empty())
    std::cout << "no volume is enclosed";
  else
    print(surface_figures(surface.points, surface.faces, CGAL::Tandem::distinct_planes(input.shapes), input));
  std::cout << " seconds " << seconds << "\n";
  return 0;
} catch(const std::exception& e) {
  std::cerr << "surface_figures: " << e.what() << "\n";
  return 1;
}
