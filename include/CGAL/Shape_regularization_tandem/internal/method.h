// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What surrounds the engine, for public headers that call it. Programs that link the library Tandem::tandem_engine have
// CGAL_TANDEM_USE_ENGINE defined, and get declarations. Others compile it themselves, as Planar_shape_detection_3.h does
// with the engine.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_METHOD_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_METHOD_H

#include <CGAL/Tandem/internal/cloud/import_cloud.h>
#include <CGAL/Tandem/internal/engine/engine_api.h>
#ifndef CGAL_TANDEM_USE_ENGINE
#include <CGAL/Tandem/internal/engine/complete_parameters.h>
#include <CGAL/Tandem/internal/regularity/relate_planes.h>
#include <CGAL/Tandem/internal/result/export_shapes.h>
#else

namespace CGAL::Tandem::internal {

class Sequential_backend;

extern template Point_groups group_points(Sequential_backend&, const std::int32_t*, std::size_t, std::size_t);
// For the number types of Item_reader.
extern template void start_import<float>(Import&, std::size_t, bool);
extern template void start_import<double>(Import&, std::size_t, bool);
extern template bool inspect_points(const Values<float>&, std::size_t, Coordinate_box&);
extern template bool inspect_points(const Values<double>&, std::size_t, Coordinate_box&);
extern template void drop_invalid<float>(Import&);
extern template void drop_invalid<double>(Import&);

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_USE_ENGINE

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_METHOD_H
