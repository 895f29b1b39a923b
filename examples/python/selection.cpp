// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "detection.h"

#include <CGAL/Shape_regularization_tandem/label_points.h>
#include <CGAL/Shape_regularization_tandem/shape_facts.h>

#include <algorithm>

namespace tandem_python {

Shapes select_shapes(const Shapes& shapes, const std::vector<long long>& indices)
{
  return CGAL::Tandem::select_shapes(shapes, indices);
}

std::vector<CGAL::Tandem::Shape_facts> shape_facts(const Cloud& cloud, const Shapes& shapes)
{
  return with_viewpoints(cloud,
                         [&](const auto& maps) { return CGAL::Tandem::shape_facts(shapes, rows_of(cloud), maps); });
}

// Each direction is a type of named parameters of its own.
Shapes select_shapes(const Shapes& shapes, const Cloud& points, const Selection& s)
{
  const auto select = [&](const auto& list) { return CGAL::Tandem::select_shapes(shapes, rows_of(points), list); };
  const auto vector = [](const std::array<double, 3>& d) { return Kernel::Vector_3(d[0], d[1], d[2]); };
  const std::size_t largest = s.largest.value_or((std::max)(shapes.number_of_shapes(), std::size_t(1)));
  return with_viewpoints(points, [&](const auto& maps) {
    const auto list = maps.largest(largest).near_angle(s.near_angle.value_or(10)); // the default of the library
    if(s.near_direction && s.orthogonal_direction)
      return select(
        list.near_direction(vector(*s.near_direction)).orthogonal_direction(vector(*s.orthogonal_direction)));
    if(s.near_direction)
      return select(list.near_direction(vector(*s.near_direction)));
    if(s.orthogonal_direction)
      return select(list.orthogonal_direction(vector(*s.orthogonal_direction)));
    return select(list);
  });
}

namespace {

// The points of two clouds, the second ones behind the first.
struct Joined_map {
  using key_type = std::size_t;
  using value_type = Kernel::Point_3;
  using reference = value_type;
  using category = boost::readable_property_map_tag;

  Point_map first, second;
  std::size_t size; // of the first

  friend value_type get(const Joined_map& map, std::size_t i)
  {
    return i < map.size ? get(map.first, i) : get(map.second, i - map.size);
  }
};

template <class Maps>
std::vector<std::int32_t> labels_with(const Shapes& shapes, const Cloud& cloud, const Labeling& l, const Maps& maps)
{
  const CGAL::Tandem::Parameters& p = shapes.parameters();
  const auto list = maps.maximum_distance(l.maximum_distance.value_or(p.maximum_distance))
                      .maximum_angle(l.maximum_angle.value_or(p.maximum_angle));
  if(l.shape_points.points == nullptr)
    return CGAL::Tandem::label_points(shapes, rows_of(cloud), list);
  const auto places = list.shape_points(Cloud_rows(Row(cloud.size), Row(cloud.size + l.shape_points.size)));
  return l.reach ? CGAL::Tandem::label_points(shapes, rows_of(cloud), places.reach(*l.reach))
                 : CGAL::Tandem::label_points(shapes, rows_of(cloud), places);
}

} // namespace

std::vector<std::int32_t> label_points(const Shapes& shapes, const Cloud& cloud, const Labeling& l)
{
  const auto points = np::point_map(Joined_map{Point_map{cloud.points}, Point_map{l.shape_points.points}, cloud.size});
  const auto with_tolerances = [&](const auto& maps) {
    return cloud.tolerances != nullptr
             ? labels_with(shapes, cloud, l, maps.maximum_distance_map(CGAL::make_property_map(cloud.tolerances)))
             : labels_with(shapes, cloud, l, maps);
  };
  return cloud.normals != nullptr ? with_tolerances(points.normal_map(Normal_map{cloud.normals}))
                                  : with_tolerances(points);
}

} // namespace tandem_python
