// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The partition of space by the planes, with and without regularization, for
// CGAL::Kinetic_space_partition_3 of CGAL 6: regularity makes far fewer cells.
//   kinetic_partition [CLOUD [maximum_distance [minimum_region_size]]]
//
// That class takes a convex polygon for each plane, no two of them coplanar. It fits a plane
// to the corners of each polygon, so that the relations hold to about 1e-15 there, no
// longer to the bit. Kinetic_surface_reconstruction_3 detects planes of its own.

#include "convex_polygons.h"
#include "regular_and_free_shapes.h"

#include <CGAL/Kinetic_space_partition_3.h>
#include <CGAL/Real_timer.h>

#include <cstdio>
#include <cstdlib>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Shapes = CGAL::Tandem::Planar_shapes_3<Kernel>;
using Polygons = Convex_polygons<Kernel>;

// One for each distinct plane.
Polygons polygons_of(const std::vector<Point_with_normal>& points, const Shapes& shapes)
{
  return convex_polygons<Kernel>(
    CGAL::Tandem::projected_points(points, shapes, CGAL::Tandem::parameters::point_map(Point_map())),
    CGAL::Tandem::distinct_planes(shapes));
}

// Prints a row and returns the number of cells.
std::size_t partition(const Polygons& polygons, const char* name)
{
  CGAL::Real_timer timer;
  timer.start();
  CGAL::Kinetic_space_partition_3<Kernel> partition;
  partition.insert(polygons.points, polygons.corners);
  partition.initialize();
  partition.partition(1); // each polygon grows until it meets one other
  std::printf("%-20s %2zu polygons, %3zu cells in %.2f s\n", name, polygons.corners.size(),
              std::size_t(partition.number_of_volumes()), timer.time());
  return partition.number_of_volumes();
}

int main(int argc, char* argv[])
{
  const auto [points, regular, free] = detect_regular_and_free_shapes(argc, argv);
  const std::size_t cells = partition(polygons_of(points, regular), "regularized planes");
  const std::size_t cells_without = partition(polygons_of(points, free), "free planes");
  return cells > 0 && cells <= cells_without ? EXIT_SUCCESS : EXIT_FAILURE;
}
