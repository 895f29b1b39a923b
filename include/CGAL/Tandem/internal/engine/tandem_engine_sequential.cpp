// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/engine/compiled_engine_impl.h>

namespace CGAL {
namespace Tandem {
namespace internal {

template class Engine<Sequential_backend>;
template class Compiled_engine<Sequential_backend>;
template Cloud_measure measure_cloud(Sequential_backend&, const Import&);
template void find_neighbors(Sequential_backend&, const Grid_point*, std::uint32_t, int, std::uint32_t*);
template Plane_relations relate_planes(Sequential_backend&, Import&, const std::vector<int>&, Regularity_options,
                                       std::vector<Coefficients>&);

} // namespace internal
} // namespace Tandem
} // namespace CGAL
