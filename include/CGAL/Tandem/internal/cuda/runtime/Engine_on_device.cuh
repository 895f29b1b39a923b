// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the libraries call an engine on a device.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_ENGINE_ON_DEVICE_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_ENGINE_ON_DEVICE_CUH

#include <CGAL/Tandem/internal/cuda/runtime/copy.cuh>
#include <CGAL/Tandem/internal/engine/engine_api.h>

#include <memory>
#include <thread>

namespace CGAL::Tandem::internal {

// Calls f on the current device. Waits for all work that f has queued when f throws, so that no copy reads memory that
// the caller frees.
template <class F>
void run_or_wait(F f)
{
  try {
    f();
  } catch(...) {
    // The exception of f counts, not an error of this wait.
    Loop_queue::of_thread().drop();
    wait_quietly();
    throw;
  }
}

// An engine on the device that is current when it is made. The caller's thread, and its current device, may differ from
// call to call. Buffers are freed on the device that they belong to. Rounds do not wait for their end, but another thread
// that calls next does, since it has another stream.
class Engine_on_device : public Detection_engine {
public:
  // make() returns the engine.
  template <class Make>
  explicit Engine_on_device(Make make) : device_(current_device())
  {
    run_or_wait([&] {
      engine_ = make();
      synchronize();
    });
  }

  ~Engine_on_device() override
  {
    const Device_guard guard(device_, std::nothrow);
    if(thread_ != std::this_thread::get_id())
      static_cast<void>(cudaDeviceSynchronize());
    engine_.reset();
  }

  const char* name() const override { return engine_->name(); }

  bool iterate() override
  {
    bool is_going_on = false;
    on_device([&] {
      is_going_on = engine_->iterate();
      stream_of_thread();
    });
    return is_going_on;
  }

  void finish() override
  {
    on_device([&] {
      engine_->finish();
      synchronize();
    });
  }

  // All tables of a result are memory of the host.
  Engine_result result() override
  {
    Engine_result result;
    on_device([&] {
      result = engine_->result();
      synchronize();
    });
    return result;
  }

private:
  template <class F>
  void on_device(F f)
  {
    const Device_guard guard(device_);
    if(thread_ != std::this_thread::get_id())
      CGAL_TANDEM_CUDA(cudaDeviceSynchronize());
    thread_ = std::this_thread::get_id();
    run_or_wait(f);
  }

  int device_;
  // Of the last call. A thread that has ended has waited, so its id may come again.
  std::thread::id thread_ = std::this_thread::get_id();
  std::unique_ptr<Detection_engine> engine_;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_ENGINE_ON_DEVICE_CUH
