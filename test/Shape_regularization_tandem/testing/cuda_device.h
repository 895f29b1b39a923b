// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// For tests that are compiled for a device themselves.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CUDA_DEVICE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CUDA_DEVICE_H

#include <cuda_runtime.h>

#include <cstdio>

// Exit code of a test that cannot run here.
constexpr int exit_skipped = 77;

inline bool has_device()
{
  int devices = 0;
  if(cudaGetDeviceCount(&devices) == cudaSuccess && devices > 0)
    return true;
  std::printf("skipped: no CUDA device\n");
  return false;
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CUDA_DEVICE_H
