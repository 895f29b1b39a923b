// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The method over many processes, instantiated for Cuda_backend and compiled by nvcc. Defines what Cuda_mpi_engine.h
// declares.

#pragma nv_diag_suppress 20011, 20014 // the functors of Cuda_backend run on the device only

#include <CGAL/Tandem/internal/mpi/Cuda_mpi_engine.h>

#include <CGAL/Tandem/internal/cuda/interface/cuda_api.h>
#include <CGAL/Tandem/internal/cuda/runtime/run_and_wait.cuh>
#include <CGAL/Tandem/internal/cuda/stages/Cuda_stages.cuh>
#include <CGAL/Tandem/internal/mpi/Mpi_engine.h>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Cuda_mpi_engine::Implementation {
  Implementation(Mpi_backend<Parallel_host>& host, Import& in, const Parameters& parameters, Progress& progress)
    : device(current_device()), engine(host, in, parameters, progress)
  {}

  template <class F>
  void on_device(F f)
  {
    const Device_guard guard(device);
    run_and_wait(f);
  }

  int device;
  Mpi_engine<Cuda_backend> engine;
};

Cuda_mpi_engine::Cuda_mpi_engine(Mpi_backend<Parallel_host>& host, Import& in, const Parameters& parameters,
                                 Progress& progress)
{
  if(!is_cuda_available())
    throw std::runtime_error("Mpi_tag<Cuda_tag>: rank " + to_text(host.communicator().rank()) + " has " +
                             cuda_device_report());
  run_and_wait([&] { implementation_ = std::make_unique<Implementation>(host, in, parameters, progress); });
}

Cuda_mpi_engine::~Cuda_mpi_engine()
{
  if(implementation_ == nullptr)
    return;
  const Device_guard guard(implementation_->device, std::nothrow);
  implementation_.reset();
}

bool Cuda_mpi_engine::iterate()
{
  bool is_going_on = false;
  implementation_->on_device([&] { is_going_on = implementation_->engine.iterate(); });
  return is_going_on;
}

void Cuda_mpi_engine::finish()
{
  implementation_->on_device([&] { implementation_->engine.finish(); });
}

Engine_result Cuda_mpi_engine::result()
{
  Engine_result result;
  implementation_->on_device([&] { result = implementation_->engine.result(); });
  return result;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL
