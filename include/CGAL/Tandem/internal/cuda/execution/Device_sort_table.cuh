// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_DEVICE_SORT_TABLE_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_DEVICE_SORT_TABLE_CUH

#include <CGAL/Tandem/internal/cuda/execution/cub_calls.cuh>

namespace CGAL {
namespace Tandem {
namespace internal {

// The model of Host_sort_table on the device.
class Device_sort_table {
public:
  struct View {
    std::uint64_t* keys;
    std::uint32_t* indices;

    __host__ __device__ std::uint64_t key(std::size_t i) const { return keys[i]; }
    __host__ __device__ std::uint32_t index(std::size_t i) const { return indices[i]; }

    __host__ __device__ void set(std::size_t i, std::uint64_t key, std::uint32_t index) const
    {
      keys[i] = key;
      indices[i] = index;
    }
  };

  explicit Device_sort_table(std::size_t size) : key_(size), index_(size) {}

  View view() const { return {const_cast<std::uint64_t*>(key_.data()), const_cast<std::uint32_t*>(index_.data())}; }
  std::size_t size() const { return key_.size(); }

  void sort()
  {
    Device_buffer<std::uint64_t> other_key(size());
    Device_buffer<std::uint32_t> other_index(size());
    cub::DoubleBuffer<std::uint64_t> keys(key_.data(), other_key.data());
    cub::DoubleBuffer<std::uint32_t> indices(index_.data(), other_index.data());
    sort_pairs(keys, indices, size(), 63);
    if(keys.Current() == other_key.data())
      key_.swap(other_key);
    if(indices.Current() == other_index.data())
      index_.swap(other_index);
  }

private:
  Device_buffer<std::uint64_t> key_;
  Device_buffer<std::uint32_t> index_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_DEVICE_SORT_TABLE_CUH
