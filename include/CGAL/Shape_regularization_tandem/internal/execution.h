// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engines that Execution_of.h names, and the one that chooses between device and host at run time.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_EXECUTION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_EXECUTION_H

#include <CGAL/Shape_regularization_tandem/internal/Execution_of.h>
#ifdef CGAL_TANDEM_USE_ENGINE
#include <CGAL/Tandem/internal/engine/compiled_engine.h>
#else
#include <CGAL/Tandem/internal/engine/Engine.h>
#include <CGAL/Tandem/internal/finish/export_shapes.h>
#endif
#ifdef CGAL_TANDEM_USE_CUDA
#include <CGAL/Tandem/internal/cuda/interface/cuda_api.h>
#endif

#include <memory>
#include <stdexcept>

namespace CGAL {
namespace Tandem {
namespace internal {

#ifdef CGAL_TANDEM_USE_CUDA

// Computes on the device if that is possible, else on the host. Decided once, in the constructor; both give the same
// result. Failures of the device after that are exceptions.
template <class Backend>
class Cuda_or_host_engine {
public:
  // An upload starts before the choice: the range is read first.
  using Upload = Cuda_engine::Upload;

  Cuda_or_host_engine(Backend& backend, Import& in, const Parameters& parameters, Progress& progress)
    : device_(engine_on_device(in, parameters, progress))
  {
    if(device_ == nullptr) {
      // The host needs the values in the tables of the import.
      in.drop_upload();
      host_ = std::make_unique<Host_engine<Backend>>(backend, in, parameters, progress);
    }
  }

  // Each call goes to the one engine that exists.
  const char* name() const { return device_ ? device_->name() : host_->name(); }
  bool iterate() { return device_ ? device_->iterate() : host_->iterate(); }
  void finish() { device_ ? device_->finish() : host_->finish(); }
  Engine_result result() { return device_ ? device_->result() : host_->result(); }

private:
  // Null if there is no device, or one that is busy, reserved, too small, or fails before the first round.
  static std::unique_ptr<Cuda_engine> engine_on_device(Import& in, const Parameters& parameters, Progress& progress)
  {
    try {
      return std::make_unique<Cuda_engine>(in, parameters, progress);
    } catch(const std::runtime_error&) {
      if(progress.has_thrown())
        throw;
    } catch(const std::length_error&) {
      if(progress.has_thrown())
        throw;
    }
    return nullptr;
  }

  std::unique_ptr<Cuda_engine> device_;
  std::unique_ptr<Host_engine<Backend>> host_;
};

#endif

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_EXECUTION_H
