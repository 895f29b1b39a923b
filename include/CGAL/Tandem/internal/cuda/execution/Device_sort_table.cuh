// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The table of keys and indices that Cuda_backend sorts: see Host_sort_table. Two separate arrays, as a radix sort on
// the device reads them.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_DEVICE_SORT_TABLE_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_DEVICE_SORT_TABLE_CUH

#include <CGAL/Tandem/internal/cuda/runtime/Device_buffer.cuh>

#include <cub/device/device_merge_sort.cuh>
#include <cub/device/device_radix_sort.cuh>

#include <cstddef>
#include <cstdint>

namespace CGAL::Tandem::internal {

// --- Calls of CUB: temporary memory is of the pool, and work is in the order of the stream of the thread.

// call(memory, bytes) runs twice. With a null pointer it only computes how many bytes it needs. One byte more is
// allocated, since a null pointer would mean the same in the second call.
template <class Call>
void with_cub_memory(Call call)
{
  std::size_t bytes = 0;
  CGAL_TANDEM_CUDA(call(nullptr, bytes));
  Device_buffer<unsigned char> memory(bytes + 1);
  ++Device_work::of_thread().launches;
  CGAL_TANDEM_CUDA(call(memory.data(), bytes));
}

// Sorts pairs by the lower `bits` of their keys, with ties in their former order. The buffers that are current
// afterwards are sorted; the alternate ones have no defined contents.
template <class Key>
void sort_pairs(cub::DoubleBuffer<Key>& keys, cub::DoubleBuffer<std::uint32_t>& values, std::size_t n, int bits)
{
  with_cub_memory([&](void* memory, std::size_t& bytes) {
    return cub::DeviceRadixSort::SortPairs(memory, bytes, keys, values, std::int64_t(n), 0, bits, stream_of_thread());
  });
}

struct Is_less {
  __device__ bool operator()(std::uint64_t a, std::uint64_t b) const { return a < b; }
};

// f.has() as a predicate for CUB.
template <class F>
struct Has_item {
  F f;

  __device__ bool operator()(std::uint32_t i) const { return f.has(i); }
};

template <class T, class F>
struct Take_item {
  F f;
  const std::uint32_t* found;
  T* item;

  __device__ void operator()(std::size_t i) const { item[i] = f.take(found[i]); }
};

// Where only the device knows how many there are.
template <class T, class F>
struct Take_first {
  Take_item<T, F> take;
  const std::int64_t* number;

  __device__ void operator()(std::size_t i) const
  {
    if(i < std::size_t(*number))
      take(i);
  }
};

// --- The table itself.

// Entry i is (key, index). Functors write entries through the view, and read them after sort().
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

  // A view of a constant table may be written, as the one of Host_sort_table.
  View view() const { return {const_cast<std::uint64_t*>(key_.data()), const_cast<std::uint32_t*>(index_.data())}; }
  std::size_t size() const { return key_.size(); }

  // Ascending by key. Needs as much memory again while it runs. Keys have so many bits: it takes time for each. Few keys
  // are merged, which takes fewer kernels.
  void sort(int bits)
  {
    constexpr std::size_t few = 32768;
    if(size() <= few)
      return with_cub_memory([&](void* memory, std::size_t& bytes) {
        return cub::DeviceMergeSort::SortPairs(memory, bytes, key_.data(), index_.data(), std::int64_t(size()),
                                               Is_less(), stream_of_thread());
      });
    Device_buffer<std::uint64_t> other_key(size());
    Device_buffer<std::uint32_t> other_index(size());
    cub::DoubleBuffer<std::uint64_t> keys(key_.data(), other_key.data());
    cub::DoubleBuffer<std::uint32_t> indices(index_.data(), other_index.data());
    sort_pairs(keys, indices, size(), bits);
    // CUB leaves each result in one of the two arrays, depending on the number of passes.
    if(keys.Current() == other_key.data())
      key_.swap(other_key);
    if(indices.Current() == other_index.data())
      index_.swap(other_index);
  }

private:
  Device_buffer<std::uint64_t> key_;
  Device_buffer<std::uint32_t> index_;
};

// Keys for cells by falling size.
struct Rank_cells {
  const Range* cells;
  Device_sort_table::View order;

  __device__ void operator()(std::size_t c) const
  {
    order.set(c, std::uint64_t(0x7fffffffu - cells[c].size()) << 32 | c, std::uint32_t(c));
  }
};

struct Take_indices {
  Device_sort_table::View table;
  std::uint32_t* index;

  __device__ void operator()(std::size_t i) const { index[i] = table.index(i); }
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_DEVICE_SORT_TABLE_CUH
