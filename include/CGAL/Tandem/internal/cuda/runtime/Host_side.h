// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The back end that works on memory of the host beside a device. It has loops over what only the host has, and
// copies of large tables.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_HOST_SIDE_H
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_HOST_SIDE_H

#ifdef CGAL_LINKED_WITH_TBB
#include <CGAL/Tandem/internal/backend/Tbb_backend.h>
#else
#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#endif

namespace CGAL {
namespace Tandem {
namespace internal {

#ifdef CGAL_LINKED_WITH_TBB
using Host_side = Tbb_backend;
#else
using Host_side = Sequential_backend;
#endif

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_HOST_SIDE_H
