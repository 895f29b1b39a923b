// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closed surfaces of the planes of a cloud, by the methods of detect_planes --mesh: closed_surface(), and where the program has
// it, CGAL::Polygonal_surface_reconstruction, which is the method of PolyFit. Both get the planes with most points.
//   surface_figures CLOUD.ply MAXIMUM_DISTANCE MAXIMUM_ANGLE MINIMUM_REGION_SIZE
//   surface_figures house [POINTS [NOISE, a share of the diagonal]]

#include "clouds/outline_cloud.h"
#include "criteria/surface_figures.h"

#include "mesh/mesh_methods.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

using namespace CGAL::Tandem::benchmark;

namespace {

constexpr int longest_seconds = 60; // of the solver, in processor time

// One line. make() is the surface.
template <class Make>
void measure(const std::string& method, const Cloud_with_shapes& input, const program::Mesh_input& planes, Make make)
{
  std::cout << method << ": planes " << planes.planes.size() << " " << std::flush;
  const auto start = std::chrono::steady_clock::now();
  program::Surface surface;
  std::string failure = "no volume is enclosed";
  try {
    surface = make();
  } catch(const std::exception& e) {
    failure = e.what();
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if(surface.faces.empty())
    std::cout << failure;
  else
    print(surface_figures(surface.points, surface.faces, planes.planes, input));
  std::cout << " seconds " << seconds << "\n";
}

} // namespace

int main(int argc, char** argv)
try {
  const Cloud_with_shapes input = cloud_with_shapes(std::vector<std::string>(argv + 1, argv + argc));
  program::Point_set points;
  for(const auto& item : input.cloud)
    points.insert(item.first);
  const program::Mesh_input all = program::mesh_input(points, input.shapes);
  std::set<std::size_t, std::greater<>> numbers;
  for(std::size_t most : {all.planes.size(), std::size_t(30), std::size_t(16)})
    numbers.insert((std::min)(most, all.planes.size()));
  for(std::size_t number : numbers) {
    const program::Mesh_input planes = program::largest_planes(all, number);
    measure("closed_surface", input, planes,
            [&] { return program::cells_mesh(points, input.shapes, number, program::Kernel::Vector_3(0, 0, 1)); });
    if constexpr(program::has_polygonal_mesh)
      if(number <= program::polygonal_method.on_demand)
        measure("Polygonal_surface_reconstruction", input, planes,
                [&] { return program::polygonal_mesh(planes, longest_seconds); });
  }
  return 0;
} catch(const std::exception& e) {
  std::cerr << "surface_figures: " << e.what() << "\n";
  return 1;
}
