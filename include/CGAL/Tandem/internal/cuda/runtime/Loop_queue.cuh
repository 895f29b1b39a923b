// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small loops of a host thread that have not been launched yet. A launch takes longer than most of them, so one kernel
// runs those that follow each other; execution/loops.cuh has it. Whoever uses the stream for something else gets it from
// stream_of_thread(), which launches what is here before.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_LOOP_QUEUE_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_LOOP_QUEUE_CUH

#include <CGAL/Tandem/internal/cuda/runtime/cuda_check.cuh>

#include <cuda.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <type_traits>
#include <utility>

namespace CGAL::Tandem::internal {

// --- The current device of a thread: the runtime has one for each thread, and work goes to it. Changes the current device
// only while a guard exists.

inline int current_device()
{
  int device = 0;
  CGAL_TANDEM_CUDA(cudaGetDevice(&device));
  return device;
}

// Of the current device.
inline std::size_t number_of_multiprocessors()
{
  int multiprocessors = 0;
  CGAL_TANDEM_CUDA(cudaDeviceGetAttribute(&multiprocessors, cudaDevAttrMultiProcessorCount, current_device()));
  return std::size_t(multiprocessors);
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

// What stands before the functor of a loop.
struct Loop_header {
  std::uint64_t function; // its address on the device
  std::uint32_t items;
  std::uint32_t bytes; // to the next loop: of the header and of the functor, which is aligned as the header
};

// The loops of one thread, for one device at a time. They are launched in their order.
class Loop_queue {
public:
  static constexpr std::size_t alignment = 16, maximum_bytes = 3840; // so that they are parameters of a kernel

  // Launches loops of so many bytes; the longest one has work for so many lanes.
  using Launch = void (*)(const unsigned char* loops, std::size_t bytes, std::size_t lanes);

  static Loop_queue& of_thread()
  {
    thread_local Loop_queue queue;
    return queue;
  }

  template <class Loop>
  void add(std::uint64_t function, std::size_t items, std::size_t lanes, const Loop& loop, Launch launch)
  {
    constexpr std::size_t bytes = sizeof(Loop_header) + (sizeof(Loop) + alignment - 1) / alignment * alignment;
    static_assert(std::is_trivially_copyable<Loop>::value && bytes <= maximum_bytes && alignof(Loop) <= alignment,
                  "a functor holds pointers and numbers only");
    const int device = current_device(); // a callback of the caller may use another one meanwhile
    if(bytes_ + bytes > maximum_bytes || device != device_ || launch != launch_)
      this->launch();
    device_ = device;
    const Loop_header header = {function, std::uint32_t(items), std::uint32_t(bytes)};
    std::memcpy(loops_ + bytes_, &header, sizeof(header));
    std::memcpy(loops_ + bytes_ + sizeof(header), static_cast<const void*>(&loop), sizeof(Loop));
    bytes_ += bytes;
    lanes_ = (std::max)(lanes_, lanes);
    launch_ = launch;
  }

  void launch()
  {
    if(bytes_ == 0)
      return;
    const std::size_t bytes = std::exchange(bytes_, 0), lanes = std::exchange(lanes_, 0);
    const Device_guard guard(device_);
    launch_(loops_, bytes, lanes);
  }

  // The same where nothing can be thrown: the next wait does it.
  void launch_quietly() noexcept
  try {
    launch();
  } catch(...) {
    failure_ = std::current_exception();
  }

  void rethrow_failure()
  {
    if(failure_ != nullptr)
      std::rethrow_exception(std::exchange(failure_, nullptr));
  }

  // Forgets the loops, and what has failed, after an exception.
  void drop() noexcept
  {
    bytes_ = lanes_ = 0;
    failure_ = nullptr;
  }

private:
  alignas(alignment) unsigned char loops_[maximum_bytes];
  std::size_t bytes_ = 0, lanes_ = 0;
  int device_ = 0;
  Launch launch_ = nullptr;
  std::exception_ptr failure_;
};

// The stream per thread of the runtime is as fast as own streams, and needs no management. What is queued in it comes
// after all loops before.
inline cudaStream_t stream_of_thread()
{
  Loop_queue::of_thread().launch();
  return cudaStreamPerThread;
}

// Waits until all work that this thread has queued on its current device is done.
inline void wait_for_stream()
{
  ++Device_work::of_thread().waits;
  CGAL_TANDEM_CUDA(cudaStreamSynchronize(stream_of_thread()));
  Loop_queue::of_thread().rethrow_failure();
}

// The same in destructors and after an exception, where nothing else may be thrown.
inline void wait_quietly() noexcept
{
  Loop_queue::of_thread().launch_quietly();
  static_cast<void>(cudaStreamSynchronize(cudaStreamPerThread));
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_LOOP_QUEUE_CUH
