// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Comes before the sources of tests, examples and benchmark. Precompiled, it spares them the reading of CGAL. Some use the
// engine itself: what they share with others they get from the library tandem_engine.

#ifndef CGAL_TANDEM_PRECOMPILED_H
#define CGAL_TANDEM_PRECOMPILED_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Tandem/internal/engine/Engine.h>
#include <CGAL/Tandem/internal/engine/complete_parameters.h>
#include <CGAL/Tandem/internal/result/export_shapes.h>

namespace CGAL {
namespace Tandem {
namespace internal {

extern template class Engine<Sequential_backend>;
extern template Distance_estimate complete_parameters(Sequential_backend&, const Import&, bool, Parameters&);
extern template std::string set_scale(Sequential_backend&, Import&, bool, Parameters&);
extern template void find_neighbors(Sequential_backend&, const Grid_point*, std::uint32_t, int, std::uint32_t*);
extern template Shapes_data export_shapes(Sequential_backend&, const Import&, const Parameters&, const Engine_result&);
#ifdef CGAL_LINKED_WITH_TBB
extern template class Engine<Tbb_backend>;
extern template Distance_estimate complete_parameters(Tbb_backend&, const Import&, bool, Parameters&);
extern template std::string set_scale(Tbb_backend&, Import&, bool, Parameters&);
extern template void find_neighbors(Tbb_backend&, const Grid_point*, std::uint32_t, int, std::uint32_t*);
extern template Shapes_data export_shapes(Tbb_backend&, const Import&, const Parameters&, const Engine_result&);
#endif

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_PRECOMPILED_H
