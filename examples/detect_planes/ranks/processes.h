// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many processes there are, and which of them reads which file.

#ifndef DETECT_PLANES_PROCESSES_H
#define DETECT_PLANES_PROCESSES_H

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

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

// The rank of each file: consecutive files, with about as many bytes on each rank; the middle of a file decides. So the
// points have the order of the files, as in one process.
inline std::vector<int> share_files(const std::vector<std::uint64_t>& bytes, int ranks)
{
  const double files = double(bytes.size()); // each counts, so that files that are not there are spread, too
  const double total = std::accumulate(bytes.begin(), bytes.end(), files);
  std::vector<int> rank_of;
  double before = 0;
  for(const std::uint64_t n : bytes) {
    const double size = double(n) + 1;
    rank_of.push_back(int((before + size / 2) * ranks / total));
    before += size;
  }
  return rank_of;
}

} // namespace program

#endif // DETECT_PLANES_PROCESSES_H
