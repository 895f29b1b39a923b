// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the public headers call of the libraries of many processes. The host compiler and nvcc both accept it.

#ifndef CGAL_TANDEM_INTERNAL_MPI_MPI_API_H
#define CGAL_TANDEM_INTERNAL_MPI_MPI_API_H

#include <CGAL/Tandem/internal/engine/engine_api.h>
#include <CGAL/Tandem/internal/mpi/Mpi_backend.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace CGAL::Tandem::internal {

struct Labeled_points;

// make_engine() of many ranks, in the library Tandem::tandem_mpi; all ranks call it, and each function of the engine.
// The values of the import go to other ranks; it keeps its numbers of points and items.
template <class Local>
std::unique_ptr<Detection_engine> make_engine(Mpi_backend<Local>& backend, Import& in, const Parameters& parameters,
                                              Progress& progress);

// The same with a CUDA device in each process: the one that is current now. In the library Tandem::tandem_mpi_cuda.
// Throws std::runtime_error without a device, and for failures of it, such as too little memory.
std::unique_ptr<Detection_engine> make_cuda_engine(Mpi_backend<Parallel_host>& host, Import& in,
                                                   const Parameters& parameters, Progress& progress);

// The one of engine/first_unconnected.h for a result over many ranks, in the library as well.
template <class Local>
std::size_t first_unconnected(Mpi_backend<Local>& backend, Import& in, const Labeled_points& result);

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_MPI_MPI_API_H
