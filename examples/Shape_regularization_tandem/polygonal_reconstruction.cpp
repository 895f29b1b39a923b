// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A closed polygonal model of a building by CGAL::Polygonal_surface_reconstruction, of
// the planes with and without regularization, in model_of_*.off.
//   polygonal_reconstruction [CLOUD [maximum_distance [minimum_region_size]]]
//
// That class fits planes of its own to the groups of points, and merges groups whose
// planes are within 10 degrees and half of the distance of their points. So that it keeps the
// regularized planes, it gets the points projected onto them, one group for each plane.

#include "polygonal_model.h"
#include "regular_and_free_shapes.h"

#include <CGAL/Real_timer.h>

#include <cstdio>
#include <cstdlib>
#include <string>

using Kernel = house::Kernel;
using Item = CGAL::Tandem::Point_with_plane<Kernel>;

// Prints a row and returns the number of faces, 0 without a closed model.
std::size_t reconstruct(const std::vector<Item>& items, std::size_t planes, const std::string& name)
{
  Polygonal_model<Kernel> model(items);
  CGAL::Real_timer timer;
  timer.start();
  if(!model.solve()) {
    std::printf("%-25s %zu planes: %s\n", name.c_str(), planes, model.error_message().c_str());
    return 0;
  }
  timer.stop();
  model.connect_faces();
  CGAL::IO::write_OFF("model_of_" + name + ".off", model.mesh());
  const bool is_closed = CGAL::is_closed(model.mesh());
  std::printf("%-25s %2zu planes, %3zu candidate faces, solved in %.3f s: %2zu faces, %s, angles off by %.1g degrees\n",
              name.c_str(), planes, model.number_of_candidates(), timer.time(),
              std::size_t(model.mesh().number_of_faces()), is_closed ? "closed" : "open", model.largest_irregularity());
  return is_closed ? model.mesh().number_of_faces() : 0;
}

int main(int argc, char* argv[])
{
  const auto [points, regular, free] = detect_regular_and_free_shapes(argc, argv);
  const auto np = CGAL::Tandem::parameters::point_map(CGAL::First_of_pair_property_map<house::Point_with_normal>());
  const std::size_t faces = reconstruct(CGAL::Tandem::projected_points(points, regular, np),
                                        regular.number_of_coplanar_groups(), "regularized_planes");
  const std::size_t faces_without =
    reconstruct(CGAL::Tandem::projected_points(points, free, np), free.number_of_coplanar_groups(), "free_planes");

  // The usual way: the points as they are, so that groups may be merged; nothing is exact then.
  std::vector<Item> items;
  for(std::size_t s = 0; s < free.number_of_shapes(); ++s)
    for(std::size_t i : free.points(s))
      items.emplace_back(points[i].first, free.oriented_plane(s).orthogonal_vector(), int(s));
  reconstruct(items, free.number_of_shapes(), "points_not_projected");
  return faces > 0 && (faces_without == 0 || faces <= faces_without) ? EXIT_SUCCESS : EXIT_FAILURE;
}
