// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cloud, and what its points may have beside coordinates and normals.

#ifndef DETECT_PLANES_POINT_SET_H
#define DETECT_PLANES_POINT_SET_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Iterator_range.h>
#include <CGAL/Point_set_3.h>

#include <boost/endian/conversion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

namespace program {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_set = CGAL::Point_set_3<Kernel::Point_3>;

// Channels of 8 bits are kept as multiples of 257. LAS files have 16 bits, of which some use 8 only.
using Input_color = std::array<std::uint16_t, 3>;

// The names of the property maps, each with its type.
constexpr const char* color_name = "input_color";             // Input_color
constexpr const char* intensity_name = "intensity";           // float
constexpr const char* classification_name = "classification"; // std::uint8_t
constexpr const char* tolerance_name = "tolerance";           // double: of the distance to the plane
constexpr const char* viewpoint_name = "viewpoint";           // Kernel::Point_3: of the sensor; NaN: not known
constexpr const char* no_value_name = "no_value"; // bool: coordinates stand for no value; there only if some do

// Files have little-endian numbers, on every machine: the bytes of a number as they are there, and back.
template <class T>
T little_endian(T value)
{
  if constexpr(boost::endian::order::native != boost::endian::order::little) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    std::reverse(bytes, bytes + sizeof(T));
    std::memcpy(&value, bytes, sizeof(T));
  }
  return value;
}

template <class T>
std::optional<Point_set::Property_map<T>> find_property(const Point_set& points, const char* name)
{
  if(!points.has_property_map<T>(name))
    return std::nullopt;
#if CGAL_VERSION_NR >= 1060000000
  return *points.property_map<T>(name);
#else
  return points.property_map<T>(name).first;
#endif
}

// Consecutive points of a cloud.
using Point_part = CGAL::Iterator_range<Point_set::const_iterator>;

inline Point_part part_of(const Point_set& points, std::size_t first, std::size_t last)
{
  return {points.begin() + std::ptrdiff_t(first), points.begin() + std::ptrdiff_t(last)};
}

inline bool is_finite(const Kernel::Point_3& p)
{
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

inline bool is_zero(const Kernel::Point_3& p) { return p.x() == 0 && p.y() == 0 && p.z() == 0; }

// Numbers that writers put where they have no value: nines, powers of ten from 1e6 on, and the limits of types.
inline bool is_usual_for_none(double x)
{
  const double size = std::fabs(x), exponent = std::round(std::log10(size));
  if(size < 999)
    return false;
  const bool is_power = size == std::pow(10, exponent), is_below_power = size + 1 == std::pow(10, exponent);
  return is_below_power || (is_power && size >= 1e6) || size >= 1e30 || size == 32767 || size == 32768 ||
         size == 2147483647. || size == 2147483648.;
}

inline bool is_usable_normal(const Kernel::Vector_3& v)
{
  return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z()) && v != CGAL::NULL_VECTOR;
}

} // namespace program

#endif // DETECT_PLANES_POINT_SET_H
