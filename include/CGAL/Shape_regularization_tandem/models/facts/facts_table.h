// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The facts of shapes, but for their areas.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_FACTS_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_FACTS_TABLE_H

#include <CGAL/Shape_regularization_tandem/models/facts/Shape_measures.h>
#include <CGAL/Shape_regularization_tandem/models/for_each_in_parallel.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace facts {

// The normal points to the outward side.
inline Shape_facts facts_of_plane(const Vector& normal, const Level_frame& level)
{
  Shape_facts f;
  const Slope slope = level.slope(normal);
  f.tilt_deg = slope.tilt;
  f.dip_deg = slope.dip;
  f.azimuth_deg = slope.azimuth;
  return f;
}

inline void add_facts_of_points(const Shape_measures& measures, const outlines::Unit& unit, const Level_frame& level,
                                Shape_facts& f)
{
  const Vector centroid = measures.centroid();
  f.centroid = unit.out(Position{centroid.x, centroid.y, centroid.z});
  const Rectangle_sides sides = measures.rectangle();
  f.length = unit.out(sides.length);
  f.width = unit.out(sides.width);
  const std::array<double, 2> heights = measures.heights(level);
  f.lowest = unit.out(heights[0]);
  f.highest = unit.out(heights[1]);
  f.rms_distance = unit.out(measures.rms_distance());
  f.mean_distance = unit.out(measures.mean_distance());
  f.turned_deg = measures.turned_deg();
  f.shifted = unit.out(measures.shifted());
}

CGAL_TANDEM_MODELS_INLINE std::vector<Shape_facts> facts_table(const std::vector<Position>& points,
                                                               const Shapes_data& data, const Vector& up)
{
  const outlines::Shapes shapes(data);
  const outlines::Unit unit(points, shapes);
  const Level_frame level(up);
  std::vector<Shape_facts> facts(shapes.number_of_shapes());
  for_each_in_parallel(facts.size(), [&](std::size_t s) {
    const Coefficients& c = shapes.coefficients(s);
    const Vector normal = {c[0], c[1], c[2]};
    facts[s] = facts_of_plane(shapes.is_flipped(s) ? -normal : normal, level);
    facts[s].number_of_points = shapes.size(s);
    if(shapes.size(s) > 0) // not of a known plane
      add_facts_of_points(Shape_measures(points, shapes, unit, s), unit, level, facts[s]);
  });
  return facts;
}

} // namespace facts
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_FACTS_TABLE_H
