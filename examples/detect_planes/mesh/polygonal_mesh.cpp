// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/mesh_methods.h"

#include "messages.h"
#include "signals.h"
#ifdef CGAL_USE_SCIP
#include <CGAL/SCIP_mixed_integer_program_traits.h>
#else
#include "mesh/Limited_solver.h"
#endif

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygonal_surface_reconstruction.h>
#include <CGAL/Surface_mesh.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace program {

namespace {

using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Reconstruction = CGAL::Polygonal_surface_reconstruction<Kernel>;
using Item = Mesh_input::Item;
namespace PMP = CGAL::Polygon_mesh_processing;

#ifdef CGAL_USE_SCIP
struct Solver : CGAL::SCIP_mixed_integer_program_traits<double> {
  inline static int seconds = 0; // its limits cannot be reached
  inline static bool is_out_of_time = false;
};
#else
using Solver = Limited_solver;
#endif

constexpr std::size_t most_candidates = 10000; // faces; the solver would not end

void check_candidates(const Reconstruction& reconstruction)
{
  if(is_interrupted())
    throw Interrupted();
  Mesh candidates;
  reconstruction.output_candidate_faces(candidates);
  if(candidates.number_of_faces() > most_candidates)
    throw Too_many_faces("--mesh: the planes cut each other into " + std::to_string(candidates.number_of_faces()) +
                         " faces, of which the solver takes at most " + std::to_string(most_candidates));
}

void solve(Reconstruction& reconstruction, Mesh& model, int seconds, std::size_t planes)
{
  Solver::seconds = seconds;
  if(reconstruction.reconstruct<Solver>(model))
    return;
  if(Solver::is_out_of_time)
    throw std::runtime_error("--mesh: no surface of " + std::to_string(planes) + " planes was found within " +
                             std::to_string(seconds) +
                             " seconds of processor time: take fewer planes by --mesh-planes, or more time by "
                             "--mesh-seconds");
  throw std::runtime_error("--mesh: no closed surface was found (" + reconstruction.error_message() + ")");
}

// Each connected part on its own.
void orient_outward(Surface& surface)
{
  boost::disjoint_sets_with_storage<> parts(surface.points.size());
  for(const Surface::Face& face : surface.faces)
    for(std::size_t corner : face)
      parts.union_set(face.front(), corner);
  std::map<std::size_t, std::vector<Surface::Face>> faces_of_part;
  for(const Surface::Face& face : surface.faces)
    faces_of_part[parts.find_set(face.front())].push_back(face);
  surface.faces.clear();
  for(auto& [part, faces] : faces_of_part) {
    if(signed_volume(surface, faces) < 0)
      reverse(faces);
    surface.faces.insert(surface.faces.end(), faces.begin(), faces.end());
  }
}

} // namespace

// CGAL joins what is nearer than 1e-5, in any unit: by this power of two, the points extend over 512 to 1024.
int exponent_of(const std::vector<Item>& items)
{
  CGAL::Bbox_3 box;
  for(const Item& item : items)
    box += std::get<0>(item).bbox();
  int exponent = 0;
  std::frexp((std::max)({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()}), &exponent);
  return 10 - exponent;
}

Kernel::Point_3 scaled(const Kernel::Point_3& p, int exponent)
{
  return {std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent)};
}

// It fits a plane to each group of points, which is the plane of projected points.
Surface polygonal_mesh(const Mesh_input& input, int seconds)
{
  const Captured_messages captured;
  const int exponent = exponent_of(input.items);
  std::vector<Item> items = input.items;
  for(Item& item : items)
    std::get<0>(item) = scaled(std::get<0>(item), exponent);
  Reconstruction reconstruction(items, CGAL::Nth_of_tuple_property_map<0, Item>(),
                                CGAL::Nth_of_tuple_property_map<1, Item>(), CGAL::Nth_of_tuple_property_map<2, Item>());
  check_candidates(reconstruction);
  Mesh model;
  solve(reconstruction, model, seconds, input.planes.size());
  // CGAL 5 leaves the faces unconnected and of any orientation; CGAL 6 does this itself.
  Surface surface;
  surface.number_of_planes = input.planes.size();
  PMP::polygon_mesh_to_polygon_soup(model, surface.points, surface.faces);
  PMP::merge_duplicate_points_in_polygon_soup(surface.points, surface.faces);
  PMP::orient_polygon_soup(surface.points, surface.faces);
  orient_outward(surface);
  if(!is_closed(surface))
    throw std::runtime_error("--mesh: no closed surface was found");
  for(Kernel::Point_3& p : surface.points)
    p = scaled(p, -exponent);
  return surface;
}

} // namespace program
