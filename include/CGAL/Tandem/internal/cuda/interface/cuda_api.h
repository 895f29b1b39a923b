// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The border to the CUDA back end: plain data, seen by both compilers. What is
// declared here is in the library tandem_cuda.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_INTERFACE_CUDA_API_H
#define CGAL_TANDEM_INTERNAL_CUDA_INTERFACE_CUDA_API_H

#include <CGAL/Tandem/internal/finish/Engine_result.h>
#include <CGAL/Tandem/internal/cloud/Import.h>

#include <memory>
#include <string>

namespace CGAL {
namespace Tandem {
namespace internal {

class Pinned_pair;
class Values_on_device;

// Sends the caller's values to the current device while they are read. Where there is no device or no memory, they are
// read to the tables, and the engine sends them itself. A device that fails later is an exception, whatever the tag:
// then the values are nowhere else.
class Cuda_upload {
public:
  struct Piece {
    std::size_t size;
    char* values = nullptr;
    Pinned_pair* pair = nullptr;
  };

  void start(Vector_table& coordinates, Vector_table& normals, std::size_t n);
  Piece begin(std::size_t maximum);
  void end(const Piece& piece, std::size_t first);
  std::shared_ptr<Uploaded_values> finish();

private:
  std::shared_ptr<Values_on_device> values_;
};

// Engine<Cuda_backend> on the device that is current when it is made. It may be used
// by one thread at a time, whatever the current device of that is.
class Cuda_engine {
public:
  using Upload = Cuda_upload;

  // The memory of the caller's values will be kept for the next import.
  // Throws std::runtime_error without a device and for failures of it, std::length_error
  // if the device has not enough memory.
  Cuda_engine(Import& in, const Parameters& parameters);

  // What the engines of the host are made of; that of the host has nothing to do.
  template <class Backend>
  Cuda_engine(Backend&, Import& in, const Parameters& parameters) : Cuda_engine(in, parameters)
  {}

  ~Cuda_engine();
  Cuda_engine(const Cuda_engine&) = delete;
  Cuda_engine& operator=(const Cuda_engine&) = delete;

  static const char* name() { return "cuda"; }

  bool iterate();
  void finish();
  double progress() const;
  Engine_result result();

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// Whether the current device can run the kernels of the library.
bool is_cuda_available();
std::string cuda_device_report();
void release_cuda_memory();

// The number of points for which the current device has memory now.
std::size_t cuda_capacity(const Parameters& parameters, bool has_normals);

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_INTERFACE_CUDA_API_H
