// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The property maps and traits for a range: maps of the named parameters if given, otherwise those that the range has.
// Reads nothing of the points itself.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RANGE_MAPS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RANGE_MAPS_H

#include <CGAL/Shape_regularization_tandem/Tandem_traits_3.h>
#include <CGAL/Shape_regularization_tandem/internal/range_checks.h>
#include <CGAL/Shape_regularization_tandem/named_parameters.h>
#include <CGAL/Tandem/internal/cloud/import_cloud.h>

#include <CGAL/property_map.h>

#include <type_traits>

namespace CGAL {

template <typename Point, typename Vector>
class Point_set_3;

namespace Tandem {
namespace internal {

// The maps that a range has by itself. A plain range has its values as points, and no normals.
template <class PointRange>
struct Own_maps {
  using Point_map = CGAL::Identity_property_map<Item_of<PointRange>>;
  using Normal_map = CGAL::Default;
  static constexpr bool may_have_normals = false;

  static Point_map point_map(const PointRange&) { return Point_map(); }
  static Normal_map normal_map(const PointRange&) { return Normal_map(); }
  static bool has_normals(const PointRange&) { return false; }
};

// Whether a point set has normals is known at run time only. So `may_have_normals` is for the compiler, has_normals()
// for the call.
template <class Point, class Vector>
struct Own_maps<CGAL::Point_set_3<Point, Vector>> {
  using Point_set = CGAL::Point_set_3<Point, Vector>;
  using Point_map = typename Point_set::Point_map;
  using Normal_map = typename Point_set::Vector_map;
  static constexpr bool may_have_normals = true;

  static Point_map point_map(const Point_set& points) { return points.point_map(); }
  static Normal_map normal_map(const Point_set& points) { return points.normal_map(); }
  static bool has_normals(const Point_set& points) { return points.has_normal_map(); }
};

// The traits for a range and named parameters. Where use_own_normals is false, only a normal map of the named
// parameters counts. The kernel is that of the points, unless one is given. Check is for functions that read points only.
template <class ConcurrencyTag, class PointRange, class NP, bool use_own_normals>
struct Traits_for {
  using Own = Own_maps<PointRange>;
  using Point_map = Parameter_type<internal_np::point_t, NP, typename Own::Point_map>;
  using Own_normal_map = typename std::conditional<use_own_normals, typename Own::Normal_map, CGAL::Default>::type;
  using Normal_map = Parameter_type<internal_np::normal_t, NP, Own_normal_map>;
  using Kernel =
    Parameter_type<internal_np::geom_traits_t, NP, typename Kernel_of<typename Map_value<Point_map>::type>::type>;
  using Check = std::conjunction<List_check<NP>, Point_check<Kernel, PointRange, Point_map>>;
  using type = Tandem_traits_3<Kernel, PointRange, Point_map, Normal_map, ConcurrencyTag>;
};

// The map of the range where it is of the type that the traits name, otherwise a default-constructed one.
template <class Map, class Own_map>
Map map_or_default(const Own_map& map)
{
  if constexpr(std::is_convertible<Own_map, Map>::value)
    return map;
  else
    return Map();
}

// The map of the named parameters, else that of the range.
template <class Traits, class NP>
typename Traits::Point_map point_map_of(const typename Traits::Point_range& points, const NP& np)
{
  if constexpr(Is_given<internal_np::point_t, NP>::value)
    return parameter<internal_np::point_t>(np, 0);
  else
    return map_or_default<typename Traits::Point_map>(Own_maps<typename Traits::Point_range>::point_map(points));
}

// The same for normals; CGAL::Default where the traits have none.
template <class Traits, class NP>
typename Traits::Normal_map normal_map_of(const typename Traits::Point_range& points, const NP& np)
{
  if constexpr(Is_given<internal_np::normal_t, NP>::value)
    return parameter<internal_np::normal_t>(np, 0);
  else if constexpr(Traits::has_normal_map)
    return map_or_default<typename Traits::Normal_map>(Own_maps<typename Traits::Point_range>::normal_map(points));
  else
    return CGAL::Default();
}

// Reads the items of the range through its maps: see cloud/import_cloud.h.
template <class Traits, class NP>
Item_reader<Traits> reader_of(const typename Traits::Point_range& points, const NP& np, const Traits& traits)
{
  typename Item_reader<Traits>::Tolerance_of tolerance_of;
  if constexpr(Is_given<internal_np::maximum_distance_map_t, NP>::value)
    tolerance_of = [&points, map = parameter<internal_np::maximum_distance_map_t>(np, 0)](std::size_t i) {
      return CGAL::to_double(get(map, *(points.begin() + std::ptrdiff_t(i))));
    };
  return Item_reader<Traits>(traits, point_map_of<Traits>(points, np), normal_map_of<Traits>(points, np), tolerance_of);
}

// Whether the items can be read; the first check that fails is the only error.
template <class Traits, class NP, class Range = typename Traits::Point_range,
          class Kernel = typename Traits::Geom_traits>
using Is_readable = std::conjunction<
  List_check<NP>, Range_check<Range>, Point_check<Kernel, Range, typename Traits::Point_map>,
  Normal_check<Kernel, Range, typename Traits::Normal_map>,
  Same_map_check<Parameter_type<internal_np::point_t, NP, typename Traits::Point_map>, typename Traits::Point_map>,
  Same_map_check<Parameter_type<internal_np::normal_t, NP, typename Traits::Normal_map>, typename Traits::Normal_map>,
  Tolerance_check<Range, Parameter_type<internal_np::maximum_distance_map_t, NP,
                                        CGAL::Constant_property_map<Item_of<Range>, double>>>>;

// Reads the range; nothing where it does not compile.
template <class Upload = No_upload, class Backend, class Traits, class NP>
Import read_range(Backend& backend, const typename Traits::Point_range& points, const NP& np, const Traits& traits)
{
  if constexpr(Is_readable<Traits, NP>::value)
    return read_points(backend, points, reader_of(points, np, traits), Upload());
  else
    return Import();
}

// The traits of that geometry and, where processes work together, of the communicator of the named parameters.
template <class Traits, class NP>
Traits make_traits(const typename Traits::Geom_traits& geom_traits, const NP& np)
{
  if constexpr(Is_given<internal_np::communicator_t, NP>::value)
    return Traits(geom_traits, parameter<internal_np::communicator_t>(np, 0));
  else
    return Traits(geom_traits);
}

// The same for the default geometry.
template <class Traits, class NP>
Traits make_traits(const NP& np)
{
  if constexpr(Is_given<internal_np::communicator_t, NP>::value)
    return Traits(typename Traits::Geom_traits(), parameter<internal_np::communicator_t>(np, 0));
  else
    return Traits();
}

// Calls f(traits) with the traits that fit the range as it is at run time. f is compiled twice for a point set: with
// and without its normals.
template <class ConcurrencyTag, class PointRange, class NP, class F>
auto with_traits(const PointRange& points, const NP& np, F f)
{
  using Plain = Traits_for<ConcurrencyTag, PointRange, NP, false>;
  using Traits = typename Plain::type;
  const auto kernel = parameter<internal_np::geom_traits_t>(np, typename Plain::Kernel());
  using Own = Own_maps<PointRange>;
  if constexpr(Is_readable<Traits, NP>::value && Own::may_have_normals && !Is_given<internal_np::normal_t, NP>::value)
    if(Own::has_normals(points))
      return f(make_traits<typename Traits_for<ConcurrencyTag, PointRange, NP, true>::type>(kernel, np));
  return f(make_traits<Traits>(kernel, np));
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RANGE_MAPS_H
