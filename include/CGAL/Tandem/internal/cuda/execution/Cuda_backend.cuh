// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The model of Backend on a CUDA device: the current one of the calling thread. Loops of functors are kernels in the
// order of the thread's stream, and return before they end. Loops on the host run on Host_side. Operations are defined
// in Sequential_backend.h.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_CUDA_BACKEND_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_CUDA_BACKEND_CUH

#include <CGAL/Tandem/internal/cuda/runtime/Device_access.cuh>
#include <CGAL/Tandem/internal/cuda/execution/Device_sort_table.cuh>
#include <CGAL/Tandem/internal/cuda/runtime/Host_side.h>
#include <CGAL/Tandem/internal/cuda/execution/cub_calls.cuh>
#include <CGAL/Tandem/internal/cuda/execution/range_sort.cuh>
#include <CGAL/Tandem/internal/cuda/execution/rounds.cuh>

#include <cub/device/device_select.cuh>
#include <thrust/iterator/counting_iterator.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <new>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Used by one thread at a time. Functors are copied to the device with a launch, so they hold pointers to its memory
// only. Memory is released in the order of the stream: buffers may end while kernels that use them still run.
class Cuda_backend {
public:
  template <class T>
  using Buffer = Device_buffer<T>;
  using Sort_table = Device_sort_table;

  // Beside a device the first touch of new pages is what takes longest on the host.
  static constexpr bool keeps_pages = true;

  static const char* name() { return "cuda"; }

  // Tables that the host has changed have to be on the device before the launch: flush().
  template <class F>
  void for_each(std::size_t n, F f)
  {
    if(n == 0)
      return;
    Table_arena::of_thread().flush();
    const std::size_t blocks = (std::min)((n + item_lanes - 1) / item_lanes, std::size_t(1) << 20);
    run_items<<<unsigned(blocks), item_lanes, 0, stream_of_thread()>>>(n, f);
    CGAL_TANDEM_CUDA_LAUNCHED();
  }

  // Loops over tables of the host; functors on the device may run meanwhile.
  template <class F>
  void for_each_on_host(std::size_t n, F f, std::size_t few = 256)
  {
    host_.for_each_on_host(n, f, few);
  }

  template <class Iterator, class Less>
  void sort_on_host(Iterator first, Iterator last, Less less)
  {
    host_.sort_on_host(first, last, less);
  }

  // Scratch in shared memory if it fits there, else in memory of the pool for a bounded number of blocks.
  template <class Scratch, class Body>
  void for_each_cell(std::size_t cells, Body body)
  {
    if(cells == 0)
      return;
    Table_arena::of_thread().flush();
    if constexpr(sizeof(Scratch) <= shared_bytes)
      run_cells<Scratch><<<unsigned(cells), cell_lanes, sizeof(Scratch), stream_of_thread()>>>(
        cells == order_.size() ? order_.data() : nullptr, body);
    else {
      const std::size_t blocks = (std::min)(cells, blocks_in_turns);
      Device_buffer<Scratch> scratch(blocks);
      run_cells_in_turns<Scratch>
        <<<unsigned(blocks), cell_lanes, 0, stream_of_thread()>>>(std::uint32_t(cells), body, scratch.data());
    }
    CGAL_TANDEM_CUDA_LAUNCHED();
  }

  // The order for loops over as many cells as these, whether they are these or others: largest cells first. A loop ends
  // with its slowest block, so the largest should not begin last. Loops where blocks take turns do not use it. Results
  // do not depend on it.
  void expect_cells(const std::vector<Range>& cells)
  {
    std::vector<std::uint64_t> order(cells.size()); // ~size << 32 | cell
    host_.for_each_on_host(cells.size(), [&](std::size_t c) { order[c] = std::uint64_t(~cells[c].size()) << 32 | c; });
    host_.sort_on_host(order.begin(), order.end(), std::less<std::uint64_t>());
    const std::vector<std::uint32_t> cell(order.begin(), order.end()); // the lower halves
    order_.reset(cell.size());
    copy_to_device(cell.data(), cell.size(), order_.data());
  }

  void sort(Sort_table& table) { table.sort(); }

  // Runs, then passes that double their width; keys change between two buffers. Starts in the buffer from which the
  // last pass ends in `key`.
  void sort_ranges(std::uint64_t* key, const Range* range, std::size_t ranges, std::size_t size, std::size_t largest)
  {
    if(ranges == 0)
      return;
    Table_arena::of_thread().flush();
    std::size_t passes = 0;
    while(keys_of_run << passes < largest)
      ++passes;
    Device_buffer<std::uint64_t> other(passes > 0 ? size : 0);
    std::uint64_t* sorted = passes % 2 == 0 ? key : other.data();
    const dim3 runs(unsigned(ranges), unsigned((largest + keys_of_run - 1) / keys_of_run));
    sort_runs<<<runs, run_lanes, 0, stream_of_thread()>>>(range, key, sorted);
    CGAL_TANDEM_CUDA_LAUNCHED();
    for(std::size_t pass = 0; pass < passes; ++pass) {
      std::uint64_t* const merged = sorted == key ? other.data() : key;
      for_each_cell<unsigned char>(ranges, Merge_runs{range, sorted, merged, keys_of_run << pass});
      sorted = merged;
    }
  }

  // Waits, because the host needs the size of the result. The copy to a buffer of that size frees the large one.
  template <class F>
  Buffer<std::uint32_t> compact(std::size_t n, F is_kept)
  {
    Buffer<std::uint32_t> kept(n);
    Buffer<std::int64_t> counter(1);
    select(n, is_kept, kept.data(), counter.data());
    std::int64_t size = 0;
    copy_to_host(counter.data(), 1, &size);
    Buffer<std::uint32_t> result{std::size_t(size)};
    if(size > 0)
      CGAL_TANDEM_CUDA(cudaMemcpyAsync(result.data(), kept.data(), std::size_t(size) * sizeof(std::uint32_t),
                                       cudaMemcpyDeviceToDevice, stream_of_thread()));
    return result;
  }

  // Does not wait.
  template <class Rounds>
  void run_rounds(std::size_t maximum_rounds, std::size_t items, const Rounds& rounds)
  {
    Table_arena::of_thread().flush();
    launch_rounds(maximum_rounds, items, rounds);
  }

  // Most calls have one copy and one wait: as many places are copied as were needed of late. A second copy follows if
  // more items were found, or more than pinned memory holds.
  template <class T, class F>
  Host_buffer<T> collect(std::size_t n, F f)
  {
    // The number of items has to fit into the place of one item.
    static_assert(sizeof(T) >= sizeof(std::int64_t) && std::is_trivially_copyable<T>::value, "plain data");
    constexpr std::size_t few = (std::size_t(128) << 10) / sizeof(T), maximum = Pinned_block::bytes / sizeof(T) - 1;
    if(n == 0)
      return {};
    const std::size_t copied = (std::min)({n, maximum, (std::max)(few, likely_items_)}); // at once, used or not
    Buffer<std::uint32_t> found(n);
    Buffer<std::int64_t> counter(1);
    Buffer<T> buffer(1 + n);
    select(n, Has_item<F>{f}, found.data(), counter.data());
    for_each(n, Take_items<T, F>{f, counter.data(), found.data(), copied, buffer.data()});
    const T* const head = look_at(buffer.data(), 1 + copied);
    std::int64_t size;
    std::memcpy(&size, head, sizeof(size));
    Host_buffer<T> items{std::size_t(size)};
    const std::size_t there = (std::min)(copied, items.size());
    copy_on_host(items.data(), head + 1, there * sizeof(T));
    if(items.size() > there)
      copy_to_host(buffer.data() + 1 + there, items.size() - there, items.data() + there);
    likely_items_ = (std::max)(items.size() + items.size() / 4, likely_items_ / 2);
    return items;
  }

  // Accesses are copies on the device: see Device_access.cuh.
  template <class T, class Allocator>
  Device_read_access<T> read_access(const std::vector<T, Allocator>& table)
  {
    return Device_read_access<T>(table.data(), table.size());
  }

  template <class T>
  Device_write_access<T> read_write_access(std::vector<T>& table)
  {
    return Device_write_access<T>(table, true);
  }

  template <class T>
  Device_write_access<T> write_access(std::vector<T>& table)
  {
    return Device_write_access<T>(table, false);
  }

  // The items are made in pinned memory, and are on their way when this returns. Waits where that is full.
  template <class T, class F>
  Buffer<T> make_buffer(std::size_t n, F f)
  {
    Buffer<T> items(n);
    constexpr std::size_t maximum = Pinned_block::bytes / 2 / sizeof(T);
    for(std::size_t first = 0; first < n; first += maximum) {
      const std::size_t size = (std::min)(maximum, n - first);
      T* const piece = reinterpret_cast<T*>(Staging::of_thread().take(size * sizeof(T)));
      host_.for_each_on_host(size, [&](std::size_t i) { new(piece + i) T(f(first + i)); });
      CGAL_TANDEM_CUDA(
        cudaMemcpyAsync(items.data() + first, piece, size * sizeof(T), cudaMemcpyHostToDevice, stream_of_thread()));
    }
    return items;
  }

  void wait() { synchronize(); }

  // to_host() waits for the items. After from_host() the source may be changed.
  template <class T>
  void to_host(const T* source, std::size_t n, T* target)
  {
    copy_to_host(source, n, target);
  }

  template <class T>
  void from_host(const T* source, std::size_t n, T* target)
  {
    copy_to_device(source, n, target);
  }

  // Atomics work on memory of the device and on shared memory. Their order is relaxed, as in Tbb_backend.
  template <class T>
  __device__ static T atomic_add(T& target, T value)
  {
    return T(atomicAdd(atomic_address(target), value));
  }

  template <class T>
  __device__ static T atomic_min(T& target, T value)
  {
    static_assert(sizeof(T) < sizeof(unsigned long long) || std::is_unsigned<T>::value, "compared without a sign");
    return T(atomicMin(atomic_address(target), value));
  }

  template <class T>
  __device__ static void atomic_max(T& target, T value)
  {
    atomicMax(&target, value);
  }

  // Volatile: the compiler must read memory again, since other lanes may have written it.
  template <class T>
  __device__ static T atomic_load(const T& target)
  {
    return *static_cast<const volatile T*>(&target);
  }

  template <class T>
  __device__ static T atomic_exchange_if(T& target, T expected, T value)
  {
    return T(atomicCAS(atomic_address(target), expected, value));
  }

private:
  Host_side host_;
  std::size_t likely_items_ = 0; // how many the next collect() may find
  Buffer<std::uint32_t> order_;  // cells by falling size: see expect_cells()

  // What a block has on all devices without a further setting, less the shared variables of Cuda_block.
  static constexpr std::size_t shared_bytes = 47 << 10;
  // Bounds the memory of scratches that do not fit there.
  static constexpr std::size_t blocks_in_turns = 512;

  // The i in [0, n) with is_kept(i), ascending, and their number. Both stay on the device, so this does not wait.
  template <class F>
  static void select(std::size_t n, F is_kept, std::uint32_t* kept, std::int64_t* size)
  {
    Table_arena::of_thread().flush();
    const thrust::counting_iterator<std::uint32_t> all(0);
    with_cub_memory([&](void* memory, std::size_t& bytes) {
      return cub::DeviceSelect::If(memory, bytes, all, kept, size, std::int64_t(n), is_kept, stream_of_thread());
    });
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_CUDA_BACKEND_CUH
