// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The table of the shapes: PlanarShapes.table().

#ifndef TANDEM_PYTHON_TABLE_H
#define TANDEM_PYTHON_TABLE_H

#include "Result.h"

#include <CGAL/Tandem/shape_columns.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace tandem_python {

// number_of(s): of each shape, as a new array.
template <class Number, class F>
py::array_t<Number> array_by_shape(const Result& result, const F& number_of)
{
  py::array_t<Number> array(py::ssize_t(result.size()));
  Number* to = array.mutable_data();
  for(std::size_t s = 0; s < result.size(); ++s)
    *to++ = Number(number_of(s));
  return array;
}

// Other threads of Python run meanwhile. The array of points is the caller's, who may have changed it.
inline std::vector<CGAL::Tandem::Shape_facts> facts_of(const Result& result)
{
  const Cloud cloud = {result.given().points->data(), nullptr, nullptr, result.shapes().labels().size};
  const py::gil_scoped_release no_gil;
  try {
    return shape_facts(cloud, result.shapes());
  } catch(const std::invalid_argument& e) {
    throw std::invalid_argument("points were changed after the detection, and table() measures them. " +
                                std::string(e.what()));
  }
}

// The names are those of the columns of detect_planes --shapes.
inline py::dict table(const Result& result)
{
  const std::vector<CGAL::Tandem::Shape_facts> facts = facts_of(result);
  const double* const planes = result.shapes().planes().data;
  const CGAL::Tandem::Plane_uncertainty* const uncertainties = result.shapes().uncertainties().data;
  py::dict dict;
  const auto add = [&](const std::string& name, const auto& number_of) {
    dict[py::str(name)] = array_by_shape<double>(result, number_of);
  };
  const auto add_count = [&](const char* name, const auto& number_of) {
    dict[name] = array_by_shape<std::int64_t>(result, number_of);
  };
  add_count("shape", [](std::size_t s) { return s; });
  add_count("points", [&](std::size_t s) { return facts[s].number_of_points; });
  for(std::size_t k = 0; k < 4; ++k)
    add(std::string(1, "abcd"[k]), [&](std::size_t s) { return planes[4 * s + k]; });
  for(std::size_t k = 0; k < 3; ++k)
    add(std::string(1, "xyz"[k]), [&](std::size_t s) { return facts[s].centroid[k]; });
  for(const auto& column : CGAL::Tandem::fact_columns)
    add(column.name, [&](std::size_t s) { return facts[s].*column.number; });
  for(const auto& column : CGAL::Tandem::uncertainty_columns)
    add(column.name, [&](std::size_t s) { return uncertainties[s].*column.number; });
  add_count("parallel_group", [&](std::size_t s) { return result.shapes().parallel_groups().data[s]; });
  add_count("coplanar_group", [&](std::size_t s) { return result.shapes().coplanar_groups().data[s]; });
  return dict;
}

inline void add_table(Class& result)
{
  result.def(
    "table", &table,
    "A dict of new arrays of shape (m,), ready for pandas.DataFrame: a row of each shape, as the program "
    "detect_planes\n"
    "--shapes writes them. Integers are int64, the others float64; lengths are in units of the points.\n\n"
    "shape, points            the shape, and the number of its points\n"
    "a, b, c, d               its plane\n"
    "x, y, z                  the mean of its points\n"
    "area                     what they cover: the area of their outline; 0 where they are too few for one\n"
    "length, width            the sides of the smallest rectangle in the plane around them, the longer one first\n"
    "lowest, highest          of their heights along the upward direction: z, or symmetry_direction\n"
    "tilt_deg                 angle of the normal with that direction, in [0, 180]; of the outward side, as "
    "is_flipped\n"
    "                         tells it, where normals were given\n"
    "dip_deg                  angle of the plane with the level, in [0, 90]\n"
    "azimuth_deg              where it falls most steeply, clockwise from y, in [0, 360); 0 for a level plane\n"
    "rms_distance, mean_distance\n"
    "                         of the points to the plane\n"
    "turned_deg, shifted      how far regularization moved it from the least-squares plane of the points\n"
    "noise, offset_deviation, angle_deviation_deg\n"
    "                         as in uncertainties, where the last one is angle_deg\n"
    "parallel_group, coplanar_group\n\n"
    "The points are read again where detect_planes() has read them: the result keeps that array alive. Raises "
    "ValueError\n"
    "where they were changed since so that one is no longer on its plane; smaller changes are measured as they are.\n"
    "Most of the time, about that of the detection, is for the areas.");
}

} // namespace tandem_python

#endif // TANDEM_PYTHON_TABLE_H
