// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds what the program, as it is built, or this machine cannot do, before any work.

#ifndef DETECT_PLANES_CHECK_PROGRAM_H
#define DETECT_PLANES_CHECK_PROGRAM_H

#include "Built_with.h"
#include "check_options.h"
#include "detection.h"
#include "mesh/write_mesh.h"
#include "ranks/Ranks.h"

#include <CGAL/Shape_regularization_tandem/cuda.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace program {

// What is not built is bad usage, as a device that is not there is none.
inline void check_backend(const Options& o)
{
  const std::vector<std::string> built = built_with().backends();
  if(std::find(built.begin(), built.end(), o.backend) == built.end())
    throw Usage_error("--backend " + o.backend + " needs " + (o.backend == "cuda" ? "CUDA" : "oneTBB") +
                      ": this program was built without it");
  if(o.backend == "cuda" && !CGAL::Tandem::cuda_available())
    throw std::runtime_error("the back end cuda cannot be used: " + CGAL::Tandem::cuda_device_report() +
                             " (--backend auto takes what there is)");
}

inline void check_program(const Options& o, const Ranks& ranks)
{
  parameters_of(o);
  if(ranks.are_many())
    check_ranks(o);
  check_backend(o);
  if(output_extension(o.output) == ".laz" && !has_laszip)
    throw Usage_error(o.output + ": LAZ needs LASzip; write .las and compress it with laszip, or build Tandem with it");
  if(!o.view.empty() && !has_view)
    throw Usage_error("--view: this program was built without three.js; install libjs-three and build again");
}

} // namespace program

#endif // DETECT_PLANES_CHECK_PROGRAM_H
