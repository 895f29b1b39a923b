// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the public headers call of the models: tables of numbers, whatever the kernel of the caller is. The library
// Tandem::tandem_models has compiled the functions; without it, they are compiled where they are called.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_MODELS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_MODELS_H

#include <CGAL/Shape_regularization_tandem/models/Line_table.h>
#include <CGAL/Shape_regularization_tandem/models/Model_progress.h>
#include <CGAL/Shape_regularization_tandem/models/Polygon_table.h>
#include <CGAL/Shape_regularization_tandem/models/Shape_facts.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>
#include <CGAL/Tandem/internal/result/Shapes_data.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#ifdef CGAL_TANDEM_USE_MODELS
#define CGAL_TANDEM_MODELS_INLINE
#else
#define CGAL_TANDEM_MODELS_INLINE inline
#endif

namespace CGAL::Tandem::internal {

namespace outlines {

// The outlines of shapes, with empty entries for those that have no points.
CGAL_TANDEM_MODELS_INLINE Polygon_table outline_table(const std::vector<Position>& points, const Shapes_data& data,
                                                      const Model_progress& progress = Model_progress());

// The lines at which the shapes meet whose outlines these are.
CGAL_TANDEM_MODELS_INLINE Line_table line_table(const Polygon_table& outlines, const Shapes_data& data);

} // namespace outlines

namespace surface {

using Flat_polygon = std::vector<CGAL::Exact_predicates_inexact_constructions_kernel::Point_2>;

// See Closed_surface_3.
struct Surface_table {
  std::vector<Position> points;
  std::vector<std::vector<std::size_t>> faces;
  std::vector<int> plane_of_face;
  std::vector<double> supported_of_face;
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<std::size_t> face_of_triangle;
  std::vector<int> groups; // coplanar ones, whose planes were considered; ascending
  double area = 0, supported_area = 0;
  std::vector<int> omitted_groups; // others, of planes with fewer points
  std::size_t number_of_points = 0;
};

// What closed_surface() is asked for.
struct Surface_request {
  std::size_t most_planes, most_components;
  internal::Vector up; // of length 1
  std::optional<double> base_height;
  std::vector<std::vector<Flat_polygon>> footprints; // of each its outer boundary and its holes
  const outlines::Polygon_table* outlines = nullptr; // of the shapes, if they are known
  Callback callback = Callback();
};

CGAL_TANDEM_MODELS_INLINE Surface_table surface_table(const std::vector<Position>& points, const Shapes_data& data,
                                                      const Surface_request& request);

} // namespace surface

namespace facts {

// From where points were seen; empty if that is not known of any.
struct Stations {
  std::vector<Position> places; // not finite: not known
  std::vector<std::uint32_t> of_point;
};

// Whether shapes are veils.
CGAL_TANDEM_MODELS_INLINE std::vector<char> veil_table(const std::vector<Position>& points, const Shapes_data& data,
                                                       const Stations& stations);

// The facts of shapes. Most of the time is spent in outline_table(), for their areas.
CGAL_TANDEM_MODELS_INLINE std::vector<Shape_facts> facts_table(const std::vector<Position>& points,
                                                               const Shapes_data& data, const Vector& up,
                                                               const outlines::Polygon_table& areas,
                                                               const Stations& stations = {});

} // namespace facts

} // namespace CGAL::Tandem::internal

#ifndef CGAL_TANDEM_USE_MODELS
#include <CGAL/Shape_regularization_tandem/models/facts/facts_table.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/line_table.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/outline_table.h>
#include <CGAL/Shape_regularization_tandem/models/surface/surface_table.h>
#endif

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_MODELS_H
