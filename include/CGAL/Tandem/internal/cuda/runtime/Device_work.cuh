// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a thread of the host has asked of its devices, for tests. No result depends on it.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_DEVICE_WORK_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_DEVICE_WORK_CUH

#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {

// Sums since the thread has begun. What several threads copy together counts for the one that has started them, as one
// wait.
struct Device_work {
  std::uint64_t launches = 0; // kernels, and calls of CUB, which launches several
  std::uint64_t waits = 0;
  std::uint64_t bytes_copied = 0;

  static Device_work& of_thread()
  {
    thread_local Device_work work;
    return work;
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_DEVICE_WORK_CUH
