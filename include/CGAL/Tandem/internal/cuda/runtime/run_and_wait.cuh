// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the libraries call an engine on a device.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_RUN_AND_WAIT_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_RUN_AND_WAIT_CUH

#include <CGAL/Tandem/internal/cuda/runtime/copy.cuh>

namespace CGAL {
namespace Tandem {
namespace internal {

// Calls f on the current device. Waits for all work that f has queued, also when f throws. So another
// thread, with another stream, may call next, and no copy reads memory that the caller frees.
template <class F>
void run_and_wait(F f)
{
  try {
    f();
    synchronize();
  } catch(...) {
    // The exception of f counts, not an error of this wait.
    static_cast<void>(cudaStreamSynchronize(stream_of_thread()));
    throw;
  }
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_RUN_AND_WAIT_CUH
