// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What executes the method, for the tags of the host and of the device.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_EXECUTION_H
#define CGAL_TANDEM_INTERNAL_BACKEND_EXECUTION_H

#include <CGAL/Shape_regularization_tandem/tags.h>
#include <CGAL/Tandem/internal/Engine.h>
#ifdef CGAL_TANDEM_USE_CUDA
#include <CGAL/Tandem/internal/backend/cuda/cuda_api.h>
#endif

#include <memory>
#include <stdexcept>

namespace CGAL {
namespace Tandem {
namespace internal {

// Backend: what works at the border of the caller, on the host. Engine: the loop.
template <class Tag>
struct Execution {
  using Backend = typename Backend_of<Tag>::type;
  using Engine = internal::Engine<Backend>;
};

#ifdef CGAL_TANDEM_USE_CUDA

// On the device if that can do it, else on the host.
template <class Backend>
class Cuda_or_host_engine {
public:
  using Upload = Cuda_engine::Upload;

  Cuda_or_host_engine(Backend& backend, Import& in, const Parameters& parameters)
  {
    if(can_use_device(in, parameters))
      device_ = std::make_unique<Cuda_engine>(in, parameters);
    else {
      in.drop_upload();
      host_ = std::make_unique<Engine<Backend>>(backend, in, parameters);
    }
  }

  const char* name() const { return device_ ? device_->name() : host_->name(); }
  bool iterate() { return device_ ? device_->iterate() : host_->iterate(); }
  void finish() { device_ ? device_->finish() : host_->finish(); }
  double progress() const { return device_ ? device_->progress() : host_->progress(); }
  Engine_result result() { return device_ ? device_->result() : host_->result(); }

private:
  // A device may be there, but busy or reserved.
  static bool can_use_device(Import& in, const Parameters& parameters)
  {
    try {
      return is_cuda_available() && fits_on_device(in, parameters);
    } catch(const std::runtime_error&) {
      return false;
    }
  }

  std::unique_ptr<Cuda_engine> device_;
  std::unique_ptr<Engine<Backend>> host_;
};

template <>
struct Execution<Cuda_tag> {
  using Backend = typename Backend_of<CGAL::Parallel_if_available_tag>::type;
  using Engine = Cuda_engine;
};

template <>
struct Execution<Cuda_if_available_tag> {
  using Backend = typename Backend_of<CGAL::Parallel_if_available_tag>::type;
  using Engine = Cuda_or_host_engine<Backend>;
};

#endif

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_EXECUTION_H
