// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The operations of the back end on the device, and the table of links, which all lanes fill at the same time.

#undef NDEBUG

#include "testing/cuda_device.h"
#include "testing/backend_operations.h"
#include "testing/link_sets.h"

#include <CGAL/Tandem/internal/cuda/execution/Cuda_backend.cuh>

#include <cstdio>

using namespace CGAL::Tandem::internal;

int main()
{
  if(!has_device())
    return exit_skipped;
  Cuda_backend cuda;
  std::vector<std::string> wrong = Backend_operations<Cuda_backend>(cuda).run();
  for(const std::string& what : Link_sets<Cuda_backend>(cuda).run())
    wrong.push_back(what);
  for(const std::string& what : wrong)
    std::fprintf(stderr, "wrong: %s\n", what.c_str());
  std::printf("%zu failures\n", wrong.size());
  return !wrong.empty();
}
