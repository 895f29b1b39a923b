// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_CUDA_DEVICE_LOAN_CUH
#define CGAL_TANDEM_INTERNAL_BACKEND_CUDA_DEVICE_LOAN_CUH

#include <CGAL/Tandem/internal/backend/cuda/copy.cuh>

#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

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

// To write, or to read and write; the host has the changes after take_back().
template <class T>
class Device_loan_out {
public:
  Device_loan_out(std::vector<T>& table, bool is_read) : table_(table), buffer_(table.size())
  {
    if(is_read)
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
