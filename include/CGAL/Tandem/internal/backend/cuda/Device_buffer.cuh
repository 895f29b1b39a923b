// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory of the device, from a pool that stays warm between calls. All work of a
// host thread is on the stream of that thread, so threads do not wait for each other.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_CUDA_DEVICE_BUFFER_CUH
#define CGAL_TANDEM_INTERNAL_BACKEND_CUDA_DEVICE_BUFFER_CUH

#include <CGAL/Tandem/internal/backend/cuda/cuda_check.cuh>

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

inline cudaStream_t stream_of_thread() { return cudaStreamPerThread; }

inline int current_device()
{
  int device = 0;
  CGAL_TANDEM_CUDA(cudaGetDevice(&device));
  return device;
}

// Makes a device the current one for a while.
class Device_guard {
public:
  explicit Device_guard(int device) : device_(device), before_(current_device())
  {
    if(device != before_)
      CGAL_TANDEM_CUDA(cudaSetDevice(device));
  }

  ~Device_guard()
  {
    if(device_ != before_) // the call alone makes a context
      static_cast<void>(cudaSetDevice(before_));
  }

  Device_guard(const Device_guard&) = delete;
  Device_guard& operator=(const Device_guard&) = delete;

private:
  int device_, before_;
};

// The pools of the devices, made when they are used first.
class Memory_pools {
public:
  static cudaMemPool_t of_device(int device)
  {
    std::lock_guard<std::mutex> lock(mutex());
    const auto found = pools().find(device);
    return found != pools().end() ? found->second : pools()[device] = make(device);
  }

  // Gives back what is not in use.
  static void trim()
  {
    std::lock_guard<std::mutex> lock(mutex());
    for(const auto& pool : pools())
      CGAL_TANDEM_CUDA(cudaMemPoolTrimTo(pool.second, 0));
  }

private:
  static cudaMemPool_t make(int device)
  {
    cudaMemPoolProps properties = {};
    properties.allocType = cudaMemAllocationTypePinned;
    properties.handleTypes = cudaMemHandleTypeNone;
    properties.location.type = cudaMemLocationTypeDevice;
    properties.location.id = device;
    cudaMemPool_t pool;
    CGAL_TANDEM_CUDA(cudaMemPoolCreate(&pool, &properties));
    std::uint64_t keep = ~std::uint64_t(0);
    CGAL_TANDEM_CUDA(cudaMemPoolSetAttribute(pool, cudaMemPoolAttrReleaseThreshold, &keep));
    return pool;
  }

  static std::mutex& mutex()
  {
    static std::mutex m;
    return m;
  }

  static std::map<int, cudaMemPool_t>& pools()
  {
    static std::map<int, cudaMemPool_t> p;
    return p;
  }
};

// An array on the device that is not initialized. The interface of Host_buffer,
// but for the access to single items.
template <class T>
class Device_buffer {
  static_assert(std::is_trivially_destructible<T>::value, "buffers hold plain data");

public:
  Device_buffer() = default;
  explicit Device_buffer(std::size_t size) { allocate(size); }
  Device_buffer(Device_buffer&& other) noexcept { swap(other); }

  Device_buffer& operator=(Device_buffer&& other) noexcept
  {
    Device_buffer(std::move(other)).swap(*this);
    return *this;
  }

  ~Device_buffer() { release(); }

  // Discards the contents.
  void reset(std::size_t size)
  {
    release();
    allocate(size);
  }

  void release()
  {
    if(data_ != nullptr)
      static_cast<void>(cudaFreeAsync(data_, stream_of_thread())); // an error has been reported elsewhere
    data_ = nullptr;
    size_ = 0;
  }

  void swap(Device_buffer& other) noexcept
  {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }

  T* data() { return data_; }
  const T* data() const { return data_; }
  std::size_t size() const { return size_; }

private:
  void allocate(std::size_t size)
  {
    void* memory = nullptr;
    if(size > 0)
      CGAL_TANDEM_CUDA(cudaMallocFromPoolAsync(&memory, size * sizeof(T), Memory_pools::of_device(current_device()),
                                               stream_of_thread()));
    data_ = static_cast<T*>(memory);
    size_ = size;
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_CUDA_DEVICE_BUFFER_CUH
