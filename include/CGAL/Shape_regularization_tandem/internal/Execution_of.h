// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which back end and which engine a concurrency tag selects. Decided at compile time; see the manual, "Back Ends and
// Determinism".

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_EXECUTION_OF_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_EXECUTION_OF_H

#include <CGAL/Shape_regularization_tandem/tags.h>
#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#ifdef CGAL_LINKED_WITH_TBB
#include <CGAL/Tandem/internal/backend/Tbb_backend.h>
#endif

#include <type_traits>

namespace CGAL {
namespace Tandem {
namespace internal {

// The engines are defined in execution.h, so that headers that only name them need not include the method.
#ifdef CGAL_TANDEM_USE_ENGINE
template <class Backend>
class Compiled_engine;
template <class Backend>
using Host_engine = Compiled_engine<Backend>;
#else
template <class Backend>
class Engine;
template <class Backend>
using Host_engine = Engine<Backend>;
#endif
#ifdef CGAL_TANDEM_USE_CUDA
class Cuda_engine;
template <class Backend>
class Cuda_or_host_engine;
#endif

// The back end of the host that a tag selects, or a compile-time error that names the remedy. Cuda_tag gets here only
// if the library is not linked.
template <class Tag>
struct Backend_of {
  static_assert(!std::is_same<Tag, Cuda_tag>::value,
                "Cuda_tag needs the CUDA back end: link Tandem::tandem_cuda (it defines CGAL_TANDEM_USE_CUDA), "
                "or use Cuda_if_available_tag.");
  static_assert(!std::is_convertible<Tag, CGAL::Parallel_tag>::value,
                "Parallel_tag is enabled but TBB is unavailable.");
  static_assert(std::is_convertible<Tag, CGAL::Sequential_tag>::value || std::is_same<Tag, Cuda_tag>::value,
                "The concurrency tag is one of Sequential_tag, Parallel_tag, Parallel_if_available_tag, Cuda_tag, "
                "Cuda_if_available_tag.");
  using type = Sequential_backend;
};

#ifdef CGAL_LINKED_WITH_TBB
// Parallel_if_available_tag is this tag or Sequential_tag, so it needs no entry.
template <>
struct Backend_of<CGAL::Parallel_tag> {
  using type = Tbb_backend;
};
#endif

// Backend reads the caller's range and writes the result, on the host. Engine runs the method.
template <class Tag>
struct Execution_of {
  using Backend = typename Backend_of<Tag>::type;
  using Engine = Host_engine<Backend>;
};

#ifdef CGAL_TANDEM_USE_CUDA

// An exception where there is no device.
template <>
struct Execution_of<Cuda_tag> {
  using Backend = typename Backend_of<CGAL::Parallel_if_available_tag>::type;
  using Engine = Cuda_engine;
};

// The choice is at run time, when device and number of points are known.
template <>
struct Execution_of<Cuda_if_available_tag> {
  using Backend = typename Backend_of<CGAL::Parallel_if_available_tag>::type;
  using Engine = Cuda_or_host_engine<Backend>;
};

#endif

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_EXECUTION_OF_H
