// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "detection.h"

#include <CGAL/Shape_regularization_tandem/mpi.h>

#include <boost/mpi.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <sched.h>

namespace boost {
namespace serialization {

template <class Archive>
void serialize(Archive& archive, program::Input_notes& notes, unsigned /* version */)
{
  archive& notes.lines& notes.warnings;
}

} // namespace serialization
} // namespace boost

namespace program {

namespace {

namespace mpi = boost::mpi;

class Mpi_processes : public Processes {
public:
  Mpi_processes(int& argc, char**& argv, const Launch& launch)
    : environment(argc, argv, mpi::threading::funneled, false)
  {
    if(world.size() != launch.size)
      throw_error(launch.size, " processes were started (", launch.variable, "), but MPI knows ", world.size(),
                  "; use the mpirun of the MPI that this program was built with");
    first_signal_removes = 1;
  }

  int rank() const override { return world.rank(); }
  int size() const override { return world.size(); }

  // As the library agrees on failures.
  void together(const std::function<void()>& f) override
  try {
    CGAL::Tandem::together(world, f);
  } catch(...) {
    has_agreed = true;
    throw;
  }

  unsigned common_bits(unsigned own) const override
  {
    return mpi::all_reduce(world, own, mpi::bitwise_and<unsigned>());
  }

  double largest(double own) const override { return mpi::all_reduce(world, own, mpi::maximum<double>()); }

  std::vector<long long> sums(const std::vector<long long>& own) const override
  {
    std::vector<long long> all(own.size());
    if(!own.empty())
      mpi::all_reduce(world, own.data(), int(own.size()), all.data(), std::plus<long long>());
    return all;
  }

  std::uint64_t number_of(int rank, std::uint64_t own) const override
  {
    mpi::broadcast(world, own, rank);
    return own;
  }

  void check_same(const std::string& own, const char* what) override
  {
    std::string first = own;
    mpi::broadcast(world, first, 0);
    together([&] {
      if(own != first)
        throw_error<Usage_error>("the processes have different ", what, ", but work on one cloud");
    });
  }

  std::vector<Placed_notes> gather(const std::vector<Placed_notes>& own) const override
  {
    std::vector<std::vector<Placed_notes>> of_ranks;
    mpi::gather(world, own, of_ranks, 0);
    std::vector<Placed_notes> all;
    for(const std::vector<Placed_notes>& notes : of_ranks)
      all.insert(all.end(), notes.begin(), notes.end());
    std::sort(all.begin(), all.end(), [](const Placed_notes& a, const Placed_notes& b) { return a.first < b.first; });
    return all;
  }

  int threads() const override
  {
    MPI_Comm local;
    MPI_Comm_split_type(world, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &local);
    const mpi::communicator machine(local, mpi::comm_take_ownership);
    // A launcher may have bound ranks to some of the processors, the same or others.
    cpu_set_t own, all;
    CPU_ZERO(&own);
    if(sched_getaffinity(0, sizeof own, &own) == 0) {
      MPI_Allreduce(&own, &all, int(sizeof own), MPI_BYTE, MPI_BOR, machine);
      return (std::max)((std::min)(CPU_COUNT(&own), CPU_COUNT(&all) / machine.size()), 1);
    }
    return (std::max)(int(std::thread::hardware_concurrency()) / machine.size(), 1);
  }

  CGAL::Tandem::Distance_estimate estimate_distance(const Point_set& own, Options& o) const override
  {
    return program::estimate_distance<CGAL::Tandem::Mpi_tag<CGAL::Sequential_tag>>(own, o);
  }

  Shapes detect(const Point_set& own, const Options& o, Progress_line& progress) const override
  {
    using CGAL::Tandem::Mpi_tag;
    if constexpr(has_mpi_cuda)
      if(o.backend == "cuda")
        return program::detect<Mpi_tag<CGAL::Tandem::Cuda_tag>>(own, o, progress);
    return o.backend == "sequential" ? program::detect<Mpi_tag<CGAL::Sequential_tag>>(own, o, progress)
                                     : program::detect<Mpi_tag<CGAL::Parallel_if_available_tag>>(own, o, progress);
  }

  // What only this rank knows of ends the others, too.
  int end(int code, const char* message, const char* advice) const override
  {
    if(!has_agreed || is_first())
      fail(code, message, advice);
    if(!has_agreed)
      environment.abort(code);
    world.barrier(); // mpirun may end the others when the first one has ended
    return code;
  }

private:
  mpi::environment environment;
  mpi::communicator world;
  bool has_agreed = false; // on the failure
};

} // namespace

std::unique_ptr<Processes> make_mpi_processes(int& argc, char**& argv, const Launch& launch)
{
  return std::make_unique<Mpi_processes>(argc, argv, launch);
}

} // namespace program
