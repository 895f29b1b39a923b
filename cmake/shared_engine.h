// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Comes before the sources of tests, examples and benchmark. The engine, which takes longest to compile, is compiled
// once for all of them, in shared_engine_*.cpp. Precompiled, this header also spares them the reading of CGAL.

#ifndef CGAL_TANDEM_SHARED_ENGINE_H
#define CGAL_TANDEM_SHARED_ENGINE_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Simple_cartesian.h>

namespace CGAL {
namespace Tandem {
namespace internal {

extern template class Engine<Sequential_backend>;
extern template void complete_parameters(Sequential_backend&, const Import&, bool, Parameters&);
extern template void find_neighbors(Sequential_backend&, const Grid_point*, std::uint32_t, int, std::uint32_t*);
#ifdef CGAL_LINKED_WITH_TBB
extern template class Engine<Tbb_backend>;
extern template void complete_parameters(Tbb_backend&, const Import&, bool, Parameters&);
extern template void find_neighbors(Tbb_backend&, const Grid_point*, std::uint32_t, int, std::uint32_t*);
#endif

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_SHARED_ENGINE_H
