// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the public headers call of the method, which does not depend on kernel and range. The library
// Tandem::tandem_engine has compiled the functions for the back ends of the host.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_ENGINE_API_H
#define CGAL_TANDEM_INTERNAL_ENGINE_ENGINE_API_H

#include <CGAL/Tandem/Plane_relations.h>
#include <CGAL/Tandem/Shapes_data.h>
#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/engine/Detection_engine.h>
#include <CGAL/Tandem/internal/regularity/relations.h>

#include <cstdint>
#include <string>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Besides make_engine():

template <class Backend>
Distance_estimate complete_parameters(Backend& backend, const Import& in, bool has_offset, Parameters& p);

template <class Backend>
std::string set_scale(Backend& backend, Import& in, bool has_offset, Parameters& p);

template <class Backend>
void find_neighbors(Backend& backend, const Grid_point* point, std::uint32_t n, int k, std::uint32_t* neighbor);

template <class Backend>
Shapes_data export_shapes(Backend& backend, const Import& in, const Parameters& parameters,
                          const Engine_result& result);

template <class Backend>
Point_groups group_points(Backend& backend, const std::int32_t* shape_of, std::size_t n, std::size_t shapes);

template <class Backend>
Plane_relations relate_planes(Backend& backend, Import& in, const std::vector<int>& plane_of,
                              Regularity_options options, std::vector<Coefficients>& planes);

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ENGINE_ENGINE_API_H
