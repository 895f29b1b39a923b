// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shared_engine.h"

namespace CGAL {
namespace Tandem {
namespace internal {

template class Engine<Sequential_backend>;
template void complete_parameters(Sequential_backend&, const Import&, bool, Parameters&);
template void find_neighbors(Sequential_backend&, const Grid_point*, std::uint32_t, int, std::uint32_t*);

} // namespace internal
} // namespace Tandem
} // namespace CGAL
