// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_CHECK_RANKS_H
#define DETECT_PLANES_CHECK_RANKS_H

#include "Options.h"

#include <string>
#include <utility>

namespace program {

// Finds options that need all points in one process, where there are several. has_cuda: these may use devices.
inline void check_ranks(const Options& o, bool has_cuda)
{
  const std::pair<const char*, std::string> outputs[] = {{"output", o.output}, {"labels", o.labels},
                                                         {"vg", o.vg},         {"polygons", o.polygons},
                                                         {"mesh", o.mesh},     {"view", o.view}};
  for(const auto& [name, path] : outputs)
    if(!path.empty())
      throw Usage_error(
        std::string("--") + name + " needs all points in one process: " +
        (std::string(name) == "output" ? "several write them with --output-directory" : "run it without mpirun"));
  if(o.estimate_normals && *o.estimate_normals != by_library)
    throw Usage_error("--estimate-normals with a number needs all points in one process");
  if(o.backend == "cuda" && !has_cuda)
    throw Usage_error("--backend is 'cuda', which is for one process: this program was built without "
                      "Tandem::tandem_mpi_cuda");
}

} // namespace program

#endif // DETECT_PLANES_CHECK_RANKS_H
