// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What functions of a range begin with: its property maps and traits, and the back end. Maps of the named parameters are
// taken if given, otherwise those that the range has.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RANGE_MAPS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RANGE_MAPS_H

#include <CGAL/Shape_regularization_tandem/Tandem_traits_3.h>
#include <CGAL/Shape_regularization_tandem/named_parameters.h>
#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/cloud/import_cloud.h>

#include <CGAL/Default.h>
#include <CGAL/FPU.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/Real_embeddable_traits.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>

#include <iterator>
#include <type_traits>
#include <utility>

namespace CGAL::Tandem::internal {

// --- What is asked of a range and its property maps: one compile-time error that says what to pass. Callers leave out what
// would not compile where a check has failed, so that no other error follows.

struct No_value {};

// The iterators of a range; where it is none, those of nothing.
template <class Range, class = void>
struct Iterator_of {
  using type = const No_value*;
  static constexpr bool is_range = false, is_random_access = false;
};

template <class Range>
struct Iterator_of<Range,
                   std::void_t<typename std::iterator_traits<typename Range::const_iterator>::iterator_category>> {
  using type = typename Range::const_iterator;
  static constexpr bool is_range = true;
  static constexpr bool is_random_access =
    std::is_convertible<typename std::iterator_traits<type>::iterator_category, std::random_access_iterator_tag>::value;
};

template <class Range>
using Item_of = typename std::iterator_traits<typename Iterator_of<Range>::type>::value_type;

// The value type of a property map, No_value where it is none.
template <class Map, class = void>
struct Map_value {
  using type = No_value;
};

template <class Map>
struct Map_value<Map, std::void_t<typename boost::property_traits<Map>::value_type>> {
  using type = typename boost::property_traits<Map>::value_type;
};

// What a map gives for a key, No_value where it has no such keys.
template <class Map, class Key, class = void>
struct Got {
  using type = No_value;
};

template <class Map, class Key>
struct Got<Map, Key, std::void_t<decltype(get(std::declval<const Map&>(), std::declval<const Key&>()))>> {
  using type = decltype(get(std::declval<const Map&>(), std::declval<const Key&>()));
};

// Whether a map gives Value for the items of a range, as they are read.
template <class Map, class Range, class Value>
struct Gives {
  using Item = std::remove_reference_t<typename std::iterator_traits<typename Iterator_of<Range>::type>::reference>;
  static constexpr bool value = !std::is_same<typename Map_value<Map>::type, No_value>::value &&
                                std::is_convertible<typename Got<Map, Item>::type, const Value&>::value;
};

// The kernel of a point. Where T is none: that of its first template argument, as of a pair, or any, so that what is
// named after the kernel compiles in spite of the error.
template <class T>
struct First_argument {
  using type = CGAL::Simple_cartesian<double>::Point_3;
};

template <template <class...> class T, class First, class... Others>
struct First_argument<T<First, Others...>> {
  using type = First;
};

template <class T, class = void>
struct Kernel_of : Kernel_of<typename First_argument<T>::type> {};

template <class T>
struct Kernel_of<T, std::void_t<typename CGAL::Kernel_traits<T>::Kernel::Plane_3>> {
  using type = typename CGAL::Kernel_traits<T>::Kernel;
};

template <class Range>
struct Range_check {
  static constexpr bool value = Iterator_of<Range>::is_random_access;
  static_assert(value,
                "The range of points needs random access iterators: pass a std::vector or a CGAL::Point_set_3, for "
                "example.");
};

template <class Kernel, class Range, class PointMap>
struct Point_check {
  static constexpr bool value = Gives<PointMap, Range, typename Kernel::Point_3>::value;
  static_assert(value || !Iterator_of<Range>::is_range,
                "The items of the range are not points of the kernel, nor does point_map make them so: pass "
                "point_map(map), where map is a property map from an item of the range to Point_3, as "
                "CGAL::First_of_pair_property_map<Item>() is for pairs of a point and a normal.");
};

template <class Kernel, class Range, class NormalMap>
struct Normal_check {
  static constexpr bool value =
    std::is_same<NormalMap, CGAL::Default>::value || Gives<NormalMap, Range, typename Kernel::Vector_3>::value;
  static_assert(value,
                "normal_map does not give a Vector_3 of the kernel of the points for each item of the range: pass "
                "normal_map(map), where map is a property map from an item of the range to Vector_3, as "
                "CGAL::Second_of_pair_property_map<Item>() is for pairs of a point and a normal; or none, and "
                "normals are estimated.");
};

template <class Range, class ToleranceMap>
struct Tolerance_check {
  using Item = typename std::iterator_traits<typename Iterator_of<Range>::type>::reference;
  using Value = std::decay_t<typename Got<ToleranceMap, Item>::type>;
  static constexpr bool value = CGAL::Real_embeddable_traits<Value>::Is_real_embeddable::value;
  static_assert(value, "maximum_distance_map does not give a number for each item of the range: pass "
                       "maximum_distance_map(map), where map is a property map from an item of the range to double.");
};

// The maps of the named parameters and those that the caller's traits name.
template <class Given, class OfTraits>
struct Same_map_check {
  static constexpr bool value = std::is_convertible<Given, OfTraits>::value;
  static_assert(value,
                "point_map or normal_map of the named parameters is not the Point_map or Normal_map of the traits: "
                "name its type in Tandem_traits_3.");
};

} // namespace CGAL::Tandem::internal

namespace CGAL {

template <typename Point, typename Vector>
class Point_set_3;

namespace Tandem::internal {

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

// Reads the points of a range only, also where it has normals; nothing where it does not compile.
template <class Backend, class PointRange, class NP>
Import read_positions(Backend& backend, const PointRange& points, const NP& np)
{
  using Maps = Traits_for<CGAL::Sequential_tag, PointRange, NP, false>;
  using Traits =
    Tandem_traits_3<typename Maps::Kernel, PointRange, typename Maps::Point_map, CGAL::Default, CGAL::Sequential_tag>;
  if constexpr(std::conjunction<Range_check<PointRange>, typename Maps::Check>::value) {
    const Traits traits(parameter<internal_np::geom_traits_t>(np, typename Maps::Kernel()));
    return read_points(backend, points, Item_reader<Traits>(traits, point_map_of<Traits>(points, np), CGAL::Default()));
  } else
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

// While one exists, this thread rounds to the nearest double, on which equal bits depend. Then the caller's rounding
// mode is set again. Threads of the back ends take over the mode of this one.
struct Round_to_nearest {
  CGAL::Protect_FPU_rounding<true> protect = CGAL::Protect_FPU_rounding<true>(CGAL_FE_TONEAREST);
};

// f(backend, traits) on all ranks, with the traits that fit the range.
template <class ConcurrencyTag, class PointRange, class NP, class F>
auto on_backend(const PointRange& points, const NP& np, F f)
{
  const Round_to_nearest rounding;
  return with_traits<ConcurrencyTag>(points, np, [&](const auto& traits) {
    auto backend = traits.backend();
    return Ranks<decltype(backend)>(backend).together([&] { return f(backend, traits); });
  });
}

} // namespace Tandem::internal
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RANGE_MAPS_H
