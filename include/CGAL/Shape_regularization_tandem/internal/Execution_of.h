// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which back end and which engine a concurrency tag selects. Decided at compile time; see the manual, "Back Ends and
// Determinism".

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_EXECUTION_OF_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_EXECUTION_OF_H

#include <CGAL/Shape_regularization_tandem/tags.h>
#include <CGAL/Tandem/internal/backend/Parallel_host.h>
#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/cuda/interface/cuda_api.h>
#include <CGAL/Tandem/internal/engine/engine_api.h>

#include <memory>
#include <stdexcept>
#include <type_traits>

namespace CGAL::Tandem::internal {

// The back end that a tag selects, or a compile-time error that names the remedy. Cuda_tag gets here only if the library
// is not linked.
template <class Tag>
struct Backend_of {
  static constexpr bool is_parallel = std::is_convertible<Tag, CGAL::Parallel_tag>::value;
  static_assert(!std::is_same<Tag, Cuda_tag>::value,
                "Cuda_tag needs the CUDA back end: link Tandem::tandem_cuda (it defines CGAL_TANDEM_USE_CUDA), "
                "or use Cuda_if_available_tag.");
  static_assert(!is_parallel || !std::is_same<Parallel_host, Sequential_backend>::value,
                "Parallel_tag is enabled but TBB is unavailable.");
  static_assert(std::is_convertible<Tag, CGAL::Sequential_tag>::value || std::is_same<Tag, Cuda_tag>::value,
                "The concurrency tag is one of Sequential_tag, Parallel_tag, Parallel_if_available_tag, Cuda_tag, "
                "Cuda_if_available_tag.");
  using type = typename std::conditional<is_parallel, Parallel_host, Sequential_backend>::type;
};

// The method on a back end. It also reads the caller's range and writes the result, so it is one of the host. Upload is
// where the values go that are read.
template <class Host>
struct Execution_on {
  using Backend = Host;
  using Upload = No_upload;

  Backend backend() const { return Backend(); }

  static std::unique_ptr<Detection_engine> start(Backend& backend, Import& in, const Parameters& parameters,
                                                 Progress& progress)
  {
    return make_engine(backend, in, parameters, progress);
  }
};

// On the device if that is possible, else on the host. Decided once, at the start, when device and number of points are
// known; both give the same result. Failures of the device after that are exceptions.
template <class Host>
struct Cuda_or_host_execution : Execution_on<Host> {
  using Upload = Cuda_upload; // before the choice: the range is read first

  static std::unique_ptr<Detection_engine> start(Host& backend, Import& in, const Parameters& parameters,
                                                 Progress& progress)
  {
    // There may be no device, or one that is busy, reserved, too small, or fails before the first round.
    try {
      return make_cuda_engine(in, parameters, progress);
    } catch(const std::runtime_error&) {
      if(progress.has_thrown())
        throw;
    } catch(const std::length_error&) {
      if(progress.has_thrown())
        throw;
    }
    in.drop_upload(); // the host needs the values in the tables of the import
    return make_engine(backend, in, parameters, progress);
  }
};

// A tag of your own: specialize this.
template <class Tag>
struct Execution_of : Execution_on<typename Backend_of<Tag>::type> {};

#ifdef CGAL_TANDEM_USE_CUDA
// The method on a device, or an exception where there is none.
template <>
struct Execution_of<Cuda_tag> : Execution_on<Parallel_host> {
  using Upload = Cuda_upload;

  static std::unique_ptr<Detection_engine> start(Backend&, Import& in, const Parameters& parameters, Progress& progress)
  {
    return make_cuda_engine(in, parameters, progress);
  }
};

template <>
struct Execution_of<Cuda_if_available_tag> : Cuda_or_host_execution<Parallel_host> {};
#endif

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_EXECUTION_OF_H
