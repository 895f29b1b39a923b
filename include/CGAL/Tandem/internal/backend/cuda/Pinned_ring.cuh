// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The way in: host threads fill small pieces of pinned memory, from which they are
// copied while the next ones are filled.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_CUDA_PINNED_RING_CUH
#define CGAL_TANDEM_INTERNAL_BACKEND_CUDA_PINNED_RING_CUH

#include <CGAL/Tandem/internal/backend/cuda/copy.cuh>

#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Two pieces for one thread: one is filled while the other one is copied.
class Pinned_pair {
public:
  static constexpr std::size_t bytes = Pinned_block::bytes / 4;

  // The memory of the next piece, when its last copy has ended.
  void* next()
  {
    piece_ = 1 - piece_;
    copied_[piece_].wait();
    return block_.data() + piece_ * bytes;
  }

  // Copies the piece that next() has given.
  void copy(void* target, std::size_t size)
  {
    CGAL_TANDEM_CUDA(
      cudaMemcpyAsync(target, block_.data() + piece_ * bytes, size, cudaMemcpyHostToDevice, stream_of_thread()));
    copied_[piece_].record();
  }

private:
  Pinned_block block_; // outlives the events, which wait for the copies from it
  Event copied_[2];
  std::size_t piece_ = 0;
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
      Pinned_pair pair;
      work(pair);
      CGAL_TANDEM_CUDA(cudaStreamSynchronize(stream_of_thread()));
    } catch(...) {
      errors[t] = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  try {
    for(std::size_t t = 1; t < count; ++t)
      threads.emplace_back(run, t);
  } catch(const std::system_error&) { // those that there are do all of the work
  }
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
