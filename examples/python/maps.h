// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The clouds of Python as ranges with property maps.

#ifndef TANDEM_PYTHON_MAPS_H
#define TANDEM_PYTHON_MAPS_H

#include "detection.h"

#include <CGAL/Shape_regularization_tandem/named_parameters.h>

#include <CGAL/Iterator_range.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>
#include <boost/iterator/counting_iterator.hpp>

#include <cstddef>

namespace tandem_python {

namespace np = CGAL::Tandem::parameters;
using Kernel = CGAL::Simple_cartesian<double>;

// The points of a cloud are the numbers of its rows ...
using Row = boost::counting_iterator<std::size_t>;
using Rows = CGAL::Iterator_range<Row>;

inline Rows rows_of(const Cloud& cloud) { return Rows(Row(0), Row(cloud.size)); }

// ... and this property map makes points or vectors of them.
template <class Geometry>
struct Row_map {
  using key_type = std::size_t;
  using value_type = Geometry;
  using reference = value_type;
  using category = boost::readable_property_map_tag;

  const double* values;

  friend value_type get(const Row_map& map, std::size_t i)
  {
    const double* v = map.values + 3 * i;
    return value_type(v[0], v[1], v[2]);
  }
};
using Point_map = Row_map<Kernel::Point_3>;
using Normal_map = Row_map<Kernel::Vector_3>;

// Calls f with the named parameters for the maps of the points and normals of the cloud ...
template <class F>
auto with_maps(const Cloud& cloud, const F& f)
{
  const auto points = np::point_map(Point_map{cloud.points});
  return cloud.normals != nullptr ? f(points.normal_map(Normal_map{cloud.normals})) : f(points);
}

// ... and with that of tolerances.
template <class F>
auto with_all_maps(const Cloud& cloud, const F& f)
{
  return with_maps(cloud, [&](const auto& maps) {
    return cloud.tolerances != nullptr ? f(maps.maximum_distance_map(CGAL::make_property_map(cloud.tolerances)))
                                       : f(maps);
  });
}

} // namespace tandem_python

#endif // TANDEM_PYTHON_MAPS_H
