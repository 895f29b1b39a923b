// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_REGULARIZE_PLANES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_REGULARIZE_PLANES_H

#include <CGAL/Shape_regularization_tandem/internal/method.h>
#include <CGAL/Shape_regularization_tandem/internal/range_maps.h>
#include <CGAL/Shape_regularization_tandem/internal/resolve_parameters.h>
#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/Plane_relations.h>
#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/cloud/import_cloud.h>
#include <CGAL/Tandem/internal/regularity/given_directions.h>

#include <vector>

namespace CGAL::Tandem {

namespace internal {

inline void check_plane_parameters(const Parameters& p, bool has_distance)
{
  if(!(p.maximum_angle >= 0 && p.maximum_angle < 45))
    throw_out_of_range("maximum_angle", p.maximum_angle, "[0, 45) degrees");
  check_length("maximum_offset", p.maximum_offset, 0);
  if(has_distance)
    check_length("maximum_distance", p.maximum_distance, smallest_length);
  check_weight("regularity", p.regularity, largest_regularity);
  check_directions(p);
}

// The plane of each imported point.
template <class IndexMap>
std::vector<int> read_plane_indices(const Import& in, const IndexMap& index_map, std::size_t planes)
{
  std::vector<int> plane_of(in.size());
  for(std::size_t i = 0; i < in.size(); ++i) {
    plane_of[i] = int(get(index_map, in.item_of(i)));
    if(plane_of[i] >= 0 && std::size_t(plane_of[i]) >= planes)
      throw_out_of_range("plane_index_map", plane_of[i], "-1 or an index of a plane, below " + to_text(planes));
  }
  return plane_of;
}

// By parallel group, whether it is orthogonal to another, has a fixed direction, or is symmetric with another.
inline std::vector<char> find_related_groups(const Plane_relations& r)
{
  std::vector<char> is_related;
  for(int fixed : r.fixed_direction)
    is_related.push_back(fixed >= 0);
  for(const auto& pair : r.orthogonal_groups)
    is_related[std::size_t(pair.first)] = is_related[std::size_t(pair.second)] = 1;
  std::vector<int> size(r.symmetry_group.size(), 0);
  for(int number : r.symmetry_group)
    if(number >= 0)
      ++size[std::size_t(number)];
  for(std::size_t g = 0; g < is_related.size(); ++g)
    is_related[g] |= r.symmetry_group[g] >= 0 && size[std::size_t(r.symmetry_group[g])] > 1;
  return is_related;
}

// A plane that has been in its relations before, and was not changed, has a unit normal all the same.
inline void change_to_unit_normals(const std::vector<Coefficients>& given, Plane_relations& r)
{
  const std::vector<char> is_related = find_related_groups(r);
  for(std::size_t s = 0; s < given.size(); ++s) {
    const Vector n = {given[s][0], given[s][1], given[s][2]};
    const bool is_unit = std::fabs(dot(n, n) - 1) <= 1e-15;
    if(is_related[std::size_t(r.parallel_group[s])] && !is_unit)
      r.is_changed[s] = true;
  }
}

// Points of no plane must not stretch the grid.
inline void drop_unassigned(Import& in, std::vector<int>& plane_of)
{
  std::size_t kept = 0;
  in.box = Coordinate_box();
  for(std::size_t i = 0; i < in.size(); ++i) {
    if(plane_of[i] < 0)
      continue;
    in.box.add(in.position(i));
    in.coordinates.move(i, kept);
    plane_of[kept++] = plane_of[i];
  }
  in.count = kept;
  plane_of.resize(kept);
  in.item.clear();
}

// One compile-time error where a map does not fit, as those of internal/range_maps.h.
template <class Kernel, class Plane_iterator, class NP>
struct Planes_check {
  using Item = typename std::iterator_traits<Plane_iterator>::reference;
  using Plane_map = Parameter_type<internal_np::plane_t, NP, CGAL::Identity_property_map<std::decay_t<Item>>>;
  using Index_map = Parameter_type<internal_np::plane_index_t, NP, No_value>;
  static constexpr bool has_indices = Is_given<internal_np::plane_index_t, NP>::value;
  static constexpr bool are_planes =
    std::is_convertible<typename Got<Plane_map, Item>::type, typename Kernel::Plane_3>::value;
  static constexpr bool are_indices = std::is_constructible<int, typename Got<Index_map, std::size_t>::type>::value;
  static constexpr bool value = has_indices && are_planes && are_indices;
  static_assert(has_indices, "regularize_planes() needs the named parameter plane_index_map.");
  static_assert(
    !has_indices || are_planes,
    "The items of the range of planes are not planes of the kernel of the points, nor does plane_map make them "
    "so: pass plane_map(map), where map is a property map from an item of the range to Plane_3.");
  static_assert(
    !has_indices || !are_planes || are_indices,
    "plane_index_map does not give an int for the position of a point: pass plane_index_map(map), where map is "
    "a property map from std::size_t to int.");
};

// regularize_planes() for arguments that are right.
template <class PlaneRange, class PointRange, class NamedParameters>
Plane_relations regularize_given_planes(PlaneRange& planes, const PointRange& points, const NamedParameters& np)
{
  using Maps = Traits_for<CGAL::Sequential_tag, PointRange, NamedParameters, false>;
  using Kernel = typename Maps::Kernel;
  using Plane_item = typename std::iterator_traits<decltype(planes.begin())>::value_type;
  using RT = typename Kernel::RT;
  const Round_to_nearest rounding;
  Parameters p;
  p.maximum_offset = 0.01;
  read_real<internal_np::maximum_angle_t>(np, p.maximum_angle);
  read_real<internal_np::maximum_offset_t>(np, p.maximum_offset);
  read_real<internal_np::maximum_distance_t>(np, p.maximum_distance);
  read_real<internal_np::regularity_t>(np, p.regularity);
  read_switch<internal_np::regularize_parallelism_t>(np, p.regularize_parallelism);
  read_switch<internal_np::regularize_orthogonality_t>(np, p.regularize_orthogonality);
  read_switch<internal_np::regularize_coplanarity_t>(np, p.regularize_coplanarity);
  read_directions(np, p);
  check_plane_parameters(p, Is_given<internal_np::maximum_distance_t, NamedParameters>::value);

  const auto plane_map = parameter<internal_np::plane_t>(np, CGAL::Identity_property_map<Plane_item>());
  std::vector<Coefficients> coefficients;
  for(auto it = planes.begin(); it != planes.end(); ++it) {
    const typename Kernel::Plane_3 s = get(plane_map, *it);
    coefficients.push_back(
      {CGAL::to_double(s.a()), CGAL::to_double(s.b()), CGAL::to_double(s.c()), CGAL::to_double(s.d())});
  }
  Sequential_backend backend;
  Import in = read_positions(backend, points, np);
  auto plane_of = read_plane_indices(in, parameter<internal_np::plane_index_t>(np, 0), coefficients.size());
  drop_unassigned(in, plane_of);
  const std::vector<Coefficients> given = coefficients;
  Plane_relations result = relate_planes(backend, in, plane_of, p, coefficients);
  const std::vector<Vector> directions = group_directions(result.parallel_group, coefficients);
  result.fixed_direction = fixed_directions_of(directions, p);
  result.symmetry_group = symmetry_groups(directions, p);
  change_to_unit_normals(given, result);
  const auto construct = parameter<internal_np::geom_traits_t>(np, Kernel()).construct_plane_3_object();
  std::size_t s = 0;
  for(auto it = planes.begin(); it != planes.end(); ++it, ++s)
    if(result.is_changed[s]) {
      const Coefficients& c = coefficients[s];
      put(plane_map, *it, construct(RT(c[0]), RT(c[1]), RT(c[2]), RT(c[3])));
    }
  return result;
}

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief makes given planes exactly parallel, orthogonal and coplanar where their points allow it.

Takes the named parameters of `CGAL::Shape_regularization::Planes::regularize_planes()`, for planes of efficient RANSAC,
region growing or any other detector. Unlike that function, this one
- makes all orthogonal groups exactly orthogonal: for groups that are reported as orthogonal, the dot product of the
  unit normals is at most 1e-15 in absolute value;
- fits the planes of a group jointly to their points, and makes a relation only where the degrees of freedom that it
  saves are worth more than it costs. The cost is the growth of the sum of squared distances of the points, divided by
  the square of `maximum_distance`. A degree of freedom is worth `regularity` times the sum of two numbers: the points
  of the smallest plane, and a tenth of the points of the largest plane that has this degree of freedom. The direction
  of a plane never costs more than two degrees of freedom, its offset never more than one;
- reports the relations, and how far each plane moved.

Planes keep their orientation. Each plane that is parallel, orthogonal, coplanar or symmetric to another one in the
result, or that has a fixed direction, gets a unit normal, even if it had that relation before. Other planes stay as
they are, with normals of any length. A plane that has no normal, or whose points do not determine a plane, is neither
turned nor moved. Where `regularize_parallelism` is `false`, there are no coplanar groups either. Unlike in the function
of `CGAL::Shape_regularization`, `regularize_axis_symmetry` is off unless it or `symmetry_direction` is given. The
result is independent of the order of the points. Relations are found as in a detection: \ref Tandem_method_directions.
Time is linear in the number of points.

\tparam PlaneRange a range with random access iterators
\tparam PointRange a model of `ConstRange` with random access iterators

\param planes the planes, which are replaced through the plane map
\param points the points
\param np a sequence of named parameters

\cgalNamedParamsBegin
  \cgalParamNBegin{plane_index_map}
    \cgalParamDescription{a property map from the position of a point (`std::size_t`) to the position of its plane
    (`int`), -1 if it has none}
    \cgalParamDefault{there is none: this parameter is mandatory}
  \cgalParamNEnd
  \cgalParamNBegin{plane_map}
    \cgalParamDescription{a model of `ReadWritePropertyMap` from the value type of `PlaneRange` to `Plane_3`}
    \cgalParamDefault{`CGAL::Identity_property_map`}
  \cgalParamNEnd
  \cgalParamNBegin{point_map}
    \cgalParamDescription{a property map from the value type of `PointRange` to `Point_3`}
    \cgalParamDefault{`CGAL::Identity_property_map`}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_angle}
    \cgalParamDescription{the angle within which planes are made parallel or orthogonal, in degrees, in [0, 45). No
    plane is turned farther from the fit of its points.}
    \cgalParamDefault{25}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_offset}
    \cgalParamDescription{the largest distance between parallel planes that are made coplanar, and by which a plane is
    moved from the centroid of its points. `maximum_offset` and
    `maximum_distance` count as four times the extent of the points where they are larger.}
    \cgalParamDefault{0.01}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_distance}
    \cgalParamDescription{the distance that costs are measured by: the larger, the more relations}
    \cgalParamDefault{2.5 times the root mean square distance of the points to the given planes, at least
    `maximum_offset`}
  \cgalParamNEnd
  \cgalParamNBegin{regularity}
    \cgalParamDescription{what a degree of freedom is worth, in numbers of points of the smallest plane, in [0, 10]: the
    larger, the more relations}
    \cgalParamDefault{0.1}
  \cgalParamNEnd
  \cgalParamNBegin{regularize_parallelism, regularize_orthogonality, regularize_coplanarity}
    \cgalParamDescription{which relations are made exact}
    \cgalParamDefault{`true`}
  \cgalParamNEnd
  \cgalParamNBegin{fixed_directions, symmetry_direction, regularize_axis_symmetry}
    \cgalParamDescription{as in `detect_planes()`}
    \cgalParamDefault{there are no such directions}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return how the planes are related

\throw Parameter_error a parameter is outside of its range, or the extent of the points is more than 2^24 times
`maximum_distance`
\throw std::length_error more than 2^31 points
\throw std::range_error the extent of the points is more than 2^24 times 1e270, about 1.7e277
*/
template <class PlaneRange, class PointRange, class NamedParameters>
Plane_relations regularize_planes(PlaneRange&& planes, const PointRange& points, const NamedParameters& np)
{
  using Maps = internal::Traits_for<CGAL::Sequential_tag, PointRange, NamedParameters, false>;
  if constexpr(internal::Range_check<PointRange>::value && Maps::Check::value) {
    if constexpr(internal::Planes_check<typename Maps::Kernel, decltype(planes.begin()), NamedParameters>::value)
      return internal::regularize_given_planes(planes, points, np);
  }
  return Plane_relations();
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_REGULARIZE_PLANES_H
