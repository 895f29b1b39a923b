// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Many processes with CUDA devices, or with one that they share, have the bits of one process on the host.
//   mpirun -n N test_cuda_ranks

#undef NDEBUG

#include "testing/mpi_support.h"

#include <CGAL/Shape_regularization_tandem/cuda.h>

int main(int argc, char** argv)
{
  const boost::mpi::environment environment(argc, argv, boost::mpi::threading::funneled);
  if(!CGAL::Tandem::cuda_available()) {
    std::cout << "skipped: " << CGAL::Tandem::cuda_device_report() << std::endl;
    return EXIT_SUCCESS; // mpiexec takes other numbers for failures
  }
  const Ranks world;
  const std::size_t shapes = compare_with_one<CGAL::Tandem::Cuda_tag>(world, scene_cases(world, 3)) +
                             compare_with_one<CGAL::Tandem::Cuda_tag>(world, random_cases(1, 12));
  CHECK(sum_over(world, shapes) > 50);
  compare_with_one<CGAL::Tandem::Cuda_tag>(world, border_cases(world, 1));
  return report_on(world);
}
