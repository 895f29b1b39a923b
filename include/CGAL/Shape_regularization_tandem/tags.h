// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TAGS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TAGS_H

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#ifdef CGAL_LINKED_WITH_TBB
#include <CGAL/Tandem/internal/backend/Tbb_backend.h>
#endif

#include <CGAL/tags.h>

#include <type_traits>

namespace CGAL {
namespace Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

Asks for the computation on a CUDA device: the one that is current for the calling
thread. Where there is something to do, but no device, `std::runtime_error` is thrown, and
`std::length_error` if it has not enough memory. Needs the library `Tandem::tandem_cuda`. Besides this tag there
are CGAL's `Sequential_tag`, `Parallel_tag` and `Parallel_if_available_tag`. All of
them give the same result, bit for bit.
*/
struct Cuda_tag {};

/*!
\ingroup PkgShapeRegularizationTandemRef

`Cuda_tag` where the CUDA back end is linked, a device is there, and the points fit into its
memory, otherwise `CGAL::Parallel_if_available_tag`. If the device fails later, or while nothing but it has the
points, `std::runtime_error` is thrown.
*/
#ifdef CGAL_TANDEM_USE_CUDA
struct Cuda_if_available_tag {};
#else
using Cuda_if_available_tag = CGAL::Parallel_if_available_tag;
#endif

namespace internal {

// The back end that executes what a tag asks for.
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
template <>
struct Backend_of<CGAL::Parallel_tag> {
  using type = Tbb_backend;
};
#endif

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TAGS_H
