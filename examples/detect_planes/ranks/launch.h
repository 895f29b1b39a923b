// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether mpirun, or what does the same, has started several processes of the program: it tells them by variables of the
// environment.

#ifndef DETECT_PLANES_LAUNCH_H
#define DETECT_PLANES_LAUNCH_H

#include <cstdlib>
#include <string>
#include <utility>

namespace program {

struct Launch {
  int size = 1, rank = 0;
  std::string variable; // that tells the size
};

inline int number_in(const char* variable, int otherwise)
{
  const char* text = std::getenv(variable);
  return text != nullptr && *text >= '0' && *text <= '9' ? std::atoi(text) : otherwise;
}

// The variables of Open MPI, of MPICH and its relatives, and of Slurm.
inline Launch find_launch()
{
  const std::pair<const char*, const char*> variables[] = {{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
                                                           {"PMI_SIZE", "PMI_RANK"},
                                                           {"MV2_COMM_WORLD_SIZE", "MV2_COMM_WORLD_RANK"},
                                                           {"SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}};
  for(const auto& [size, rank] : variables)
    if(number_in(size, 0) > 0)
      return {number_in(size, 0), number_in(rank, 0), size};
  return Launch();
}

} // namespace program

#endif // DETECT_PLANES_LAUNCH_H
