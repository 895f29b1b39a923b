// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_CUDA_DEVICE_GUARD_CUH
#define CGAL_TANDEM_INTERNAL_BACKEND_CUDA_DEVICE_GUARD_CUH

#include <CGAL/Tandem/internal/backend/cuda/cuda_check.cuh>

#include <cuda.h>

namespace CGAL {
namespace Tandem {
namespace internal {

inline int current_device()
{
  int device = 0;
  CGAL_TANDEM_CUDA(cudaGetDevice(&device));
  return device;
}

// Whether anybody has used the device; asks the driver, which is not linked.
inline bool has_context(int device)
{
  using Get_state = CUresult(CUDAAPI*)(CUdevice, unsigned*, int*);
  const char* const name = "cuDevicePrimaryCtxGetState";
  void* function = nullptr;
#if CUDART_VERSION >= 12050
  constexpr unsigned since = 7000;
  const cudaError_t error = cudaGetDriverEntryPointByVersion(name, &function, since, cudaEnableDefault, nullptr);
#elif CUDART_VERSION >= 12000
  const cudaError_t error = cudaGetDriverEntryPoint(name, &function, cudaEnableDefault, nullptr);
#else
  const cudaError_t error = cudaGetDriverEntryPoint(name, &function, cudaEnableDefault);
#endif
  unsigned flags = 0;
  int is_active = 1;
  if(error == cudaSuccess && function != nullptr)
    static_cast<void>(reinterpret_cast<Get_state>(function)(device, &flags, &is_active));
  return is_active != 0;
}

// Makes a device the current one of the thread for a while. Throws nothing: it is for destructors as well, and what
// fails here fails in the next call. A thread that has chosen no device, as those of oneTBB, looks like one of device
// 0, where cudaSetDevice() would make a context of some hundred megabytes: where nobody has used that device, the
// thread keeps the other one.
class Device_guard {
public:
  explicit Device_guard(int device)
  {
    static_cast<void>(cudaGetDevice(&before_));
    is_other_ = device != before_;
    if(is_other_)
      static_cast<void>(cudaSetDevice(device));
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
  bool is_other_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_CUDA_DEVICE_GUARD_CUH
