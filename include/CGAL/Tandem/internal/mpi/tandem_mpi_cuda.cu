// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The method over many processes, instantiated for Cuda_backend and compiled by nvcc. Defines the make_cuda_engine() of
// mpi_api.h.

#pragma nv_diag_suppress 20011, 20014 // the functors of Cuda_backend run on the device only

#include <CGAL/Tandem/internal/cuda/interface/cuda_api.h>
#include <CGAL/Tandem/internal/cuda/runtime/Engine_on_device.cuh>
#include <CGAL/Tandem/internal/cuda/stages/Cuda_stages.cuh>
#include <CGAL/Tandem/internal/mpi/Mpi_engine.h>
#include <CGAL/Tandem/internal/mpi/mpi_api.h>

namespace CGAL::Tandem::internal {

std::unique_ptr<Detection_engine> make_cuda_engine(Mpi_backend<Parallel_host>& host, Import& in,
                                                   const Parameters& parameters, Progress& progress)
{
  if(!is_cuda_available())
    throw std::runtime_error("Mpi_tag<Cuda_tag>: rank " + to_text(host.communicator().rank()) + " has " +
                             cuda_device_report());
  return std::make_unique<Engine_on_device>(
    [&] { return std::make_unique<Mpi_engine<Cuda_backend>>(host, in, parameters, progress); });
}

} // namespace CGAL::Tandem::internal
