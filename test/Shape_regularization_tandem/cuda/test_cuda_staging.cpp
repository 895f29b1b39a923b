// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Copies of small tables by a thread that uses two devices. The runtime is made up here, so no device is needed: a copy
// ends when its stream is waited for, the latest moment that CUDA allows.

#include "testing/checks.h"

#include <CGAL/Tandem/internal/cuda/runtime/copy.cuh>

#include <cstdlib>
#include <cstring>
#include <thread>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_cuda_staging)

namespace {

int device_of_thread = 0;

struct Copy {
  void* target;
  const void* source;
  std::size_t bytes;
};

// The copies that each device has not ended.
std::vector<Copy>& copies()
{
  static std::vector<Copy> of_device[2];
  return of_device[device_of_thread];
}

} // namespace

extern "C" {

cudaError_t cudaGetDevice(int* device)
{
  *device = device_of_thread;
  return cudaSuccess;
}

cudaError_t cudaSetDevice(int device)
{
  device_of_thread = device;
  return cudaSuccess;
}

cudaError_t cudaHostAlloc(void** memory, std::size_t bytes, unsigned)
{
  *memory = std::malloc(bytes);
  return *memory != nullptr ? cudaSuccess : cudaErrorMemoryAllocation;
}

cudaError_t cudaFreeHost(void* memory)
{
  std::free(memory);
  return cudaSuccess;
}

cudaError_t cudaMemcpyAsync(void* target, const void* source, std::size_t bytes, cudaMemcpyKind, cudaStream_t)
{
  copies().push_back({target, source, bytes});
  return cudaSuccess;
}

cudaError_t cudaStreamSynchronize(cudaStream_t)
{
  for(const Copy& copy : copies())
    std::memcpy(copy.target, copy.source, copy.bytes);
  copies().clear();
  return cudaSuccess;
}

cudaError_t cudaGetLastError() { return cudaSuccess; }
const char* cudaGetErrorString(cudaError_t) { return ""; }
const char* cudaGetErrorName(cudaError_t) { return ""; }

// For has_context(), which then says that there is one.
#if CUDART_VERSION >= 12050
cudaError_t cudaGetDriverEntryPointByVersion(const char*, void**, unsigned, unsigned long long,
                                             cudaDriverEntryPointQueryResult*)
{
  return cudaErrorUnknown;
}
#elif CUDART_VERSION >= 12000
cudaError_t cudaGetDriverEntryPoint(const char*, void**, unsigned long long, cudaDriverEntryPointQueryResult*)
{
  return cudaErrorUnknown;
}
#endif

} // extern "C"

void copy_to_device(int source, int* target)
{
  CGAL::Tandem::internal::make_on_device(
    1, [&](std::size_t) { return source; }, target);
}

// As after the constructor of an engine that throws: nobody waits for the first device before the second one is used.
BOOST_AUTO_TEST_CASE(test_devices_in_turns)
{
  using CGAL::Tandem::internal::synchronize;
  const int source[2] = {1, 2};
  int target[2] = {0, 0};
  cudaSetDevice(0);
  copy_to_device(source[0], &target[0]);
  cudaSetDevice(1);
  synchronize();
  copy_to_device(source[1], &target[1]);
  synchronize();
  cudaSetDevice(0);
  check_equal(target[0], 0, "what has not been waited for");
  synchronize();
  check_equal(target[0], 1, "copy to the first device");
  check_equal(target[1], 2, "copy to the second device");
}

// A thread that ends waits on both devices, since its pinned memory goes to the next one.
BOOST_AUTO_TEST_CASE(test_end_of_thread)
{
  const int source[2] = {3, 4};
  int target[2] = {0, 0};
  std::thread([&] {
    for(int device = 0; device < 2; ++device) {
      cudaSetDevice(device);
      copy_to_device(source[device], &target[device]);
    }
  }).join();
  check_equal(target[0], 3, "copy to the first device of a thread that has ended");
  check_equal(target[1], 4, "copy to the second device of a thread that has ended");
}

BOOST_AUTO_TEST_SUITE_END()
