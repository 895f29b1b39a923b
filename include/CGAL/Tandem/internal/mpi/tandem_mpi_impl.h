// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// For the sources of the library Tandem::tandem_mpi: defines what Compiled_mpi_engine.h declares.

#ifndef CGAL_TANDEM_INTERNAL_MPI_TANDEM_MPI_IMPL_H
#define CGAL_TANDEM_INTERNAL_MPI_TANDEM_MPI_IMPL_H

#include <CGAL/Tandem/internal/mpi/Compiled_mpi_engine.h>
#include <CGAL/Tandem/internal/mpi/Mpi_engine.h>
#include <CGAL/Tandem/internal/mpi/first_unconnected.h>

#include <CGAL/Tandem/internal/engine/complete_parameters.h>
#include <CGAL/Tandem/internal/finish/export_shapes.h>

namespace CGAL {
namespace Tandem {
namespace internal {

template <class Local>
Compiled_mpi_engine<Local>::Compiled_mpi_engine(Mpi_backend<Local>& backend, Import& in, const Parameters& parameters,
                                                Progress& progress)
  : engine_(std::make_unique<Mpi_engine<Local>>(backend, in, parameters, progress))
{}

template <class Local>
Compiled_mpi_engine<Local>::~Compiled_mpi_engine() = default;

template <class Local>
bool Compiled_mpi_engine<Local>::iterate()
{
  return engine_->iterate();
}

template <class Local>
void Compiled_mpi_engine<Local>::finish()
{
  engine_->finish();
}

template <class Local>
Engine_result Compiled_mpi_engine<Local>::result()
{
  return engine_->result();
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_TANDEM_MPI_IMPL_H
