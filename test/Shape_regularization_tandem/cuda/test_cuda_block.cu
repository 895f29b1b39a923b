// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The searches of a block on the device, which has each cell once in whatever order they begin.

#undef NDEBUG

#include "testing/cuda_device.h"
#include "testing/block_searches.h"

#include <CGAL/Tandem/internal/cuda/execution/Cuda_backend.cuh>

#include <cstdio>

using namespace CGAL::Tandem::internal;

int main()
{
  if(!has_device())
    return exit_skipped;
  std::vector<Range> expected(45); // as many cells as there are, of other sizes
  for(std::uint32_t c = 0; c < expected.size(); ++c)
    expected[c] = {0, c * 7 % 11};
  int failures = 0;
  for(bool is_expected : {false, true})
    for(std::uint32_t start : search_starts)
      for(std::uint32_t most : search_sizes) {
        Cuda_backend cuda;
        if(is_expected)
          cuda.expect_cells(to_buffer(cuda, expected));
        const int wrong = count_wrong_searches(cuda, start, most);
        if(wrong != 0)
          std::fprintf(stderr, "%d searches from %u on for %u items differ\n", wrong, start, most);
        failures += wrong;
      }
  std::printf("%d failures\n", failures);
  return failures != 0;
}
