// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The columns of tables of shapes, so that those of the program and of the Python module have the same names.

#ifndef CGAL_TANDEM_SHAPE_COLUMNS_H
#define CGAL_TANDEM_SHAPE_COLUMNS_H

#include <CGAL/Tandem/Plane_uncertainty.h>
#include <CGAL/Tandem/Shape_facts.h>

#include <array>

namespace CGAL::Tandem {

template <class Row>
struct Shape_column {
  const char* name;
  double Row::*number;
};

constexpr std::array<Shape_column<Shape_facts>, 12> fact_columns = {{{"area", &Shape_facts::area},
                                                                     {"length", &Shape_facts::length},
                                                                     {"width", &Shape_facts::width},
                                                                     {"lowest", &Shape_facts::lowest},
                                                                     {"highest", &Shape_facts::highest},
                                                                     {"tilt_deg", &Shape_facts::tilt_deg},
                                                                     {"dip_deg", &Shape_facts::dip_deg},
                                                                     {"azimuth_deg", &Shape_facts::azimuth_deg},
                                                                     {"rms_distance", &Shape_facts::rms_distance},
                                                                     {"mean_distance", &Shape_facts::mean_distance},
                                                                     {"turned_deg", &Shape_facts::turned_deg},
                                                                     {"shifted", &Shape_facts::shifted}}};

constexpr std::array<Shape_column<Plane_uncertainty>, 3> uncertainty_columns = {
  {{"noise", &Plane_uncertainty::noise},
   {"offset_deviation", &Plane_uncertainty::offset_deviation},
   {"angle_deviation_deg", &Plane_uncertainty::angle_deg}}};

} // namespace CGAL::Tandem

#endif // CGAL_TANDEM_SHAPE_COLUMNS_H
