// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_CUDA_HOST_SIDE_H
#define CGAL_TANDEM_INTERNAL_BACKEND_CUDA_HOST_SIDE_H

#ifdef CGAL_LINKED_WITH_TBB
#include <CGAL/Tandem/internal/backend/Tbb_backend.h>
#else
#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#endif

namespace CGAL {
namespace Tandem {
namespace internal {

// What works on the tables of the host beside a device.
#ifdef CGAL_LINKED_WITH_TBB
using Host_side = Tbb_backend;
#else
using Host_side = Sequential_backend;
#endif

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_CUDA_HOST_SIDE_H
