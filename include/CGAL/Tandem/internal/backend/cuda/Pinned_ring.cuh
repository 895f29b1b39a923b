// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The way in: host threads fill small pieces of pinned memory, from which they are
// copied while the next ones are filled. Pinned memory is slow to get, so it is kept.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_CUDA_PINNED_RING_CUH
#define CGAL_TANDEM_INTERNAL_BACKEND_CUDA_PINNED_RING_CUH

#include <CGAL/Tandem/internal/backend/cuda/Device_buffer.cuh>

#include <atomic>
#include <exception>
#include <memory>
#include <thread>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Two pieces for one thread: one is filled while the other one is copied.
class Pinned_pair {
public:
  static constexpr std::size_t bytes = 1 << 20;

  Pinned_pair()
  {
    CGAL_TANDEM_CUDA(cudaHostAlloc(&memory_, 2 * bytes, cudaHostAllocPortable));
    for(cudaEvent_t& event : copied_)
      CGAL_TANDEM_CUDA(cudaEventCreateWithFlags(&event, cudaEventDisableTiming));
  }

  ~Pinned_pair()
  {
    for(cudaEvent_t event : copied_)
      static_cast<void>(cudaEventDestroy(event));
    static_cast<void>(cudaFreeHost(memory_));
  }

  Pinned_pair(const Pinned_pair&) = delete;
  Pinned_pair& operator=(const Pinned_pair&) = delete;

  // The memory of the next piece, when its last copy has ended.
  void* next()
  {
    piece_ = 1 - piece_;
    CGAL_TANDEM_CUDA(cudaEventSynchronize(copied_[piece_]));
    return static_cast<char*>(memory_) + piece_ * bytes;
  }

  // Copies the piece that next() has given.
  void copy(void* target, std::size_t size)
  {
    CGAL_TANDEM_CUDA(cudaMemcpyAsync(target, static_cast<char*>(memory_) + piece_ * bytes, size, cudaMemcpyHostToDevice,
                                     stream_of_thread()));
    CGAL_TANDEM_CUDA(cudaEventRecord(copied_[piece_], stream_of_thread()));
  }

private:
  void* memory_ = nullptr;
  cudaEvent_t copied_[2] = {};
  std::size_t piece_ = 0;
};

// The pairs that no thread uses, for the device they were made on.
class Pinned_pairs {
public:
  static std::unique_ptr<Pinned_pair> take(int device)
  {
    {
      std::lock_guard<std::mutex> lock(mutex());
      auto& kept = pairs()[device];
      if(!kept.empty()) {
        std::unique_ptr<Pinned_pair> pair = std::move(kept.back());
        kept.pop_back();
        return pair;
      }
    }
    return std::make_unique<Pinned_pair>();
  }

  static void give_back(int device, std::unique_ptr<Pinned_pair> pair)
  {
    std::lock_guard<std::mutex> lock(mutex());
    pairs()[device].push_back(std::move(pair));
  }

  static void release()
  {
    std::lock_guard<std::mutex> lock(mutex());
    pairs().clear();
  }

private:
  static std::mutex& mutex()
  {
    static std::mutex m;
    return m;
  }

  // Not destroyed at the end of the program, when the runtime may be gone.
  static std::map<int, std::vector<std::unique_ptr<Pinned_pair>>>& pairs()
  {
    static auto& p = *new std::map<int, std::vector<std::unique_ptr<Pinned_pair>>>();
    return p;
  }
};

// Runs work(pair) on several threads, with the device of the caller; throws what one of them has thrown.
template <class Work>
void run_on_host_threads(std::size_t pieces, Work work)
{
  const int device = current_device();
  const std::size_t processors = (std::max)(std::thread::hardware_concurrency(), 1u);
  const std::size_t count = (std::min)({pieces, processors, std::size_t(16)});
  std::vector<std::exception_ptr> errors(count);
  auto run = [&](std::size_t t) {
    try {
      CGAL_TANDEM_CUDA(cudaSetDevice(device));
      std::unique_ptr<Pinned_pair> pair = Pinned_pairs::take(device);
      work(*pair);
      CGAL_TANDEM_CUDA(cudaStreamSynchronize(stream_of_thread()));
      Pinned_pairs::give_back(device, std::move(pair));
    } catch(...) {
      errors[t] = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  for(std::size_t t = 1; t < count; ++t)
    threads.emplace_back(run, t);
  run(0);
  for(std::thread& thread : threads)
    thread.join();
  for(const std::exception_ptr& error : errors)
    if(error)
      std::rethrow_exception(error);
}

// target[i] = make(i) for i in [0, n), where make is a function of the host.
template <class T, class Make>
void fill_from_host(T* target, std::size_t n, Make make)
{
  constexpr std::size_t piece = Pinned_pair::bytes / sizeof(T);
  if(n == 0)
    return;
  CGAL_TANDEM_CUDA(cudaStreamSynchronize(stream_of_thread())); // the target may just have been allocated here
  std::atomic<std::size_t> next(0);
  run_on_host_threads((n + piece - 1) / piece, [&](Pinned_pair& pair) {
    for(std::size_t first; (first = piece * next++) < n;) {
      const std::size_t size = (std::min)(piece, n - first);
      T* items = static_cast<T*>(pair.next());
      for(std::size_t i = 0; i < size; ++i)
        items[i] = make(first + i);
      pair.copy(target + first, size * sizeof(T));
    }
  });
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_CUDA_PINNED_RING_CUH
