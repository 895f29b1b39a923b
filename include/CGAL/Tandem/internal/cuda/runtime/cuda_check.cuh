// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_CUDA_CHECK_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_CUDA_CHECK_CUH

#include <cuda_runtime.h>

#include <stdexcept>
#include <string>

namespace CGAL {
namespace Tandem {
namespace internal {

inline void check_cuda(cudaError_t error, const char* expression, const char* file, int line)
{
  if(error == cudaSuccess)
    return;
  static_cast<void>(cudaGetLastError()); // so that it is not reported again
  throw std::runtime_error(std::string("CUDA: ") + cudaGetErrorString(error) + " (" + cudaGetErrorName(error) +
                           ") in " + expression + ", " + file + ":" + std::to_string(line));
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

// Turns a failure of the runtime into an exception.
#define CGAL_TANDEM_CUDA(expression) ::CGAL::Tandem::internal::check_cuda(expression, #expression, __FILE__, __LINE__)

// After a launch.
#define CGAL_TANDEM_CUDA_LAUNCHED() CGAL_TANDEM_CUDA(cudaGetLastError())

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_CUDA_CHECK_CUH
