// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole method, instantiated for Cuda_backend and compiled by nvcc: all kernels come from here. Defines what
// interface/cuda_api.h declares.

#pragma nv_diag_suppress 20011, 20014 // the functors of Cuda_backend run on the device only

#include <CGAL/Tandem/internal/cuda/interface/cuda_api.h>
#include <CGAL/Tandem/internal/cuda/runtime/Engine_on_device.cuh>
#include <CGAL/Tandem/internal/cuda/stages/Cuda_stages.cuh>
#include <CGAL/Tandem/internal/engine/Engine.h>
#include <CGAL/Tandem/internal/engine/memory_use.h>

namespace CGAL::Tandem::internal {

namespace {

struct With_backend {
  Cuda_backend backend;
};

// The engine with its back end, which is constructed before it.
struct Cuda_engine : With_backend, Engine<Cuda_backend> {
  Cuda_engine(Import& in, const Parameters& parameters, Progress& progress)
    : Engine<Cuda_backend>(backend, in, parameters, progress)
  {}
};

// The library is compiled with FMA by default: see the manual, "Back Ends and Determinism". On x86-64 processors
// without it, it would end with an illegal instruction.
bool has_fused_multiply_add()
{
#ifdef __FMA__
  return __builtin_cpu_supports("fma");
#else
  return true;
#endif
}

// Why the current device cannot be used; empty if it can. Errors of the runtime are cleared, so that callers do not
// find them later.
std::string missing_for_cuda()
{
  if(!has_fused_multiply_add())
    return "the processor lacks the instruction FMA (see the CMake option TANDEM_CUDA_WITH_FMA)";
  int devices = 0, device = 0, has_pools = 0, is_cooperative = 0;
  cudaFuncAttributes attributes; // of a kernel: the device can run it
  cudaError_t error = cudaGetDeviceCount(&devices);
  if(error == cudaSuccess)
    error = cudaGetDevice(&device);
  if(error == cudaSuccess)
    error = cudaDeviceGetAttribute(&has_pools, cudaDevAttrMemoryPoolsSupported, device);
  if(error == cudaSuccess)
    error = cudaDeviceGetAttribute(&is_cooperative, cudaDevAttrCooperativeLaunch, device);
  std::string missing;
  if(error == cudaErrorInsufficientDriver)
    missing = "there is no NVIDIA driver, or one that is too old for CUDA " + to_text(CUDART_VERSION / 1000) + '.' +
              to_text(CUDART_VERSION % 1000 / 10);
  else if(error != cudaSuccess)
    missing = cudaGetErrorString(error);
  else if(devices == 0)
    missing = "there is none";
  else if(has_pools == 0)
    missing = "the device has no memory pools";
  else if(is_cooperative == 0)
    missing = "the device has no cooperative launches";
  else if(cudaFuncGetAttributes(&attributes, reinterpret_cast<const void*>(&run_items<Clear_interior>)) != cudaSuccess)
    missing = "the library has no code for the device: name its compute capability in CMAKE_CUDA_ARCHITECTURES";
  static_cast<void>(cudaGetLastError());
  return missing;
}

// For Cuda_tag; Cuda_if_available_tag catches the exception and computes on the host.
void check_device()
{
  const std::string missing = missing_for_cuda();
  if(!missing.empty())
    throw std::runtime_error("Cuda_tag: no CUDA device: " + missing + "; use Cuda_if_available_tag, or another tag");
}

// Whether the current device has memory for the tables of the points. If not, an upload returns its values to the host
// first: they take memory of the device as well.
bool fits_on_device(Import& in, const Parameters& parameters)
{
  const auto fits = [&] { return in.size() <= cuda_capacity(parameters, in.has_normals); };
  if(fits())
    return true;
  if(in.uploaded == nullptr)
    return false;
  in.drop_upload();
  synchronize();
  return fits();
}

// Checked before the first round, so that a cloud that is too large fails early, and with a number.
void check_memory(Import& in, const Parameters& parameters)
{
  if(!fits_on_device(in, parameters))
    throw std::length_error("the cloud has " + to_text(in.size()) + " points, the CUDA device has memory for " +
                            to_text(cuda_capacity(parameters, in.has_normals)) +
                            ": use fewer points, a smaller k_neighbors or another tag");
}

} // namespace

// Parameters are not known yet when the range is read, so the default ones are assumed for the memory. An upload that
// takes too much is dropped later.
void Cuda_upload::start(Vector_table& coordinates, Vector_table& normals, std::size_t n)
try {
  const bool has_normals = normals.bytes() != nullptr;
  if(n > 0 && is_cuda_available() && n <= cuda_capacity(Parameters(), has_normals))
    values_ = std::make_shared<Values_on_device>(coordinates, normals, n);
} catch(const std::runtime_error&) { // the engine reports what is wrong with the device
  static_cast<void>(cudaGetLastError());
}

// Without a device the piece has a null pointer, and the import fills its tables.
Cuda_upload::Piece Cuda_upload::begin(std::size_t maximum)
{
  return values_ != nullptr ? values_->begin(maximum) : Piece{maximum};
}

void Cuda_upload::end(const Piece& piece, std::size_t first)
{
  if(values_ != nullptr)
    values_->end(piece, first);
}

// Waits for the copies. Null if nothing was uploaded.
std::shared_ptr<Uploaded_values> Cuda_upload::finish()
{
  if(values_ != nullptr)
    values_->close();
  return std::move(values_);
}

std::unique_ptr<Detection_engine> make_cuda_engine(Import& in, const Parameters& parameters, Progress& progress)
{
  check_device();
  check_memory(in, parameters);
  auto engine =
    std::make_unique<Engine_on_device>([&] { return std::make_unique<Cuda_engine>(in, parameters, progress); });
  in.coordinates.keep_pages();
  in.normals.keep_pages();
  return engine;
}

bool is_cuda_available() { return missing_for_cuda().empty(); }

std::string cuda_device_report()
{
  const std::string missing = missing_for_cuda();
  if(!missing.empty())
    return "no CUDA device: " + missing;
  cudaDeviceProp properties;
  CGAL_TANDEM_CUDA(cudaGetDeviceProperties(&properties, current_device()));
  return std::string(properties.name) + ", " + std::to_string(properties.totalGlobalMem >> 20) +
         " MiB, compute capability " + std::to_string(properties.major) + "." + std::to_string(properties.minor);
}

void release_cuda_memory()
{
  Kept_pages::release();
  Copy_streams::release();
  Pinned_block::release();
  Memory_pools::trim();
}

Device_work cuda_work_of_thread() { return Device_work::of_thread(); }

// Free memory of the device counts, and unused memory of the pool. Tables of cells and shapes have a fixed part; those
// of points have bytes a point: see memory_use.h.
std::size_t cuda_capacity(const Parameters& parameters, bool has_normals)
{
  std::size_t free = 0, total = 0;
  CGAL_TANDEM_CUDA(cudaMemGetInfo(&free, &total));
  std::uint64_t reserved = 0, used = 0;
  const cudaMemPool_t pool = Memory_pools::of_device(current_device());
  CGAL_TANDEM_CUDA(cudaMemPoolGetAttribute(pool, cudaMemPoolAttrReservedMemCurrent, &reserved));
  CGAL_TANDEM_CUDA(cudaMemPoolGetAttribute(pool, cudaMemPoolAttrUsedMemCurrent, &used));
  const std::size_t there = free + std::size_t(reserved - used);
  const std::size_t tables = std::size_t(64) << 20; // of cells and shapes
  return there > tables ? (there - tables) / device_bytes_per_point(parameters, has_normals) : 0;
}

} // namespace CGAL::Tandem::internal
