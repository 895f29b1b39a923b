// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The current device of a thread: the runtime has one for each thread, and work goes to it. Changes the current device
// only while a guard exists.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_DEVICE_GUARD_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_DEVICE_GUARD_CUH

#include <CGAL/Tandem/internal/cuda/runtime/cuda_check.cuh>

#include <cuda.h>

#include <new>

namespace CGAL {
namespace Tandem {
namespace internal {

inline int current_device()
{
  int device = 0;
  CGAL_TANDEM_CUDA(cudaGetDevice(&device));
  return device;
}

// Whether the process has a context on the device. Since CUDA 12, cudaSetDevice() makes one; before, it does not, so
// true is harmless.
inline bool has_context(int device)
{
  int is_active = 1;
#if CUDART_VERSION >= 12000
  const char* const name = "cuDevicePrimaryCtxGetState"; // of the driver, which is not linked
  void* function = nullptr;
#if CUDART_VERSION >= 12050
  constexpr unsigned since = 7000;
  const cudaError_t error = cudaGetDriverEntryPointByVersion(name, &function, since, cudaEnableDefault);
#else
  const cudaError_t error = cudaGetDriverEntryPoint(name, &function, cudaEnableDefault);
#endif
  using Get_state = CUresult(CUDAAPI*)(CUdevice, unsigned*, int*);
  unsigned flags = 0;
  if(error == cudaSuccess && function != nullptr)
    static_cast<void>(reinterpret_cast<Get_state>(function)(device, &flags, &is_active));
#else
  static_cast<void>(device);
#endif
  return is_active != 0;
}

// Makes a device the current one of the thread for a while. A thread that has chosen none, such as those of oneTBB, has
// device 0. To set that again would make a context there, which takes memory of the device. So a thread keeps the other
// device if there is no context on its former one.
class Device_guard {
public:
  explicit Device_guard(int device) : Device_guard(device, std::nothrow)
  {
    check_cuda(error_, "cudaSetDevice(device)", __FILE__, __LINE__);
  }

  // For destructors, which must not throw where the device has failed.
  Device_guard(int device, const std::nothrow_t&) : error_(cudaGetDevice(&before_))
  {
    is_other_ = error_ == cudaSuccess && device != before_;
    if(is_other_)
      error_ = cudaSetDevice(device);
    if(error_ != cudaSuccess)
      static_cast<void>(cudaGetLastError()); // so that it is not reported again
  }

  ~Device_guard()
  {
    if(is_other_ && has_context(before_))
      static_cast<void>(cudaSetDevice(before_));
  }

  Device_guard(const Device_guard&) = delete;
  Device_guard& operator=(const Device_guard&) = delete;

private:
  int before_ = 0;
  cudaError_t error_;
  bool is_other_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_DEVICE_GUARD_CUH
