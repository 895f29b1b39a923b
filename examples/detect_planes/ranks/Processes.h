// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_RANKS_H
#define DETECT_PLANES_RANKS_H

#include "Options.h"
#include "input/read_cloud.h"
#include "messages.h"
#include "output/write_results.h"

#include <cstdlib>
#include <functional>
#include <memory>
#include <numeric>

namespace program {

// --- How many processes there are, and which of them reads which file.

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
inline std::vector<int> share_files(const std::vector<std::uint64_t>& bytes, int processes)
{
  const double files = double(bytes.size()); // each counts, so that files that are not there are spread, too
  const double total = std::accumulate(bytes.begin(), bytes.end(), files);
  std::vector<int> rank_of;
  double before = 0;
  for(const std::uint64_t n : bytes) {
    const double size = double(n) + 1;
    rank_of.push_back(int((before + size / 2) * processes / total));
    before += size;
  }
  return rank_of;
}

// ---

// The notes of an input, with its place among the inputs.
using Placed_notes = std::pair<std::size_t, Input_notes>;

// The processes of a run, each with some of the inputs. This one is alone; make_processes() gives those that mpirun has
// started. All ranks call the same members in the same order.
class Processes {
public:
  virtual ~Processes() = default;

  virtual int rank() const { return 0; }
  virtual int size() const { return 1; }
  bool are_many() const { return size() > 1; }
  bool is_first() const { return rank() == 0; }

  // f(). Then all ranks go on, or throw what the first of those that failed has thrown.
  virtual void together(const std::function<void()>& f) { f(); }

  // The bits that all ranks have.
  virtual unsigned common_bits(unsigned own) const { return own; }

  // The largest number of a rank.
  virtual double largest(double own) const { return own; }

  // The sums of the numbers of all ranks, which have as many.
  virtual std::vector<long long> sums(const std::vector<long long>& own) const { return own; }

  // The number of one rank.
  virtual std::uint64_t number_of(int /* rank */, std::uint64_t own) const { return own; }

  // An exception unless all ranks have the same text.
  virtual void check_same(const std::string& /* own */, const char* /* what */) {}

  // The notes of all ranks on the first one, without what is for outputs only.
  virtual std::vector<Placed_notes> gather(const std::vector<Placed_notes>& own) const { return own; }

  // How many threads this rank may have, if the ranks of a machine share its processors; 0: no limit.
  virtual int threads() const { return 0; }

  // Estimates one distance for the points of all ranks. Only where there are many, as the next one.
  virtual CGAL::Tandem::Distance_estimate estimate_distance(const Point_set& /* own */, Options&) const
  {
    throw std::logic_error("there is one process");
  }

  // The shapes of the points of all ranks.
  virtual Shapes detect(const Point_set& /* own */, const Options&, Progress_line&) const
  {
    throw std::logic_error("there is one process");
  }

  // Reports once why the run ends; the exit code.
  virtual int end(int code, const char* message, const char* advice = "") const { return fail(code, message, advice); }
};

// The processes that mpirun has started. An exception where they cannot work together.
std::unique_ptr<Processes> make_mpi_processes(int& argc, char**& argv, const Launch& launch);

inline std::unique_ptr<Processes> make_processes(int& argc, char**& argv)
{
  const Launch launch = find_launch();
  if(launch.size == 1)
    return std::make_unique<Processes>();
  if constexpr(has_mpi)
    return make_mpi_processes(argc, argv, launch);
  throw_error(launch.size, " processes were started (", launch.variable,
              "), but this program was built without MPI; install MPI and Boost.MPI (Debian: libopenmpi-dev "
              "libboost-mpi-dev) and build again");
}

} // namespace program

#endif // DETECT_PLANES_RANKS_H
