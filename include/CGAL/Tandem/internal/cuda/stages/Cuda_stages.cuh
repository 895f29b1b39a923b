// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stages that the device replaces, with the signatures that Stage_overrides.h defines. Each returns the same bits
// as the generic form.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_STAGES_CUDA_STAGES_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_STAGES_CUDA_STAGES_CUH

#include <CGAL/Tandem/internal/backend/Stage_overrides.h>
#include <CGAL/Tandem/internal/cuda/neighbors/Cuda_neighbors.cuh>
#include <CGAL/Tandem/internal/cuda/stages/Cuda_tables.cuh>

#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Import and grouping differ for their copies, neighbors for speed. The cells are used to start large ones
// first.
template <>
struct Stage_overrides<Cuda_backend> : No_stage_overrides {
  static constexpr bool imports_points = true, expects_cells = true, finds_neighbors = true, groups_points = true;

  static Device_buffer<Grid_point> import_points(Cuda_backend& backend, Import& in)
  {
    return import_points_cuda(backend, in);
  }

  static void expect_cells(Cuda_backend& backend, const Device_buffer<Range>& cells) { backend.expect_cells(cells); }

  // Rows and scratch are memory of the device; the search has not ended when this returns.
  static void find_neighbors(Cuda_backend&, const Grid_point* point, std::uint32_t n, int k, std::uint32_t* out)
  {
    Device_buffer<unsigned char> scratch(neighbor_scratch_bytes(n));
    find_neighbors_cuda({point, n, k, out}, scratch.data(), stream_of_thread());
  }

  static void group_points(Cuda_backend& backend, Device_buffer<std::int32_t>&& shape_of, std::size_t shapes,
                           Engine_result& result)
  {
    group_points_cuda(backend, std::move(shape_of), shapes, result);
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_STAGES_CUDA_STAGES_CUH
