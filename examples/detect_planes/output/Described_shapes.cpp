// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/writers.h"

#include <CGAL/Shape_regularization_tandem/join_coplanar_shapes.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>
#include <CGAL/Shape_regularization_tandem/select_shapes.h>
#include <CGAL/Shape_regularization_tandem/shape_facts.h>
#include <CGAL/Tandem/shape_columns.h>

namespace program {

Shape_areas areas_of_shapes(const Point_set& points, const Shapes& shapes)
{
  return CGAL::Tandem::polygons(shapes, points);
}

Shapes joined_shapes(const Point_set& points, const Shapes& shapes)
{
  return CGAL::Tandem::join_coplanar_shapes(shapes, points);
}

Json shape_table(const Point_set& points, const Shapes& shapes, const Shape_areas& areas)
{
  const std::vector<CGAL::Tandem::Shape_facts> facts = CGAL::Tandem::shape_facts(shapes, points, areas);
  Json table;
  CGAL::Tandem::for_each_shape_column(shapes, facts, [&](const std::string& name, const auto& number_of) {
    Json& column = table[name] = Json::array();
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      column.push_back(number_of(s));
  });
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

// ---

Shapes selected_shapes(const Shapes& shapes, const Point_set& points, const Options& o)
{
  namespace np = CGAL::Tandem::parameters;
  const std::size_t all = (std::max)(shapes.number_of_shapes(), std::size_t(1));
  const std::size_t number = o.largest ? std::size_t(*o.largest) : all;
  const auto list =
    np::largest(number).minimum_area(o.minimum_area.value_or(0)).minimum_extent(o.minimum_extent.value_or(0));
  if(!o.near_direction)
    return CGAL::Tandem::select_shapes(shapes, points, list);
  const Direction_choice& choice = *o.near_direction;
  const std::array<double, 3>& upward = shapes.parameters().symmetry_direction;
  const std::array<double, 3>& d = choice.of == Direction_choice::direction ? choice.normal : upward;
  const Kernel::Vector_3 direction(d[0], d[1], d[2]);
  const auto near = list.near_angle(choice.degrees.value_or(CGAL::Tandem::internal::default_near_angle));
  return choice.of == Direction_choice::vertical
           ? CGAL::Tandem::select_shapes(shapes, points, near.orthogonal_direction(direction))
           : CGAL::Tandem::select_shapes(shapes, points, near.near_direction(direction));
}

} // namespace program
