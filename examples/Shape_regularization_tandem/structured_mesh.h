// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle mesh of structured points, as a file OFF, and how exactly its points are on their planes.

#ifndef TANDEM_EXAMPLES_STRUCTURED_MESH_H
#define TANDEM_EXAMPLES_STRUCTURED_MESH_H

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/structure_point_set.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <string>
#include <vector>

using Structure = CGAL::Point_set_with_structure<CGAL::Exact_predicates_inexact_constructions_kernel>;
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
      std::vector<Structure::Plane> planes;
      structure.adjacency(i, std::back_inserter(planes));
      if(planes.empty())
        continue;
      const std::size_t kind = (std::min)(planes.size(), std::size_t(3)) - 1;
      ++number_of_points[kind];
      for(const Structure::Plane& plane : planes)
        largest_distance[kind] =
          (std::max)(largest_distance[kind], std::sqrt(CGAL::squared_distance(structure.point(i), plane)));
    }
  }
};

// No edge is longer than `bound`. Returns the number of triangles.
inline std::size_t write_mesh(const std::string& name, const Structure& structure, double bound)
{
  std::vector<Structure::Point> points;
  for(std::size_t i = 0; i < structure.size(); ++i)
    points.push_back(structure.point(i));
  std::vector<Facet> facets;
  CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(), std::back_inserter(facets),
                                               Structure_aware_priority{structure, bound});
  std::ofstream out(name);
  out << std::setprecision(17) << "OFF\n" << points.size() << ' ' << facets.size() << " 0\n";
  for(const Structure::Point& p : points)
    out << p << '\n';
  for(const Facet& f : facets)
    out << "3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
  return facets.size();
}

#endif // TANDEM_EXAMPLES_STRUCTURED_MESH_H
