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
    : device_(engine_on_device(in, parameters))
  {
    if(device_ == nullptr) {
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
  // Null if there is no device, or one that is busy, reserved, too small, or fails before the first round.
  static std::unique_ptr<Cuda_engine> engine_on_device(Import& in, const Parameters& parameters)
  {
    try {
      return std::make_unique<Cuda_engine>(in, parameters);
    } catch(const std::runtime_error&) {
    } catch(const std::length_error&) {
    }
    return nullptr;
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
