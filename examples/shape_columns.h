// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The columns of tables of shapes, so that those of the program and of the Python module have the same names.

#ifndef TANDEM_EXAMPLES_SHAPE_COLUMNS_H
#define TANDEM_EXAMPLES_SHAPE_COLUMNS_H

#include <CGAL/Shape_regularization_tandem/shape_facts.h>
#include <CGAL/Tandem/Statistics.h>

#include <array>
#include <string>
#include <vector>

namespace tandem_examples {

using CGAL::Tandem::Plane_uncertainty;
using CGAL::Tandem::Shape_facts;

template <class Row>
struct Shape_column {
  const char* name;
  double Row::*number;
};

constexpr std::array<Shape_column<Shape_facts>, 13> fact_columns = {{{"area", &Shape_facts::area},
                                                                     {"length", &Shape_facts::length},
                                                                     {"width", &Shape_facts::width},
                                                                     {"lowest", &Shape_facts::lowest},
                                                                     {"highest", &Shape_facts::highest},
                                                                     {"tilt_deg", &Shape_facts::tilt_deg},
                                                                     {"dip_deg", &Shape_facts::dip_deg},
                                                                     {"azimuth_deg", &Shape_facts::azimuth_deg},
                                                                     {"rms_distance", &Shape_facts::rms_distance},
                                                                     {"mean_distance", &Shape_facts::mean_distance},
                                                                     {"turned_deg", &Shape_facts::turned_deg},
                                                                     {"shifted", &Shape_facts::shifted},
                                                                     {"curved", &Shape_facts::curved}}};

constexpr std::array<Shape_column<Plane_uncertainty>, 3> uncertainty_columns = {
  {{"noise", &Plane_uncertainty::noise},
   {"offset_deviation", &Plane_uncertainty::offset_deviation},
   {"angle_deviation_deg", &Plane_uncertainty::angle_deg}}};

// All columns in their order: f(name, number_of), where number_of(s) is a whole number for counts and groups.
template <class Shapes, class F>
void for_each_shape_column(const Shapes& shapes, const std::vector<Shape_facts>& facts, F f)
{
  f("points", [&](std::size_t s) { return facts[s].number_of_points; });
  for(std::size_t k = 0; k < 4; ++k)
    f(std::string(1, "abcd"[k]), [&](std::size_t s) { return shapes.coefficients(s)[k]; });
  for(std::size_t k = 0; k < 3; ++k)
    f(std::string(1, "xyz"[k]), [&](std::size_t s) { return facts[s].centroid[k]; });
  for(const auto& column : fact_columns)
    f(column.name, [&](std::size_t s) { return facts[s].*column.number; });
  for(const auto& column : uncertainty_columns)
    f(column.name, [&](std::size_t s) { return shapes.uncertainty(s).*column.number; });
  f("parallel_group", [&](std::size_t s) { return shapes.parallel_group(s); });
  f("coplanar_group", [&](std::size_t s) { return shapes.coplanar_group(s); });
}

} // namespace tandem_examples

#endif // TANDEM_EXAMPLES_SHAPE_COLUMNS_H
