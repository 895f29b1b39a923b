// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The back end of the host that CGAL::Parallel_if_available_tag selects. It also works beside a device, on what only the
// host has.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_PARALLEL_HOST_H
#define CGAL_TANDEM_INTERNAL_BACKEND_PARALLEL_HOST_H

#ifdef CGAL_LINKED_WITH_TBB
#include <CGAL/Tandem/internal/backend/Tbb_backend.h>
#else
#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#endif

namespace CGAL::Tandem::internal {

#ifdef CGAL_LINKED_WITH_TBB
using Parallel_host = Tbb_backend;
#else
using Parallel_host = Sequential_backend;
#endif

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BACKEND_PARALLEL_HOST_H
