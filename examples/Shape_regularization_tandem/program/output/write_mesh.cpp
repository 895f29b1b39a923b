// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/write_mesh.h"
#include "Captured_messages.h"

#if defined(CGAL_EIGEN3_ENABLED) && (defined(CGAL_USE_GLPK) || defined(CGAL_USE_SCIP))
#include "output/write_results.h"

#include <CGAL/Shape_regularization_tandem/adapters.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygonal_surface_reconstruction.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/OFF.h>
#ifdef CGAL_USE_SCIP
#include <CGAL/SCIP_mixed_integer_program_traits.h>
#else
#include <CGAL/GLPK_mixed_integer_program_traits.h>
#endif

#include <iomanip>
#include <numeric>
#include <ostream>
#include <set>

namespace program {

namespace {

#ifdef CGAL_USE_SCIP
using Solver = CGAL::SCIP_mixed_integer_program_traits<double>;
#else
using Solver = CGAL::GLPK_mixed_integer_program_traits<double>;
#endif
using Item = CGAL::Tandem::Point_with_plane<Kernel>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Reconstruction = CGAL::Polygonal_surface_reconstruction<Kernel>;
namespace PMP = CGAL::Polygon_mesh_processing;

constexpr std::size_t most_planes = 12;        // more on demand only
constexpr std::size_t most_candidates = 10000; // faces; the solver would not end

struct Soup {
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> faces;
};

// Groups that are consecutive from 0: that class fits a plane to each, which is the plane of projected points.
std::vector<Item> items_of_planes(const Point_set& points, const Shapes& shapes, std::size_t largest_number)
{
  std::vector<std::size_t> size(shapes.number_of_coplanar_groups(), 0), order(size.size());
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    size[shapes.coplanar_group(s)] += shapes.points(s).size();
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });
  std::vector<int> number(size.size(), -1);
  for(std::size_t i = 0; i < (std::min)(largest_number, order.size()); ++i)
    number[order[i]] = int(i);
  std::vector<Item> result;
  for(Item& item : CGAL::Tandem::projected_points(points, shapes)) {
    int& group = std::get<2>(item);
    group = number[std::size_t(group)];
    if(group >= 0)
      result.push_back(item);
  }
  return result;
}

Soup reconstruct(const std::vector<Item>& items)
{
  const Captured_messages captured;
  Reconstruction reconstruction(items, CGAL::Nth_of_tuple_property_map<0, Item>(),
                                CGAL::Nth_of_tuple_property_map<1, Item>(), CGAL::Nth_of_tuple_property_map<2, Item>());
  Mesh candidates, model;
  reconstruction.output_candidate_faces(candidates);
  if(candidates.number_of_faces() > most_candidates)
    throw std::runtime_error("--mesh: the planes cut each other into " + std::to_string(candidates.number_of_faces()) +
                             " faces, which are too many: take fewer planes by --mesh-planes, or a larger "
                             "--minimum-region-size");
  if(!reconstruction.reconstruct<Solver>(model))
    throw std::runtime_error("--mesh: no closed surface was found (" + reconstruction.error_message() + ")");
  // CGAL 5 leaves the faces unconnected and of any orientation; CGAL 6 does this itself.
  Soup soup;
  PMP::polygon_mesh_to_polygon_soup(model, soup.points, soup.faces);
  PMP::merge_duplicate_points_in_polygon_soup(soup.points, soup.faces);
  PMP::orient_polygon_soup(soup.points, soup.faces);
  return soup;
}

// Points and faces, as .off and .ply have them.
void write_rows(std::ostream& out, const Soup& soup)
{
  for(const Kernel::Point_3& p : soup.points)
    out << p << '\n';
  for(const auto& face : soup.faces) {
    out << face.size();
    for(std::size_t corner : face)
      out << ' ' << corner;
    out << '\n';
  }
}

void write_off(std::ostream& out, const Soup& soup)
{
  out << "OFF\n" << soup.points.size() << ' ' << soup.faces.size() << " 0\n";
  write_rows(out, soup);
}

void write_obj(std::ostream& out, const Soup& soup)
{
  out << "# detect_planes of Tandem\n";
  for(const Kernel::Point_3& p : soup.points)
    out << "v " << p << '\n';
  for(const auto& face : soup.faces) {
    out << 'f';
    for(std::size_t corner : face)
      out << ' ' << corner + 1;
    out << '\n';
  }
}

void write_ply(std::ostream& out, const Soup& soup)
{
  out << "ply\nformat ascii 1.0\ncomment detect_planes of Tandem\nelement vertex " << soup.points.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << soup.faces.size()
      << "\nproperty list int int vertex_indices\nend_header\n";
  write_rows(out, soup);
}

} // namespace

std::string missing_for_mesh() { return {}; }

void write_mesh(std::ostream& out, const Point_set& points, const Shapes& shapes, const std::string& path,
                std::optional<long long> number_of_planes)
{
  const std::size_t found = shapes.number_of_coplanar_groups();
  if(!number_of_planes && found > most_planes)
    throw std::runtime_error(
      "--mesh: " + std::to_string(found) +
      " planes were found, which take too long: take fewer by --mesh-planes or by a larger --minimum-region-size");
  if(found < 4)
    throw std::runtime_error("--mesh: a closed surface needs four planes, " + std::to_string(found) + " were found");
  const Soup soup = reconstruct(items_of_planes(points, shapes, std::size_t(number_of_planes.value_or(most_planes))));
  const std::string extension = lower_case_extension(path);
  out << std::setprecision(17);
  if(extension == ".off")
    write_off(out, soup);
  else if(extension == ".obj")
    write_obj(out, soup);
  else
    write_ply(out, soup);
}

} // namespace program

#else

#include <stdexcept>

namespace program {

std::string missing_for_mesh()
{
#ifdef CGAL_EIGEN3_ENABLED
  return "the solver GLPK or SCIP";
#else
  return "Eigen 3";
#endif
}

void write_mesh(std::ostream&, const Point_set&, const Shapes&, const std::string&, std::optional<long long>)
{
  throw std::runtime_error("--mesh needs " + missing_for_mesh() + ": this program was built without it");
}

} // namespace program

#endif
