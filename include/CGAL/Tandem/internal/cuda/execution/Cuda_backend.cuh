// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The model of Backend on a CUDA device: the current one of the calling thread. Loops of functors are kernels in the
// order of the thread's stream, and return before they end; small ones wait in Loop_queue. Loops on the host run on
// Parallel_host. Operations are defined in Sequential_backend.h.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_CUDA_BACKEND_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_CUDA_BACKEND_CUH

#include <CGAL/Tandem/internal/backend/Parallel_host.h>
#include <CGAL/Tandem/internal/cuda/execution/Device_sort_table.cuh>
#include <CGAL/Tandem/internal/cuda/execution/kernels.cuh>
#include <CGAL/Tandem/internal/cuda/execution/loops.cuh>
#include <CGAL/Tandem/internal/cuda/execution/warp.cuh>
#include <CGAL/Tandem/internal/cuda/runtime/Device_buffer.cuh>
#include <CGAL/Tandem/internal/cuda/runtime/copy.cuh>

#include <cooperative_groups.h>
#include <cub/block/block_merge_sort.cuh>
#include <cub/device/device_select.cuh>
#include <thrust/iterator/counting_iterator.h>

#include <algorithm>
#include <array>
#include <type_traits>

namespace CGAL::Tandem::internal {

// --- Sorts many short ranges of keys, such as the seeds of each cell. Runs of a fixed size are sorted in shared memory,
// then merged by pairs. An own sort, because the segmented sort of CUB waits for the device. Moves keys within their
// ranges only.

// A run has four keys a lane. More lanes than in other kernels, since fewer are slower.
constexpr unsigned run_lanes = 1024;
constexpr unsigned keys_of_lane = 4;
constexpr std::uint32_t keys_of_run = run_lanes * keys_of_lane;

struct Less_key {
  __device__ bool operator()(std::uint64_t a, std::uint64_t b) const { return a < b; }
};

// Sorts one run: blockIdx.x is the range, blockIdx.y the run in it. Blocks beyond the end of a short range have no
// work. Places without a key are filled with the largest number, which sorts to the end. Real keys of that value are
// not lost, since equal keys are the same.
static __global__ void __launch_bounds__(run_lanes)
  sort_runs(const Range* range, const std::uint64_t* from, std::uint64_t* to)
{
  using Sort = cub::BlockMergeSort<std::uint64_t, run_lanes, keys_of_lane>;
  __shared__ typename Sort::TempStorage storage;
  const Range r = range[blockIdx.x];
  const std::uint32_t first = blockIdx.y * keys_of_run;
  if(first >= r.size())
    return;
  const std::uint32_t size = r.size() - first < keys_of_run ? r.size() - first : keys_of_run;
  from += r.first + first;
  to += r.first + first;
  // Neighboring lanes read neighboring keys, for wide loads; the order does not matter before the sort. After the sort,
  // lane t has the keys 4t to 4t + 3 of the run.
  std::uint64_t key[keys_of_lane];
  for(unsigned i = 0; i < keys_of_lane; ++i) {
    const std::uint32_t at = i * run_lanes + threadIdx.x;
    key[i] = at < size ? from[at] : ~std::uint64_t(0);
  }
  Sort(storage).Sort(key, Less_key());
  for(unsigned i = 0; i < keys_of_lane; ++i) {
    const std::uint32_t at = threadIdx.x * keys_of_lane + i;
    if(at < size)
      to[at] = key[i];
  }
}

// A body for each range: merges runs of `width` keys to runs of twice as many. Each key finds its place alone, by a
// binary search in the other run. Places are distinct: equal keys of the first run come before those of the second.
// Takes O(n log n) steps for n keys, without an exchange between lanes.
struct Merge_runs {
  const Range* range; // by body
  // Keys of all ranges, before and after: two different buffers.
  const std::uint64_t* from;
  std::uint64_t* to;
  std::uint32_t width; // of a run, but for the last one of a range

  template <class Block>
  __device__ void operator()(Block& block, unsigned char&, std::uint32_t c) const
  {
    const std::uint64_t* const keys = from + range[c].first;
    std::uint64_t* const merged = to + range[c].first;
    const std::uint32_t size = range[c].size();
    block.for_each(size, [&](std::uint32_t at) {
      const std::uint64_t key = keys[at];
      const std::uint32_t first = at / (2 * width) * (2 * width);
      const std::uint32_t middle = size - first < width ? size : first + width;
      const std::uint32_t last = size - middle < width ? size : middle + width;
      // A run without a second one stays where it is: then the other range is empty.
      const std::uint32_t place =
        at < middle ? partition_point(middle, last, [&](std::uint32_t i) { return keys[i] < key; }) - middle + at
                    : partition_point(first, middle, [&](std::uint32_t i) { return keys[i] <= key; }) - middle + at;
      merged[place] = key;
    });
  }
};

// --- Which items are kept, of few by two loops of the queue, of many by CUB.

// Loops of more items are launched at once: they are worth it.
constexpr std::size_t items_of_queue = 65536;

// The i in [0, n) with is_kept(i), ascending, and their number.
template <class F>
void select_items(std::size_t n, F is_kept, std::uint32_t* kept, std::int64_t* size)
{
  if(n <= items_of_queue) {
    Device_buffer<std::uint32_t> bits((n + warp_size - 1) / warp_size);
    queue_loop(n, n, Test_loop<F>{is_kept, bits.data()});
    queue_loop(n, n, List_loop{bits.data(), kept, size});
  } else {
    const thrust::counting_iterator<std::uint32_t> all(0);
    with_cub_memory([&](void* memory, std::size_t& bytes) {
      return cub::DeviceSelect::If(memory, bytes, all, kept, size, std::int64_t(n), is_kept, stream_of_thread());
    });
  }
}

// Waits for their number, which the device writes to pinned memory.
template <class F>
std::size_t number_selected(std::size_t n, F is_kept, std::uint32_t* kept)
{
  if(n == 0)
    return 0;
  auto* const size = reinterpret_cast<std::int64_t*>(Staging::of_thread().take(sizeof(std::int64_t)));
  select_items(n, is_kept, kept, size);
  synchronize();
  return std::size_t(*size);
}

// --- Rounds of steps in one kernel: launches and waits between the steps would take longer.

// A cooperative launch: all blocks run at the same time, and wait for each other after each step. A barrier also makes
// the writes of a step visible to all blocks. All lanes leave in the same round, since they read the same numbers.
template <class Rounds>
__global__ void __launch_bounds__(item_lanes) run_steps(std::size_t maximum_rounds, const Rounds rounds)
{
  const cooperative_groups::grid_group grid = cooperative_groups::this_grid();
  const std::size_t lanes = std::size_t(gridDim.x) * item_lanes;
  const std::size_t lane = std::size_t(blockIdx.x) * item_lanes + threadIdx.x;
  for(std::size_t round = 0; round < maximum_rounds; ++round)
    for(int step = 0; step < Rounds::steps; ++step) {
      if(step + 1 == Rounds::steps && rounds.is_last(round))
        return;
      rounds.run(step, round, lane, lanes);
      if(gridDim.x == 1)
        __syncthreads(); // takes less time
      else
        grid.sync();
    }
}

// Used by one thread at a time. Functors are copied to the device with a launch, so they hold pointers to its memory
// only. Memory is released in the order of the stream: buffers may end while kernels that use them still run.
class Cuda_backend {
public:
  template <class T>
  using Buffer = Device_buffer<T>;
  using Sort_table = Device_sort_table;

  static const char* name() { return "cuda"; }

  std::size_t concurrency() const { return number_of_multiprocessors() * cell_blocks; }

  // Items that take long are spread over more multiprocessors. Those that take very long are not queued, as others
  // would wait for them with few lanes.
  template <class F>
  void for_each(std::size_t n, F f, std::size_t grain = 4096)
  {
    if(n == 0)
      return;
    const bool is_long = grain < item_lanes;
    if(n <= (is_long ? long_items_of_queue : items_of_queue) && grain >= grain_of_queue)
      return queue_loop(n, is_long ? n * (item_lanes / warp_size) : n, Item_loop<F>{f});
    const std::size_t lanes = grain < item_lanes ? 32 : item_lanes;
    const std::size_t blocks = (std::min)((n + lanes - 1) / lanes, std::size_t(1) << 20);
    run_items<<<unsigned(blocks), unsigned(lanes), 0, stream_of_thread()>>>(n, f);
    CGAL_TANDEM_CUDA_LAUNCHED();
  }

  // Functors on the device may run meanwhile.
  template <class F>
  void for_each_on_host(std::size_t n, F f, std::size_t few = 256)
  {
    host_.for_each_on_host(n, f, few);
  }

  // Scratch in shared memory if it fits there, else in memory of the pool for a bounded number of blocks.
  template <class Scratch, class Body>
  void for_each_cell(std::size_t cells, Body body)
  {
    if(cells == 0)
      return;
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
  void expect_cells(const Buffer<Range>& cells)
  {
    Sort_table order(cells.size());
    for_each(cells.size(), Rank_cells{cells.data(), order.view()});
    sort(order);
    order_.reset(cells.size());
    for_each(cells.size(), Take_indices{order.view(), order_.data()});
  }

  void sort(Sort_table& table, int bits = 63) { table.sort(bits); }

  // Runs, then passes that double their width; keys change between two buffers. Starts in the buffer from which the
  // last pass ends in `key`.
  void sort_ranges(std::uint64_t* key, const Range* range, std::size_t ranges, std::size_t size, std::size_t largest)
  {
    if(ranges == 0)
      return;
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

  // Waits, because the host needs the size of the result. A large buffer is copied to one of that size.
  template <class F>
  Buffer<std::uint32_t> compact(std::size_t n, F is_kept)
  {
    constexpr std::size_t large = std::size_t(1) << 18;
    Buffer<std::uint32_t> kept(n);
    const std::size_t size = number_selected(n, is_kept, kept.data());
    if(n < large) {
      kept.shrink(size);
      return kept;
    }
    Buffer<std::uint32_t> result(size);
    if(size > 0)
      CGAL_TANDEM_CUDA(cudaMemcpyAsync(result.data(), kept.data(), size * sizeof(std::uint32_t),
                                       cudaMemcpyDeviceToDevice, stream_of_thread()));
    return result;
  }

  // Does not wait.
  template <class F>
  Buffer<std::uint32_t> compact(std::size_t n, F is_kept, std::size_t size)
  {
    Buffer<std::uint32_t> kept(size);
    if(size == 0)
      return kept;
    Buffer<std::int64_t> found(1);
    select_items(n, is_kept, kept.data(), found.data());
    return kept;
  }

  template <class T, class F>
  Buffer<T> collect(std::size_t n, F f)
  {
    Buffer<std::uint32_t> found(n);
    Buffer<T> items(number_selected(n, Has_item<F>{f}, found.data()));
    for_each(items.size(), Take_item<T, F>{f, found.data(), items.data()});
    return items;
  }

  // Waits once: the first items, whose number is bounded, are taken and copied before the host knows how many there are.
  template <class T, class F>
  std::vector<T> collect_on_host(std::size_t n, F f, std::size_t grain = 4096)
  {
    static_assert(sizeof(T) % sizeof(std::uint32_t) == 0, "copied in words");
    if(n == 0)
      return {};
    const std::size_t first = (std::min)(n, (std::size_t(256) << 10) / sizeof(T));
    char* const memory = Staging::of_thread().take(sizeof(std::int64_t) + first * sizeof(T));
    auto* const size = reinterpret_cast<std::int64_t*>(memory);
    char* const copy = memory + sizeof(std::int64_t);
    Buffer<std::uint32_t> found(n);
    Buffer<T> items(first);
    Buffer<std::int64_t> number(1);
    select_items(n, Has_item<F>{f}, found.data(), number.data());
    for_each(first, Take_first<T, F>{{f, found.data(), items.data()}, number.data()}, grain);
    const std::size_t words = sizeof(T) / sizeof(std::uint32_t);
    queue_loop(
      first * words, first * words,
      Copy_first_loop{{reinterpret_cast<const std::uint32_t*>(items.data()), reinterpret_cast<std::uint32_t*>(copy)},
                      number.data(),
                      words,
                      size});
    synchronize();
    const std::size_t all = std::size_t(*size), copied = (std::min)(all, first);
    Device_work::of_thread().bytes_copied -= (first - copied) * sizeof(T);
    std::vector<T> result(all);
    std::memcpy(static_cast<void*>(result.data()), copy, copied * sizeof(T));
    if(all > first) {
      items.reset(all - first);
      for_each(all - first, Take_item<T, F>{f, found.data() + first, items.data()}, grain);
      to_host(items.data(), all - first, result.data() + first);
    }
    return result;
  }

  // Each block or warp writes its sums to pinned memory.
  template <int N, class F>
  std::array<std::int64_t, N> sum(std::size_t n, F f)
  {
    std::array<std::int64_t, N> total = {};
    if(n == 0)
      return total;
    const bool is_queued = n <= items_of_sum;
    const std::size_t parts =
      is_queued ? (std::min)((n + warp_size - 1) / warp_size, maximum_loop_blocks * item_lanes / warp_size)
                : (std::min)((n + sum_lanes - 1) / sum_lanes, std::size_t(256));
    auto* const sums = reinterpret_cast<std::int64_t*>(Staging::of_thread().take(parts * N * sizeof(std::int64_t)));
    if(is_queued) {
      std::fill(sums, sums + parts * N, 0); // there may be fewer warps
      queue_loop(n, n, Sum_loop<N, F>{f, sums});
    } else {
      sum_items<N><<<unsigned(parts), sum_lanes, 0, stream_of_thread()>>>(n, f, sums);
      CGAL_TANDEM_CUDA_LAUNCHED();
    }
    synchronize();
    for(std::size_t i = 0; i < parts * N; ++i)
      total[i % N] += sums[i];
    return total;
  }

  // Up to two warps for each item: some take long, some have two parts. But not more blocks than run at the same time,
  // else the barrier would never be passed. It takes hardly longer with more blocks. Does not wait.
  template <class Rounds>
  void run_rounds(std::size_t maximum_rounds, std::size_t items, Rounds rounds)
  {
    const auto kernel = run_steps<Rounds>;
    int blocks = 0; // on a multiprocessor at the same time
    CGAL_TANDEM_CUDA(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, kernel, int(item_lanes), 0));
    const std::size_t maximum = number_of_multiprocessors() * std::size_t(blocks);
    const std::size_t useful = 2 * items / (item_lanes / warp_size) + 1;
    void* arguments[] = {&maximum_rounds, &rounds};
    ++Device_work::of_thread().launches;
    CGAL_TANDEM_CUDA(cudaLaunchCooperativeKernel(kernel, dim3(unsigned((std::min)(maximum, useful))), dim3(item_lanes),
                                                 arguments, 0, stream_of_thread()));
  }

  template <class T, class F>
  Buffer<T> make_buffer(std::size_t n, F f)
  {
    Buffer<T> items(n);
    if(n == 0 || n * sizeof(T) > bytes_of_queue || sizeof(T) % sizeof(std::uint32_t) != 0)
      make_on_device(n, f, items.data());
    else {
      T* const made = reinterpret_cast<T*>(Staging::of_thread().take(n * sizeof(T)));
      host_.for_each_on_host(
        n, [&](std::size_t i) { new(made + i) T(f(i)); }, 4096);
      queue_copy(made, n, items.data());
    }
    return items;
  }

  void wait() { synchronize(); }

  template <class T>
  void to_host(const T* source, std::size_t n, T* target)
  {
    if(n == 0 || n * sizeof(T) > bytes_of_queue || sizeof(T) % sizeof(std::uint32_t) != 0)
      return copy_to_host(source, n, target);
    T* const memory = reinterpret_cast<T*>(Staging::of_thread().take(n * sizeof(T)));
    queue_copy(source, n, memory);
    synchronize();
    std::memcpy(static_cast<void*>(target), memory, n * sizeof(T));
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
  __device__ static void atomic_store(T& target, T value)
  {
    *static_cast<volatile T*>(&target) = value;
  }

  template <class T>
  __device__ static T atomic_exchange_if(T& target, T expected, T value)
  {
    return T(atomicCAS(atomic_address(target), expected, value));
  }

private:
  Parallel_host host_;
  Buffer<std::uint32_t> order_; // cells by falling size: see expect_cells()

  // What a block has on all devices without a further setting, less the shared variables of Cuda_block.
  static constexpr std::size_t shared_bytes = 47 << 10;
  // Loops of more items than these, or copies of more bytes, are not queued.
  static constexpr std::size_t grain_of_queue = 32, long_items_of_queue = 4096, items_of_sum = 16384,
                               bytes_of_queue = std::size_t(64) << 10;
  // Bounds the memory of scratches that do not fit there.
  static constexpr std::size_t blocks_in_turns = 512;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_CUDA_BACKEND_CUH
