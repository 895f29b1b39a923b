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

#include "house_cloud.h"

#include <CGAL/Shape_regularization_tandem.h>

#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygonal_surface_reconstruction.h>
#include <CGAL/Real_timer.h>
#include <CGAL/Surface_mesh.h>
#ifdef CGAL_USE_SCIP
#include <CGAL/SCIP_mixed_integer_program_traits.h>
using Solver = CGAL::SCIP_mixed_integer_program_traits<double>;
#else
#include <CGAL/GLPK_mixed_integer_program_traits.h>
using Solver = CGAL::GLPK_mixed_integer_program_traits<double>;
#endif

#include <cstdio>
#include <cstdlib>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;
using Shapes = CGAL::Tandem::Planar_shapes_3<Kernel>;
using Item = CGAL::Tandem::Point_with_plane<Kernel>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace PMP = CGAL::Polygon_mesh_processing;

// CGAL 5 leaves the faces unconnected and of any orientation; CGAL 6 does this itself.
void connect_faces(Mesh& mesh)
{
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  PMP::polygon_mesh_to_polygon_soup(mesh, points, polygons);
  PMP::merge_duplicate_points_in_polygon_soup(points, polygons);
  PMP::orient_polygon_soup(points, polygons);
  mesh.clear();
  PMP::polygon_soup_to_polygon_mesh(points, polygons, mesh);
}

// How far two faces that are within 8 degrees of parallel or orthogonal are from being so, at most, in degrees.
double largest_irregularity(const Mesh& mesh)
{
  double largest = 0;
  for(const auto f : mesh.faces())
    for(const auto g : mesh.faces()) {
      const Kernel::Vector_3 m = PMP::compute_face_normal(f, mesh), n = PMP::compute_face_normal(g, mesh);
      const double cosine = std::fabs(m * n), sine = std::sqrt(CGAL::cross_product(m, n).squared_length());
      const double angle = std::asin((std::min)({cosine, sine, 1.})) * 180 / CGAL_PI;
      if(angle < 8)
        largest = (std::max)(largest, angle);
    }
  return largest;
}

// Prints a row and returns the number of faces, 0 without a closed model.
std::size_t reconstruct(const std::vector<Item>& items, std::size_t planes, const std::string& name)
{
  CGAL::Polygonal_surface_reconstruction<Kernel> reconstruction(items, CGAL::Nth_of_tuple_property_map<0, Item>(),
                                                                CGAL::Nth_of_tuple_property_map<1, Item>(),
                                                                CGAL::Nth_of_tuple_property_map<2, Item>());
  Mesh candidates, model;
  reconstruction.output_candidate_faces(candidates);
  CGAL::Real_timer timer;
  timer.start();
  if(!reconstruction.reconstruct<Solver>(model)) {
    std::printf("%-25s %zu planes: %s\n", name.c_str(), planes, reconstruction.error_message().c_str());
    return 0;
  }
  timer.stop();
  connect_faces(model);
  CGAL::IO::write_OFF("model_of_" + name + ".off", model);
  const bool is_closed = CGAL::is_closed(model);
  std::printf("%-25s %2zu planes, %3zu candidate faces, solved in %.3f s: %2zu faces, %s, angles off by %.1g degrees\n",
              name.c_str(), planes, std::size_t(candidates.number_of_faces()), timer.time(),
              std::size_t(model.number_of_faces()), is_closed ? "closed" : "open", largest_irregularity(model));
  return is_closed ? model.number_of_faces() : 0;
}

int main(int argc, char* argv[])
{
  const std::vector<Point_with_normal> points = example_cloud(argc, argv);
  const auto np = CGAL::Tandem::parameters::point_map(Point_map())
                    .normal_map(Normal_map())
                    .maximum_distance(argc > 2 ? std::atof(argv[2]) : .05)
                    .minimum_region_size(argc > 3 ? std::size_t(std::atol(argv[3])) : 200);
  const Shapes regular = CGAL::Tandem::detect_planes(points, np);
  const Shapes free = CGAL::Tandem::detect_planes(
    points, np.regularize_parallelism(false).regularize_orthogonality(false).regularize_coplanarity(false));

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
