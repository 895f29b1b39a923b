// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The interface of the library tandem_mpi_cuda: an engine of many processes, each with a CUDA device. Plain data and
// functions that the host compiler and nvcc both accept.

#ifndef CGAL_TANDEM_INTERNAL_MPI_CUDA_MPI_ENGINE_H
#define CGAL_TANDEM_INTERNAL_MPI_CUDA_MPI_ENGINE_H

#include <CGAL/Tandem/internal/base/Progress.h>
#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/finish/Engine_result.h>
#include <CGAL/Tandem/internal/mpi/Mpi_backend.h>

#include <memory>

namespace CGAL {
namespace Tandem {
namespace internal {

// Mpi_engine<Cuda_backend>, on the device that is current when it is constructed.
class Cuda_mpi_engine {
public:
  using Upload = No_upload;

  // Throws std::runtime_error without a device, and for failures of it, such as too little memory.
  Cuda_mpi_engine(Mpi_backend<Parallel_host>& host, Import& in, const Parameters& parameters, Progress& progress);
  ~Cuda_mpi_engine();

  static const char* name() { return "cuda"; }
  bool iterate();
  void finish();
  Engine_result result();

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_CUDA_MPI_ENGINE_H
