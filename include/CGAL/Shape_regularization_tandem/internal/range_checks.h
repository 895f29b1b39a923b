// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is asked of a range and its property maps: one compile-time error that says what to pass. Callers leave out what
// would not compile where a check has failed, so that no other error follows.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RANGE_CHECKS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RANGE_CHECKS_H

#include <CGAL/Default.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/Real_embeddable_traits.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>

#include <iterator>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

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

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RANGE_CHECKS_H
