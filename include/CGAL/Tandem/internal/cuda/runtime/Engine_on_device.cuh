// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the libraries call an engine on a device.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_ENGINE_ON_DEVICE_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_ENGINE_ON_DEVICE_CUH

#include <CGAL/Tandem/internal/cuda/runtime/copy.cuh>
#include <CGAL/Tandem/internal/engine/engine_api.h>

#include <memory>

namespace CGAL::Tandem::internal {

// Calls f on the current device. Waits for all work that f has queued, also when f throws. So another
// thread, with another stream, may call next, and no copy reads memory that the caller frees.
template <class F>
void run_and_wait(F f)
{
  try {
    f();
    synchronize();
  } catch(...) {
    // The exception of f counts, not an error of this wait.
    Loop_queue::of_thread().drop();
    wait_quietly();
    throw;
  }
}

// An engine on the device that is current when it is made. The caller's thread, and its current device, may differ from
// call to call. Buffers are freed on the device that they belong to.
class Engine_on_device : public Detection_engine {
public:
  // make() returns the engine.
  template <class Make>
  explicit Engine_on_device(Make make) : device_(current_device())
  {
    run_and_wait([&] { engine_ = make(); });
  }

  ~Engine_on_device() override
  {
    const Device_guard guard(device_, std::nothrow);
    engine_.reset();
  }

  const char* name() const override { return engine_->name(); }

  bool iterate() override
  {
    bool is_going_on = false;
    on_device([&] { is_going_on = engine_->iterate(); });
    return is_going_on;
  }

  void finish() override
  {
    on_device([&] { engine_->finish(); });
  }

  // All tables of a result are memory of the host.
  Engine_result result() override
  {
    Engine_result result;
    on_device([&] { result = engine_->result(); });
    return result;
  }

private:
  template <class F>
  void on_device(F f)
  {
    const Device_guard guard(device_);
    run_and_wait(f);
  }

  int device_;
  std::unique_ptr<Detection_engine> engine_;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_ENGINE_ON_DEVICE_CUH
