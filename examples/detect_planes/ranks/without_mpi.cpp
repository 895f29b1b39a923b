// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "ranks/Ranks.h"

#include "ranks/launch.h"

#include <string>

namespace program {

bool has_mpi() { return false; }

std::unique_ptr<Ranks> make_ranks(int&, char**&)
{
  const Launch launch = find_launch();
  if(launch.size > 1)
    throw std::runtime_error(std::to_string(launch.size) + " processes were started (" + launch.variable +
                             "), but this program was built without MPI; install MPI and Boost.MPI (Debian: "
                             "libopenmpi-dev libboost-mpi-dev) and build again");
  return std::make_unique<Ranks>();
}

} // namespace program
