// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Tandem/internal/backend/Tbb_backend.h>
#include <CGAL/Tandem/internal/engine/Engine.h>
#include <CGAL/Tandem/internal/engine/complete_parameters.h>
#include <CGAL/Tandem/internal/result/export_shapes.h>

namespace CGAL::Tandem::internal {

template class Engine<Tbb_backend>;
template std::unique_ptr<Detection_engine> make_engine(Tbb_backend&, Import&, const Parameters&, Progress&);
template Distance_estimate complete_parameters(Tbb_backend&, const Import&, bool, Parameters&);
template std::string set_scale(Tbb_backend&, Import&, bool, Parameters&);
template void find_neighbors(Tbb_backend&, const Grid_point*, std::uint32_t, int, std::uint32_t*);
template Shapes_data export_shapes(Tbb_backend&, const Import&, const Parameters&, const Engine_result&);

} // namespace CGAL::Tandem::internal
