// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TAGS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TAGS_H

#include <CGAL/tags.h>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

Selects a CUDA device for the computation: the one that is current for the calling
thread. Where there is something to do, but no device, `std::runtime_error` is thrown, and
`std::length_error` if it has not enough memory. Needs the library `Tandem::tandem_cuda`. Besides this tag there
are CGAL's `Sequential_tag`, `Parallel_tag` and `Parallel_if_available_tag`. All of
them give the same result, bit for bit.
*/
struct Cuda_tag {};

/*!
\ingroup PkgShapeRegularizationTandemRef

`Cuda_tag` where the CUDA back end is linked, a device is there, and the points fit into its
memory, otherwise `CGAL::Parallel_if_available_tag`. If the device fails later, or while the points are in its
memory only, `std::runtime_error` is thrown.
*/
#ifdef CGAL_TANDEM_USE_CUDA
struct Cuda_if_available_tag {};
#else
using Cuda_if_available_tag = CGAL::Parallel_if_available_tag;
#endif

/*!
\ingroup PkgShapeRegularizationTandemRef

Many processes that run the method together, each with a part of the points, and that exchange what they need through
MPI. Each of them calls the same functions, with its points. The result is that of one process with all of the points,
bit for bit. Needs the header `CGAL/Shape_regularization_tandem/mpi.h` and the library `Tandem::tandem_mpi`.

\tparam ExecutionTag what executes within each process: `CGAL::Sequential_tag`, `CGAL::Parallel_tag`,
`CGAL::Parallel_if_available_tag` or, with the library `Tandem::tandem_mpi_cuda`, `Cuda_tag`: the device that is current
in the process
*/
template <class ExecutionTag = CGAL::Parallel_if_available_tag>
struct Mpi_tag {};

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TAGS_H
