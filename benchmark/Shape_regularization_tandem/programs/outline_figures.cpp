// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How good the outlines of shapes are: straightened only, regularized by CGAL's regularize_closed_contour(), and those of
// polygons(). For a cloud, or for the house of the generated scenes, whose areas are known.
//   outline_figures CLOUD.ply MAXIMUM_DISTANCE MAXIMUM_ANGLE MINIMUM_REGION_SIZE [FOLDER]
// For the shapes with most points FOLDER gets I.points and I.outline, in the plane of the shape, for gnuplot.
//   outline_figures house [POINTS [NOISE, a share of the diagonal]]

#include "clouds/outline_cloud.h"
#include "criteria/contour_regularization.h"
#include "criteria/outline_figures.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace CGAL::Tandem::benchmark;
namespace scenes = CGAL::Tandem::scenes;

namespace {

using CGAL::Tandem::internal::outlines::outline_table;

// Prints the figures of the outlines that make() returns, and the seconds that it takes.
template <class Make>
Outline_areas measure(const std::string& name, const Cloud_with_shapes& input, Make make)
{
  const auto start = std::chrono::steady_clock::now();
  Outline_areas areas = make();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  print(name, figures_of(input.cloud, input.shapes, areas), seconds);
  if(!input.scene.points.empty()) {
    const Area_errors errors = errors_of(scenes::make_house(), input.scene, input.shapes, areas);
    std::cout << "  truth " << errors.truth << " missing " << errors.missing / errors.truth << " surplus "
              << errors.surplus / errors.truth << "\n";
  }
  return areas;
}

std::vector<double> border_spacings(const Cloud_with_shapes& input)
{
  std::vector<double> result;
  for(std::size_t s = 0; s < input.shapes.number_of_shapes(); ++s) {
    std::vector<double> all;
    for(const auto& [p, spacing] : border_points_of(input.cloud, input.shapes, s))
      all.push_back(spacing);
    std::nth_element(all.begin(), all.begin() + std::ptrdiff_t(all.size() / 2), all.end());
    result.push_back(all.empty() ? 0 : all[all.size() / 2]);
  }
  return result;
}

Outline_areas measure_all(const Cloud_with_shapes& input)
{
  std::vector<CGAL::Tandem::internal::Position> points;
  for(const auto& item : input.cloud)
    points.push_back({item.first.x(), item.first.y(), item.first.z()});
  const auto draft = [&] { return outline_table(points, input.shapes.data(), false); };
  const std::vector<double> spacing = border_spacings(input);
  measure("straightened", input, [&] { return Outline_areas(draft()); });
  measure("regularize_closed_contour", input,
          [&] { return Outline_areas(regularized_contours(draft(), input.shapes, spacing)); });
  return measure("polygons", input, [&] {
    return CGAL::Tandem::polygons(input.shapes, input.cloud, CGAL::Tandem::parameters::point_map(Outline_point_map()));
  });
}

void write_plots(const std::string& folder, const Outline_cloud& cloud, const Outline_shapes& shapes,
                 const Outline_areas& areas)
{
  constexpr std::size_t largest_number = 12;
  for(std::size_t s = 0; s < shapes.number_of_shapes() && s < largest_number; ++s) {
    const auto& c = shapes.coefficients(s);
    const Outline_kernel::Vector_3 n(c[0], c[1], c[2]);
    const bool is_level = std::fabs(c[2]) > .9;
    const Outline_kernel::Vector_3 across =
      is_level ? Outline_kernel::Vector_3(c[2], 0, -c[0]) : Outline_kernel::Vector_3(-c[1], c[0], 0);
    const Outline_kernel::Vector_3 u = across / std::sqrt(across.squared_length()), v = CGAL::cross_product(n, u);
    const auto write = [&](std::ostream& out, const Outline_kernel::Point_3& p) {
      out << u * (p - CGAL::ORIGIN) << ' ' << v * (p - CGAL::ORIGIN) << '\n';
    };
    std::ofstream points(folder + '/' + std::to_string(s) + ".points"),
      outline(folder + '/' + std::to_string(s) + ".outline");
    for(std::size_t i : shapes.points(s))
      write(points, cloud[i].first);
    for(const auto& edge : edges_of(areas, s)) {
      write(outline, edge.source());
      write(outline, edge.target());
      outline << '\n';
    }
    if(!points || !outline)
      throw std::runtime_error(folder + " cannot be written to");
  }
}

} // namespace

int main(int argc, char** argv)
try {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool has_folder = arguments.size() == 5;
  const std::string folder = has_folder ? arguments.back() : "";
  arguments.resize(has_folder ? 4 : arguments.size());
  const Cloud_with_shapes input = cloud_with_shapes(arguments);
  const Outline_areas areas = measure_all(input);
  if(has_folder)
    write_plots(folder, input.cloud, input.shapes, areas);
  return 0;
} catch(const std::exception& e) {
  std::cerr << "outline_figures: " << e.what() << "\n";
  return 1;
}
