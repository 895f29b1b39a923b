// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Failures of the CUDA runtime become exceptions with expression, file and line.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_CUDA_CHECK_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_CUDA_CHECK_CUH

#include <CGAL/Tandem/internal/cuda/interface/cuda_api.h>

#include <cuda_runtime.h>

#include <stdexcept>
#include <string>

namespace CGAL::Tandem::internal {

// Throws std::runtime_error unless the error is cudaSuccess.
inline void check_cuda(cudaError_t error, const char* expression, const char* file, int line)
{
  if(error == cudaSuccess)
    return;
  static_cast<void>(cudaGetLastError()); // later calls must not report it again
  throw std::runtime_error(std::string("CUDA: ") + cudaGetErrorString(error) + " (" + cudaGetErrorName(error) +
                           ") in " + expression + ", " + file + ":" + std::to_string(line));
}

// Counts a launch, and throws if it has failed.
inline void check_launch(const char* file, int line)
{
  ++Device_work::of_thread().launches;
  check_cuda(cudaGetLastError(), "a launch", file, line);
}

} // namespace CGAL::Tandem::internal

// For every call of the runtime that returns an error.
#define CGAL_TANDEM_CUDA(expression) ::CGAL::Tandem::internal::check_cuda(expression, #expression, __FILE__, __LINE__)

// After a launch, which returns nothing. Finds failures of the launch, not of the kernel.
#define CGAL_TANDEM_CUDA_LAUNCHED() ::CGAL::Tandem::internal::check_launch(__FILE__, __LINE__)

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_CUDA_CHECK_CUH
