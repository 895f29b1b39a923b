// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_CUDA_DEVICE_LOAN_CUH
#define CGAL_TANDEM_INTERNAL_BACKEND_CUDA_DEVICE_LOAN_CUH

#include <CGAL/Tandem/internal/backend/cuda/Device_buffer.cuh>

#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

inline void synchronize() { CGAL_TANDEM_CUDA(cudaStreamSynchronize(stream_of_thread())); }

template <class T>
void copy_to_device(const T* source, std::size_t n, T* target)
{
  if(n > 0)
    CGAL_TANDEM_CUDA(cudaMemcpyAsync(target, source, n * sizeof(T), cudaMemcpyHostToDevice, stream_of_thread()));
}

template <class T>
void copy_to_host(const T* source, std::size_t n, T* target)
{
  if(n > 0)
    CGAL_TANDEM_CUDA(cudaMemcpyAsync(target, source, n * sizeof(T), cudaMemcpyDeviceToHost, stream_of_thread()));
  synchronize();
}

// A table of the host on the device, to read.
template <class T>
class Device_loan {
public:
  explicit Device_loan(const std::vector<T>& table) : buffer_(table.size())
  {
    copy_to_device(table.data(), table.size(), buffer_.data());
  }

  const T* data() const { return buffer_.data(); }

private:
  Device_buffer<T> buffer_;
};

// To read and write; the host has the changes after take_back().
template <class T>
class Device_loan_out {
public:
  explicit Device_loan_out(std::vector<T>& table) : table_(table), buffer_(table.size())
  {
    copy_to_device(table.data(), table.size(), buffer_.data());
  }

  T* data() { return buffer_.data(); }

  void take_back() { copy_to_host(buffer_.data(), buffer_.size(), table_.data()); }

private:
  std::vector<T>& table_;
  Device_buffer<T> buffer_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_CUDA_DEVICE_LOAN_CUH
