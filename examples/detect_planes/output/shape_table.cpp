// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/shape_table.h"

#include <CGAL/Shape_regularization_tandem/shape_facts.h>
#include <CGAL/Tandem/shape_columns.h>

#include <cstddef>
#include <string>
#include <vector>

namespace program {

Json shape_table(const Point_set& points, const Shapes& shapes, const Shape_areas& areas)
{
  const std::vector<CGAL::Tandem::Shape_facts> facts = CGAL::Tandem::shape_facts(shapes, points, areas);
  Json table;
  const auto add = [&](const std::string& name, const auto& number_of) {
    Json& column = table[name] = Json::array();
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      column.push_back(number_of(s));
  };
  add("points", [&](std::size_t s) { return facts[s].number_of_points; });
  for(std::size_t k = 0; k < 4; ++k)
    add(std::string(1, "abcd"[k]), [&](std::size_t s) { return shapes.coefficients(s)[k]; });
  for(std::size_t k = 0; k < 3; ++k)
    add(std::string(1, "xyz"[k]), [&](std::size_t s) { return facts[s].centroid[k]; });
  for(const auto& column : CGAL::Tandem::fact_columns)
    add(column.name, [&](std::size_t s) { return facts[s].*column.number; });
  for(const auto& column : CGAL::Tandem::uncertainty_columns)
    add(column.name, [&](std::size_t s) { return shapes.uncertainty(s).*column.number; });
  add("parallel_group", [&](std::size_t s) { return shapes.parallel_group(s); });
  add("coplanar_group", [&](std::size_t s) { return shapes.coplanar_group(s); });
  return table;
}

void write_shape_table(std::ostream& out, const Json& table)
{
  out << "shape";
  for(const auto& column : table.items())
    out << ',' << column.key();
  out << '\n';
  for(std::size_t s = 0; s < table.begin()->size(); ++s) {
    out << s;
    for(const Json& column : table)
      out << ',' << column[s];
    out << '\n';
  }
}

} // namespace program
