// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The columns of tables of shapes, so that those of the program and of the Python module have the same names.

#ifndef TANDEM_EXAMPLES_SHAPE_COLUMNS_H
#define TANDEM_EXAMPLES_SHAPE_COLUMNS_H

#include <CGAL/Shape_regularization_tandem/shape_facts.h>
#include <CGAL/Tandem/Statistics.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace tandem_examples {

using CGAL::Tandem::Plane_uncertainty;
using CGAL::Tandem::Shape_facts;

constexpr double most_curved_face = .5; // a shape whose value `curved` is above this is a facet of a curved surface

template <class Row>
struct Shape_column {
  const char* name;
  double Row::*number;
};

// Of the plane, so that a shape without points has them, too.
constexpr std::array<Shape_column<Shape_facts>, 3> plane_columns = {{{"tilt_deg", &Shape_facts::tilt_deg},
                                                                     {"dip_deg", &Shape_facts::dip_deg},
                                                                     {"azimuth_deg", &Shape_facts::azimuth_deg}}};

constexpr std::array<Shape_column<Shape_facts>, 4> size_columns = {{{"length", &Shape_facts::length},
                                                                    {"width", &Shape_facts::width},
                                                                    {"lowest", &Shape_facts::lowest},
                                                                    {"highest", &Shape_facts::highest}}};

constexpr std::array<Shape_column<Shape_facts>, 5> fit_columns = {{{"rms_distance", &Shape_facts::rms_distance},
                                                                   {"mean_distance", &Shape_facts::mean_distance},
                                                                   {"turned_deg", &Shape_facts::turned_deg},
                                                                   {"shifted", &Shape_facts::shifted},
                                                                   {"curved", &Shape_facts::curved}}};

constexpr std::array<Shape_column<Plane_uncertainty>, 3> uncertainty_columns = {
  {{"noise", &Plane_uncertainty::noise},
   {"offset_deviation", &Plane_uncertainty::offset_deviation},
   {"angle_deviation_deg", &Plane_uncertainty::angle_deg}}};

// All columns in their order: f(name, value_of), where value_of(s) is a whole number for counts, groups and shapes, of
// which -1 is none, and a word for the class. `behind` is a column only where the sensor is known. What a shape has not
// is not a number: the area, if it has no outline, and what is measured at points, if it has none.
template <class Shapes, class F>
void for_each_shape_column(const Shapes& shapes, const std::vector<Shape_facts>& facts, bool is_seen, F f)
{
  const auto if_has = [](bool has, double number) { return has ? number : std::numeric_limits<double>::quiet_NaN(); };
  const auto has_points = [&](std::size_t s) { return facts[s].number_of_points > 0; };
  const auto measured = [&](const auto& columns) {
    for(const auto& column : columns)
      f(column.name, [&](std::size_t s) { return if_has(has_points(s), facts[s].*column.number); });
  };
  f("points", [&](std::size_t s) { return facts[s].number_of_points; });
  for(std::size_t k = 0; k < 4; ++k)
    f(std::string(1, "abcd"[k]), [&](std::size_t s) { return shapes.coefficients(s)[k]; });
  for(std::size_t k = 0; k < 3; ++k)
    f(std::string(1, "xyz"[k]), [&](std::size_t s) { return if_has(has_points(s), facts[s].centroid[k]); });
  f("area", [&](std::size_t s) { return if_has(facts[s].area > 0, facts[s].area); });
  measured(size_columns);
  for(const auto& column : plane_columns)
    f(column.name, [&](std::size_t s) { return facts[s].*column.number; });
  measured(fit_columns);
  f("class", [&](std::size_t s) { return CGAL::Tandem::shape_class_name(facts[s].shape_class); });
  if(is_seen)
    f("behind", [&](std::size_t s) { return facts[s].behind; });
  for(const auto& column : uncertainty_columns)
    f(column.name, [&](std::size_t s) { return if_has(has_points(s), shapes.uncertainty(s).*column.number); });
  f("parallel_group", [&](std::size_t s) { return shapes.parallel_group(s); });
  f("coplanar_group", [&](std::size_t s) { return shapes.coplanar_group(s); });
}

} // namespace tandem_examples

#endif // TANDEM_EXAMPLES_SHAPE_COLUMNS_H
