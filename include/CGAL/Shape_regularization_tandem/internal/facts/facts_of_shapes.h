// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The facts of shapes, but for their areas, which take most of the time.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_FACTS_FACTS_OF_SHAPES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_FACTS_FACTS_OF_SHAPES_H

#include <CGAL/Shape_regularization_tandem/internal/facts/Shape_measures.h>
#include <CGAL/Shape_regularization_tandem/internal/outlines/for_each_in_parallel.h>
#include <CGAL/Shape_regularization_tandem/internal/outlines/outline_input.h>
#include <CGAL/Shape_regularization_tandem/internal/upward.h>
#include <CGAL/Shape_regularization_tandem/named_parameters.h>
#include <CGAL/Tandem/Shape_facts.h>

#include <array>
#include <cstddef>
#include <utility>
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
  f.centroid = unit.out(outlines::Position{centroid.x, centroid.y, centroid.z});
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

// What the caller gives, checked: in doubles, whatever the kernel is.
struct Input {
  template <class GeomTraits, class PointRange, class NP>
  Input(const Planar_shapes_3<GeomTraits>& given, const PointRange& range, const NP& np)
    : shapes(in_doubles(given)), level(upward_of(given, np)), points(outlines::checked_coordinates(given, range, np))
  {}

  outlines::Shapes shapes;
  Level_frame level;
  std::vector<outlines::Kernel::Point_3> points;

private:
  template <class GeomTraits>
  static outlines::Shapes in_doubles(const Planar_shapes_3<GeomTraits>& given)
  {
    Shapes_data data = given.data();
    data.points = given.point_groups();
    return outlines::Shapes(std::move(data));
  }

  template <class GeomTraits, class NP>
  static Vector upward_of(const Planar_shapes_3<GeomTraits>& given, const NP& np)
  {
    const std::array<double, 3>& axis = given.parameters().symmetry_direction;
    const auto up =
      upward(parameter<internal_np::symmetry_direction_t>(np, outlines::Kernel::Vector_3(axis[0], axis[1], axis[2])));
    return {up.x(), up.y(), up.z()};
  }
};

inline std::vector<Shape_facts> facts_of_all(const Input& input)
{
  const outlines::Unit unit(input.points, input.shapes);
  std::vector<Shape_facts> facts(input.shapes.number_of_shapes());
  outlines::for_each_in_parallel(facts.size(), [&](std::size_t s) {
    const Coefficients& c = input.shapes.coefficients(s);
    const Vector normal = {c[0], c[1], c[2]};
    facts[s] = facts_of_plane(input.shapes.is_flipped(s) ? -normal : normal, input.level);
    facts[s].number_of_points = input.shapes.size(s);
    if(input.shapes.size(s) > 0) // not of a known plane
      add_facts_of_points(Shape_measures(input.points, input.shapes, unit, s), unit, input.level, facts[s]);
  });
  return facts;
}

} // namespace facts
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_FACTS_FACTS_OF_SHAPES_H
