// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The interface of the library tandem_cuda: plain data and functions that the host compiler and nvcc both accept.
// Defined in tandem_cuda.cu and compiled once, so programs of users need no nvcc.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_INTERFACE_CUDA_API_H
#define CGAL_TANDEM_INTERNAL_CUDA_INTERFACE_CUDA_API_H

#include <CGAL/Tandem/internal/engine/engine_api.h>

#include <cstdint>
#include <memory>
#include <string>

namespace CGAL::Tandem::internal {

class Pinned_pair;
class Values_on_device;

// Sends the caller's values to the current device while the range is read. Without a device, or memory on it, values go
// to the tables of the import, and the engine sends them later. A device that fails in between is an exception for
// every tag: the values are nowhere else.
class Cuda_upload {
public:
  // The same as of No_upload, with the pinned memory that `values` belongs to.
  struct Piece {
    std::size_t size;
    char* values = nullptr;
    Pinned_pair* pair = nullptr;
  };

  // The operations are those of No_upload. Several threads may fill pieces at the same time.
  void start(Vector_table& coordinates, Vector_table& normals, std::size_t n);
  Piece begin(std::size_t maximum);
  void end(const Piece& piece, std::size_t first);
  std::shared_ptr<Uploaded_values> finish();

private:
  std::shared_ptr<Values_on_device> values_;
};

// The engine on the device that is current now. Different threads may use it one after the other, whatever their current
// device is. Throws std::runtime_error without a device and for failures of it, std::length_error if its memory is too
// small. The memory of the caller's values is kept for the next import.
std::unique_ptr<Detection_engine> make_cuda_engine(Import& in, const Parameters& parameters, Progress& progress);

// Whether the current device can run the kernels of the library.
bool is_cuda_available();
// One line: the device, or why there is none.
std::string cuda_device_report();
// Frees memory of host and devices that calls have kept; memory in use stays. For tests, which measure the rest.
void release_cuda_memory();

// What a thread of the host has asked of its devices, for tests; no result depends on it.
// Sums since the thread has begun. What several threads copy together counts for the one that has started them, as one
// wait.
struct Device_work {
  std::uint64_t launches = 0; // kernels, and calls of CUB, which launches several
  std::uint64_t waits = 0;
  std::uint64_t bytes_copied = 0;

  static Device_work& of_thread()
  {
    thread_local Device_work work;
    return work;
  }
};

Device_work cuda_work_of_thread();

// The number of points for which the current device has memory now.
std::size_t cuda_capacity(const Parameters& parameters, bool has_normals);

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_INTERFACE_CUDA_API_H
