// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/engine/Engine.h>
#include <CGAL/Tandem/internal/engine/complete_parameters.h>
#include <CGAL/Tandem/internal/engine/engine_api.h>
#include <CGAL/Tandem/internal/regularity/relate_planes.h>
#include <CGAL/Tandem/internal/result/export_shapes.h>

namespace CGAL::Tandem::internal {

template class Engine<Sequential_backend>;
template std::unique_ptr<Detection_engine> make_engine(Sequential_backend&, Import&, const Parameters&, Progress&);
template Distance_estimate complete_parameters(Sequential_backend&, const Import&, bool, Parameters&);
template std::string set_scale(Sequential_backend&, Import&, bool, Parameters&);
template void find_neighbors(Sequential_backend&, const Grid_point*, std::uint32_t, int, std::uint32_t*);
template Shapes_data export_shapes(Sequential_backend&, const Import&, const Parameters&, const Engine_result&);
template Point_groups group_points(Sequential_backend&, const std::int32_t*, std::size_t, std::size_t);
template Plane_relations relate_planes(Sequential_backend&, Import&, const std::vector<int>&, Parameters,
                                       std::vector<Coefficients>&);

template void start_import<float>(Import&, std::size_t, bool);
template void start_import<double>(Import&, std::size_t, bool);
template bool inspect_points(const Values<float>&, std::size_t, Coordinate_box&);
template bool inspect_points(const Values<double>&, std::size_t, Coordinate_box&);
template void drop_invalid<float>(Import&);
template void drop_invalid<double>(Import&);

} // namespace CGAL::Tandem::internal
