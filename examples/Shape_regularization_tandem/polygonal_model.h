// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh that CGAL::Polygonal_surface_reconstruction makes of points on planes, and how regular it is.

#ifndef TANDEM_EXAMPLES_POLYGONAL_MODEL_H
#define TANDEM_EXAMPLES_POLYGONAL_MODEL_H

#include <CGAL/Shape_regularization_tandem/adapters.h>

#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygonal_surface_reconstruction.h>
#include <CGAL/Surface_mesh.h>
#ifdef CGAL_USE_SCIP
#include <CGAL/SCIP_mixed_integer_program_traits.h>
using Solver = CGAL::SCIP_mixed_integer_program_traits<double>;
#else
#include <CGAL/GLPK_mixed_integer_program_traits.h>
using Solver = CGAL::GLPK_mixed_integer_program_traits<double>;
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

template <class Kernel>
class Polygonal_model {
public:
  using Item = CGAL::Tandem::Point_with_plane<Kernel>;
  using Mesh = CGAL::Surface_mesh<typename Kernel::Point_3>;

  explicit Polygonal_model(const std::vector<Item>& items)
    : reconstruction(items, CGAL::Nth_of_tuple_property_map<0, Item>(), CGAL::Nth_of_tuple_property_map<1, Item>(),
                     CGAL::Nth_of_tuple_property_map<2, Item>())
  {}

  bool solve() { return reconstruction.template reconstruct<Solver>(model); }

  // Once, afterwards. CGAL 5 leaves the faces unconnected and of any orientation; CGAL 6 does this itself.
  void connect_faces()
  {
    namespace PMP = CGAL::Polygon_mesh_processing;
    std::vector<typename Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> polygons;
    PMP::polygon_mesh_to_polygon_soup(model, points, polygons);
    PMP::merge_duplicate_points_in_polygon_soup(points, polygons);
    PMP::orient_polygon_soup(points, polygons);
    model.clear();
    PMP::polygon_soup_to_polygon_mesh(points, polygons, model);
  }

  const Mesh& mesh() const { return model; }
  std::string error_message() const { return reconstruction.error_message(); }

  std::size_t number_of_candidates() const
  {
    Mesh candidates;
    reconstruction.output_candidate_faces(candidates);
    return candidates.number_of_faces();
  }

  // How far two faces that are within 8 degrees of parallel or orthogonal are from being so, at most, in degrees.
  double largest_irregularity() const
  {
    namespace PMP = CGAL::Polygon_mesh_processing;
    double largest = 0;
    for(const auto f : model.faces())
      for(const auto g : model.faces()) {
        const auto m = PMP::compute_face_normal(f, model), n = PMP::compute_face_normal(g, model);
        const double cosine = std::fabs(m * n), sine = std::sqrt(CGAL::cross_product(m, n).squared_length());
        const double angle = std::asin((std::min)({cosine, sine, 1.})) * 180 / CGAL_PI;
        if(angle < 8)
          largest = (std::max)(largest, angle);
      }
    return largest;
  }

private:
  CGAL::Polygonal_surface_reconstruction<Kernel> reconstruction;
  Mesh model;
};

#endif // TANDEM_EXAMPLES_POLYGONAL_MODEL_H
