// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/mesh_methods.h"

#include "messages.h"
#include "mesh/kinetic/Boundary.h"
#include "mesh/kinetic/Volumes.h"
#include "mesh/kinetic/inside_volumes.h"
#include "signals.h"

#include "../Shape_regularization_tandem/convex_polygons.h"

#include <CGAL/Named_function_parameters.h>

#include <iostream>

namespace program {

namespace {

constexpr std::size_t number_of_intersections = 1; // a polygon grows until it meets as many others

void stop_if_interrupted()
{
  if(is_interrupted())
    throw Interrupted();
}

// Each plane of the input has a polygon. More of them than this size would make CGAL cut the space by an octree, whose
// planes would be walls of the surface.
Volumes partition(const Mesh_input& input)
{
  const Captured_messages errors(std::cerr), messages(std::cout);
  const Convex_polygons<Kernel> polygons = convex_polygons<Kernel>(input.items, input.planes);
  Volumes::Partition partition;
  partition.insert(polygons.points, polygons.corners);
  partition.initialize(CGAL::parameters::max_octree_node_size(input.planes.size()));
  stop_if_interrupted();
  partition.partition(number_of_intersections);
  stop_if_interrupted();
  return Volumes(partition);
}

} // namespace

Surface kinetic_mesh(const Mesh_input& input)
{
  const Volumes volumes = partition(input);
  const std::vector<bool> is_inside = inside_volumes(volumes, coverage_of_planes(input));
  stop_if_interrupted();
  return Boundary(volumes, is_inside).surface();
}

} // namespace program
