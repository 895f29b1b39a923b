// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/engine/complete_parameters.h>
#include <CGAL/Tandem/internal/mpi/Mpi_engine.h>
#include <CGAL/Tandem/internal/result/export_shapes.h>

namespace CGAL::Tandem::internal {

using Backend = Mpi_backend<Sequential_backend>;

template std::unique_ptr<Detection_engine> make_engine(Backend&, Import&, const Parameters&, Progress&);
template std::size_t first_unconnected(Backend&, Import&, const Labeled_points&);
template Distance_estimate complete_parameters(Backend&, const Import&, bool, Parameters&);
template std::string set_scale(Backend&, Import&, bool, Parameters&);
template Shapes_data export_shapes(Backend&, const Import&, const Parameters&, const Engine_result&);

} // namespace CGAL::Tandem::internal
