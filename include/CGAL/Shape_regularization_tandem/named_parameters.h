// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Named parameters that chain in any order, in the spelling of CGAL's. Those that
// CGAL has are CGAL's own, so np of `CGAL::parameters` are accepted wherever ours
// are; the others have tags of this package. Added to CGAL are only names that
// later versions of CGAL have: programs with them compile with older ones, too.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_NAMED_PARAMETERS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_NAMED_PARAMETERS_H

#include <CGAL/Named_function_parameters.h>
#include <CGAL/version.h>

#include <type_traits>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal_np {

using CGAL::internal_np::callback_t;
using CGAL::internal_np::geom_traits_t;
using CGAL::internal_np::maximum_angle_t;
using CGAL::internal_np::maximum_offset_t;
using CGAL::internal_np::normal_t;
using CGAL::internal_np::plane_index_t;
using CGAL::internal_np::plane_t;
using CGAL::internal_np::point_t;
using CGAL::internal_np::regularize_axis_symmetry_t;
using CGAL::internal_np::regularize_coplanarity_t;
using CGAL::internal_np::regularize_orthogonality_t;
using CGAL::internal_np::regularize_parallelism_t;
using CGAL::internal_np::symmetry_direction_t;

// CGAL has these from 5.6 on ...
#if CGAL_VERSION_NR >= 1050600900
using CGAL::internal_np::k_neighbors_t;
using CGAL::internal_np::maximum_distance_t;
using CGAL::internal_np::minimum_region_size_t;
#else
enum k_neighbors_t { k_neighbors };
enum maximum_distance_t { maximum_distance };
enum minimum_region_size_t { minimum_region_size };
#endif

// ... and this from 6.0 on.
#if CGAL_VERSION_NR >= 1060000900
using CGAL::internal_np::angle_tolerance_t;
#else
enum angle_tolerance_t { angle_tolerance };
#endif

enum base_height_t { base_height };
enum cell_size_t { cell_size };
enum communicator_t { communicator };
enum fixed_directions_t { fixed_directions };
enum footprints_t { footprints };
enum largest_t { largest };
enum maximum_distance_map_t { maximum_distance_map };
enum maximum_number_of_components_t { maximum_number_of_components };
enum maximum_number_of_planes_t { maximum_number_of_planes };
enum minimum_area_t { minimum_area };
enum minimum_extent_t { minimum_extent };
enum near_angle_t { near_angle };
enum near_direction_t { near_direction };
enum one_for_each_plane_t { one_for_each_plane };
enum orthogonal_direction_t { orthogonal_direction };
enum reach_t { reach };
enum regularity_t { regularity };
enum settings_t { settings };
enum shape_points_t { shape_points };
enum simplicity_t { simplicity };
enum surfel_size_t { surfel_size };
enum viewpoint_map_t { viewpoint_map };

} // namespace internal_np

// X(name of the parameter, tag)
#define CGAL_TANDEM_NAMED_PARAMETERS(X)                                                                                \
  X(point_map, point_t)                                                                                                \
  X(normal_map, normal_t)                                                                                              \
  X(plane_map, plane_t)                                                                                                \
  X(plane_index_map, plane_index_t)                                                                                    \
  X(geom_traits, geom_traits_t)                                                                                        \
  X(callback, callback_t)                                                                                              \
  X(maximum_distance, maximum_distance_t)                                                                              \
  X(maximum_distance_map, maximum_distance_map_t)                                                                      \
  X(maximum_angle, maximum_angle_t)                                                                                    \
  X(angle_tolerance, angle_tolerance_t)                                                                                \
  X(maximum_offset, maximum_offset_t)                                                                                  \
  X(minimum_region_size, minimum_region_size_t)                                                                        \
  X(simplicity, simplicity_t)                                                                                          \
  X(regularity, regularity_t)                                                                                          \
  X(surfel_size, surfel_size_t)                                                                                        \
  X(k_neighbors, k_neighbors_t)                                                                                        \
  X(cell_size, cell_size_t)                                                                                            \
  X(communicator, communicator_t)                                                                                      \
  X(settings, settings_t)                                                                                              \
  X(regularize_parallelism, regularize_parallelism_t)                                                                  \
  X(regularize_orthogonality, regularize_orthogonality_t)                                                              \
  X(regularize_coplanarity, regularize_coplanarity_t)                                                                  \
  X(regularize_axis_symmetry, regularize_axis_symmetry_t)                                                              \
  X(symmetry_direction, symmetry_direction_t)                                                                          \
  X(fixed_directions, fixed_directions_t)                                                                              \
  X(one_for_each_plane, one_for_each_plane_t)                                                                          \
  X(maximum_number_of_components, maximum_number_of_components_t)                                                      \
  X(maximum_number_of_planes, maximum_number_of_planes_t)                                                              \
  X(base_height, base_height_t)                                                                                        \
  X(footprints, footprints_t)                                                                                          \
  X(largest, largest_t)                                                                                                \
  X(minimum_area, minimum_area_t)                                                                                      \
  X(minimum_extent, minimum_extent_t)                                                                                  \
  X(near_direction, near_direction_t)                                                                                  \
  X(orthogonal_direction, orthogonal_direction_t)                                                                      \
  X(near_angle, near_angle_t)                                                                                          \
  X(shape_points, shape_points_t)                                                                                      \
  X(reach, reach_t)                                                                                                    \
  X(viewpoint_map, viewpoint_map_t)

/*!
\ingroup PkgShapeRegularizationTandemRef

A list of named parameters which grows by its members, in any order:
`CGAL::Tandem::parameters::maximum_distance(.05).point_map(pm).cell_size(4096)`.
*/
template <typename T, typename Tag, typename Base = CGAL::internal_np::No_property>
struct Named_parameters : CGAL::Named_function_parameters<T, Tag, Base> {
  /// \cond SKIP_IN_MANUAL
  using Cgal_parameters = CGAL::Named_function_parameters<T, Tag, Base>;
  using Cgal_parameters::Cgal_parameters;
  /// \endcond

#define CGAL_TANDEM_MEMBER(name, tag)                                                                                  \
  template <typename V>                                                                                                \
  Named_parameters<V, internal_np::tag, Cgal_parameters> name(const V& value) const                                    \
  {                                                                                                                    \
    return Named_parameters<V, internal_np::tag, Cgal_parameters>(value, *this);                                       \
  }
  CGAL_TANDEM_NAMED_PARAMETERS(CGAL_TANDEM_MEMBER)
#undef CGAL_TANDEM_MEMBER
};

namespace parameters {

#define CGAL_TANDEM_FUNCTION(name, tag)                                                                                \
  template <typename V>                                                                                                \
  Named_parameters<V, internal_np::tag> name(const V& value)                                                           \
  {                                                                                                                    \
    return Named_parameters<V, internal_np::tag>(value);                                                               \
  }
CGAL_TANDEM_NAMED_PARAMETERS(CGAL_TANDEM_FUNCTION)
#undef CGAL_TANDEM_FUNCTION

} // namespace parameters

#undef CGAL_TANDEM_NAMED_PARAMETERS

namespace internal {

// A list of ours has several bases of CGAL's type (each list is a base of the
// next), so the one to read from has to be picked by hand.
template <typename T, typename Tag, typename Base>
const CGAL::Named_function_parameters<T, Tag, Base>&
cgal_parameters(const CGAL::Named_function_parameters<T, Tag, Base>& np)
{
  return np;
}

template <typename T, typename Tag, typename Base>
const CGAL::Named_function_parameters<T, Tag, Base>& cgal_parameters(const Named_parameters<T, Tag, Base>& np)
{
  return np;
}

template <typename NP, typename = void>
struct Is_list : std::false_type {};

template <typename NP>
struct Is_list<NP, std::void_t<decltype(cgal_parameters(std::declval<const NP&>()))>> : std::true_type {};

// One compile-time error where the type is no list. All else is as if nothing was given then.
template <typename NP>
struct List_check {
  static constexpr bool value = Is_list<NP>::value;
  static_assert(value, "This is no list of named parameters: pass CGAL::Tandem::parameters::maximum_distance(0.05) or "
                       "others, and point_map(map) in the same list; a struct Parameters is passed as "
                       "CGAL::Tandem::parameters::settings(p).");
};

template <typename Tag, typename NP, typename Default_type, bool is_list = Is_list<NP>::value>
struct Lookup : CGAL::internal_np::Lookup_named_param_def<Tag, NP, Default_type> {};

template <typename Tag, typename NP, typename Default_type>
struct Lookup<Tag, NP, Default_type, false> {
  using type = Default_type;
};

// The type of a parameter, or Default_type where it is not given.
template <typename Tag, typename NP, typename Default_type>
using Parameter_type = typename Lookup<Tag, NP, Default_type>::type;

template <typename Tag, typename NP>
using Is_given = std::integral_constant<bool, !std::is_same<Parameter_type<Tag, NP, CGAL::internal_np::Param_not_found>,
                                                            CGAL::internal_np::Param_not_found>::value>;

// The value of a parameter, or `otherwise`.
template <typename Tag, typename NP, typename D>
Parameter_type<Tag, NP, D> parameter(const NP& np, const D& otherwise)
{
  if constexpr(Is_given<Tag, NP>::value)
    return CGAL::parameters::get_parameter(cgal_parameters(np), Tag());
  else
    return otherwise;
}

} // namespace internal

namespace parameters {

/// \cond SKIP_IN_MANUAL
template <typename NP>
const NP& combine(const NP& np)
{
  return np;
}
/// \endcond

/*!
\ingroup PkgShapeRegularizationTandemRef

returns a list with the parameters of all given lists, such as
`combine(CGAL::parameters::point_map(pm).normal_map(nm), maximum_distance(.05), cell_size(4096))`.

\param np a list of any length, of `CGAL::parameters` or of `CGAL::Tandem::parameters`
\param one, others lists of one parameter each; longer ones do not compile. If a parameter is given twice, the last one
counts.
*/
template <typename NP, typename T, typename Tag, typename... Others>
auto combine(const NP& np, const CGAL::Named_function_parameters<T, Tag>& one, const Others&... others)
{
  const auto& list = internal::cgal_parameters(np);
  using List = typename std::decay<decltype(list)>::type;
  return combine(Named_parameters<T, Tag, List>(one.v, list), others...);
}

} // namespace parameters
} // namespace Tandem

/// \cond SKIP_IN_MANUAL
namespace parameters {

#if CGAL_VERSION_NR < 1050600900
using CGAL::Tandem::parameters::k_neighbors;
using CGAL::Tandem::parameters::maximum_distance;
using CGAL::Tandem::parameters::minimum_region_size;
#endif
#if CGAL_VERSION_NR < 1060000900
using CGAL::Tandem::parameters::angle_tolerance;
#endif

} // namespace parameters
/// \endcond
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_NAMED_PARAMETERS_H
