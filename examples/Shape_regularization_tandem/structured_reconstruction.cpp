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
// its planes exactly: the attraction_factor of the structure sets how close.

#include "house_cloud.h"

#include <CGAL/Shape_regularization_tandem.h>

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/structure_point_set.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iomanip>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;
using Structure = CGAL::Point_set_with_structure<Kernel>;
using Facet = std::array<std::size_t, 3>;

// The size of a triangle counts as usual, but less where the structure supports it. No edge is longer than `bound`.
struct Structure_aware_priority {
  const Structure& structure;
  double bound;

  template <class Front, class Cell_handle>
  double operator()(const Front& front, Cell_handle cell, int index) const
  {
    std::array<typename Front::Vertex_handle, 3> vertex;
    for(int i = 0; i < 3; ++i)
      vertex[i] = cell->vertex((index + 1 + i) % 4);
    for(int i = 0; i < 3; ++i)
      if(CGAL::squared_distance(vertex[i]->point(), vertex[(i + 1) % 3]->point()) > bound * bound)
        return front.infinity();
    const Facet facet = {vertex[0]->info(), vertex[1]->info(), vertex[2]->info()};
    return (5 - structure.facet_coherence(facet)) * front.smallest_radius_delaunay_sphere(cell, index); // -1 to 3
  }
};

// How many points are on one plane, on the line of two, on the corner of more; and how exactly.
struct Exactness {
  std::size_t number_of_points[3] = {0, 0, 0};
  double largest_distance[3] = {0, 0, 0};

  explicit Exactness(const Structure& structure)
  {
    for(std::size_t i = 0; i < structure.size(); ++i) {
      std::vector<Kernel::Plane_3> planes;
      structure.adjacency(i, std::back_inserter(planes));
      if(planes.empty())
        continue;
      const std::size_t kind = (std::min)(planes.size(), std::size_t(3)) - 1;
      ++number_of_points[kind];
      for(const Kernel::Plane_3& plane : planes)
        largest_distance[kind] =
          (std::max)(largest_distance[kind], std::sqrt(CGAL::squared_distance(structure.point(i), plane)));
    }
  }
};

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

  std::vector<Kernel::Point_3> structured;
  for(std::size_t i = 0; i < structure.size(); ++i)
    structured.push_back(structure.point(i));
  std::vector<Facet> facets;
  CGAL::advancing_front_surface_reconstruction(structured.begin(), structured.end(), std::back_inserter(facets),
                                               Structure_aware_priority{structure, 4 * spacing});

  std::ofstream out("structured.off");
  out << std::setprecision(17) << "OFF\n" << structured.size() << ' ' << facets.size() << " 0\n";
  for(const Kernel::Point_3& p : structured)
    out << p << '\n';
  for(const Facet& f : facets)
    out << "3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';

  const Exactness e(structure);
  std::printf("%zu points, structured: %zu\n", points.size(), structured.size());
  for(int kind = 0; kind < 3; ++kind)
    std::printf("%zu on %s, at most %.1g away from it\n", e.number_of_points[kind],
                kind == 0   ? "a plane"
                : kind == 1 ? "the line of two planes"
                            : "a corner",
                e.largest_distance[kind]);
  std::printf("%zu triangles\n", facets.size());
  return !facets.empty() && e.largest_distance[0] < 1e-9 ? EXIT_SUCCESS : EXIT_FAILURE;
}
