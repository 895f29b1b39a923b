// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle mesh with sharp edges: the points are structured along the detected planes,
// and an advancing front prefers triangles that are coherent with that structure.
//   structured_reconstruction [CLOUD [maximum_distance [spacing]]]
//
// Structuring moves points onto the planes that it gets, onto the lines where two of
// them meet and onto their corners, so the regularity is kept. Corners that are closer
// than three times the spacing, however, are merged into one between them, which is on none of
// its planes exactly, and neither are the points of lines that end there. The attraction_factor
// of the structure sets how close: on the building of CGAL's data, with a
// maximum distance of .15 and a spacing of .4, such points are up to 1 away.

#include "house_cloud.h"
#include "structured_mesh.h"

#include <CGAL/Shape_regularization_tandem.h>

#include <cstdio>
#include <cstdlib>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;

int main(int argc, char* argv[])
{
  const std::vector<Point_with_normal> points = example_cloud(argc, argv);
  const double spacing = argc > 3 ? std::atof(argv[3]) : .25;
  const auto shapes = CGAL::Tandem::detect_planes(points, CGAL::Tandem::parameters::point_map(Point_map())
                                                            .normal_map(Normal_map())
                                                            .maximum_distance(argc > 2 ? std::atof(argv[2]) : .05));

  // Each plane once: pieces of one plane are one primitive. Named parameters for CGAL are made anew.
  const Structure structure(points, CGAL::Tandem::distinct_planes(shapes), spacing,
                            CGAL::parameters::point_map(Point_map())
                              .normal_map(Normal_map())
                              .plane_map(CGAL::Identity_property_map<Kernel::Plane_3>())
                              .plane_index_map(CGAL::Tandem::plane_index_map(shapes)));

  const std::size_t triangles = write_mesh("structured.off", structure, 4 * spacing);

  const Exactness e(structure);
  std::printf("%zu points, structured: %zu\n", points.size(), structure.size());
  for(int kind = 0; kind < 3; ++kind)
    std::printf("%zu on %s, at most %.1g away from it\n", e.number_of_points[kind],
                kind == 0   ? "a plane"
                : kind == 1 ? "the line of two planes"
                            : "a corner",
                e.largest_distance[kind]);
  std::printf("%zu triangles\n", triangles);
  return triangles > 0 && e.largest_distance[0] < 1e-9 ? EXIT_SUCCESS : EXIT_FAILURE;
}
