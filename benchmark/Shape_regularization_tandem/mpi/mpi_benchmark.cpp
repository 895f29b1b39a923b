// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Times, memory and messages of many processes: one CSV row a run, of the slowest and the largest rank.
//   mpirun -n RANKS mpi_benchmark BACKEND strong|tiles POINTS [RUNS]
// BACKEND: mpi (one thread a rank), mpi-parallel or mpi-cuda; sequential, parallel or cuda, without MPI, for one rank.
// strong: a simulated scan of a hall with so many points, of which each rank has a random part. tiles: each rank has a
// hall of its own with so many points, side by side with those of the others.

#include "cuda/hall_scan.h"
#include "testing/measure.h"

#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Shape_regularization_tandem/mpi.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>

#include <boost/mpi/environment.hpp>

#include <array>
#include <cstdlib>
#include <iostream>
#include <string>
#include <utility>

using Kernel = CGAL::Simple_cartesian<float>;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Cloud = std::vector<Point_with_normal>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;
using Stage = CGAL::Tandem::Detection_stage;

constexpr std::size_t number_of_stages = std::size_t(Stage::done) + 1;

// The points [first, last) of a hall that is shifted by so many meters.
Cloud scan(std::size_t first, std::size_t last, float shift)
{
  const CGAL::Tandem::benchmark::Hall_scan hall;
  Cloud cloud;
  for(std::size_t i = first; i < last; ++i) {
    const auto s = hall(i);
    cloud.emplace_back(Kernel::Point_3(float(s.position[0]) + shift, float(s.position[1]), float(s.position[2])),
                       Kernel::Vector_3(float(s.normal[0]), float(s.normal[1]), float(s.normal[2])));
  }
  return cloud;
}

// A sum over the points of a rank, so that sums over ranks do not depend on who has which point.
template <class Shapes>
std::uint64_t hash_of_labels(const Shapes& shapes, std::size_t points, std::size_t first)
{
  std::uint64_t sum = 0;
  for(std::size_t i = 0; i < points; ++i) {
    std::uint64_t h = (first + i) * 0x9e3779b97f4a7c15u + std::uint64_t(shapes.shape_index(i) + 1);
    h = (h ^ (h >> 31)) * 0xbf58476d1ce4e5b9u;
    sum += h ^ (h >> 29);
  }
  return sum;
}

struct Job {
  std::string backend;
  Cloud cloud;
  std::size_t first; // number of the first point of this rank
  int runs;
  double before; // bytes of this process when it had nothing but the points
  std::size_t minimum_region_size;
};

struct Row {
  double wall = 0, memory = 0;                    // seconds, bytes
  std::array<double, number_of_stages> sent = {}; // bytes, by stage
  std::uint64_t hash = 0;
  CGAL::Tandem::Statistics statistics;
};

template <class Tag>
using Traits = CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, Point_map, Normal_map, Tag>;

template <class Tag>
double bytes_sent(const Traits<Tag>&)
{
  return 0;
}

template <class Tag>
double bytes_sent(const Traits<CGAL::Tandem::Mpi_tag<Tag>>& traits)
{
  return double(traits.backend().communicator().bytes_sent());
}

template <class Tag, class NP>
Row detect(const Job& job, const NP& np, const Traits<Tag>& traits)
{
  Row row;
  Stage stage = Stage::sort;
  double sent = bytes_sent(traits);
  const auto count = [&](double fraction) {
    row.sent[std::size_t(stage)] += bytes_sent(traits) - sent;
    sent = bytes_sent(traits);
    stage = CGAL::Tandem::stage_at(fraction);
    return true;
  };
  const auto start = std::chrono::steady_clock::now();
  CGAL::Tandem::Planar_shape_detection_3<Traits<Tag>> detection(job.cloud, np.callback(CGAL::Tandem::Callback(count)),
                                                                traits);
  detection.detect();
  const auto shapes = detection.shapes();
  row.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  row.sent[number_of_stages - 1] += bytes_sent(traits) - sent;
  row.memory = double(CGAL::Tandem::benchmark::status_bytes("VmHWM")) - job.before;
  row.hash = hash_of_labels(shapes, job.cloud.size(), job.first);
  row.statistics = shapes.statistics();
  return row;
}

void print(const Row& row, int ranks, const std::string& backend)
{
  const auto& s = row.statistics;
  const auto& t = s.times;
  std::cout << backend << ',' << ranks << ',' << s.number_of_points << ',' << row.wall;
  for(const double seconds : {t.sort, t.neighbors, t.growth, t.regularity, t.finish})
    std::cout << ',' << seconds;
  std::cout << ',' << row.memory * ranks / double(s.number_of_points);
  for(const double bytes : row.sent)
    std::cout << ',' << bytes / double(s.number_of_points);
  std::cout << ',' << s.number_of_rounds << ',' << s.number_of_shapes << ',' << s.coverage << ',' << std::hex
            << row.hash << std::dec << std::endl;
}

template <class Tag>
void run_with(const Job& job, const boost::mpi::communicator& world)
{
  const Traits<Tag> traits;
  const auto np = CGAL::Tandem::parameters::point_map(Point_map())
                    .normal_map(Normal_map())
                    .maximum_distance(.012)
                    .minimum_region_size(job.minimum_region_size);
  for(int run = 0; run < job.runs; ++run) {
    world.barrier();
    Row row = detect<Tag>(job, np, traits);
    MPI_Allreduce(MPI_IN_PLACE, &row.wall, 2, MPI_DOUBLE, MPI_MAX, world);
    MPI_Allreduce(MPI_IN_PLACE, row.sent.data(), int(row.sent.size()), MPI_DOUBLE, MPI_SUM, world);
    MPI_Allreduce(MPI_IN_PLACE, &row.hash, 1, MPI_UINT64_T, MPI_SUM, world);
    if(world.rank() == 0)
      print(row, world.size(), job.backend);
  }
}

// Whether there is such a back end.
bool run(const Job& job, const boost::mpi::communicator& world)
{
  const std::string& b = job.backend;
  const bool is_alone = world.size() == 1;
  if(b == "mpi")
    run_with<CGAL::Tandem::Mpi_tag<CGAL::Sequential_tag>>(job, world);
  else if(b == "mpi-parallel")
    run_with<CGAL::Tandem::Mpi_tag<CGAL::Parallel_if_available_tag>>(job, world);
  else if(b == "sequential" && is_alone)
    run_with<CGAL::Sequential_tag>(job, world);
  else if(b == "parallel" && is_alone)
    run_with<CGAL::Parallel_if_available_tag>(job, world);
#ifdef CGAL_TANDEM_USE_MPI_CUDA
  else if(b == "mpi-cuda")
    run_with<CGAL::Tandem::Mpi_tag<CGAL::Tandem::Cuda_tag>>(job, world);
  else if(b == "cuda" && is_alone)
    run_with<CGAL::Tandem::Cuda_tag>(job, world);
#endif
  else
    return false;
  return true;
}

int main(int argc, char** argv)
{
  const boost::mpi::environment environment(boost::mpi::threading::funneled);
  const boost::mpi::communicator world;
  const std::string backend = argc > 1 ? argv[1] : "", kind = argc > 2 ? argv[2] : "";
  const std::size_t points = argc > 3 ? std::size_t(std::strtod(argv[3], nullptr)) : 0;
  const std::size_t rank = std::size_t(world.rank()), ranks = std::size_t(world.size());
  const bool are_tiles = kind == "tiles";
  Job job = {};
  job.backend = backend;
  job.first = are_tiles ? points * rank : points * rank / ranks;
  job.runs = argc > 4 ? std::atoi(argv[4]) : 1;
  job.minimum_region_size = (std::max)(std::size_t(200), points / 10000);
  if((are_tiles || kind == "strong") && points > 0) {
    job.cloud = are_tiles ? scan(0, points, 100 * float(rank)) : scan(job.first, points * (rank + 1) / ranks, 0);
    job.before = double(CGAL::Tandem::benchmark::status_bytes("VmRSS"));
    if(rank == 0) {
      std::cout
        << "backend,ranks,points,wall s,sort,neighbors,growth,regularity,final,bytes a point of the largest rank";
      for(const char* stage : {"sort", "neighbors", "normals", "seeds", "rounds", "end game", "result"})
        std::cout << ",sent a point: " << stage;
      std::cout << ",rounds,shapes,coverage,hash" << std::endl;
    }
    if(run(job, world))
      return 0;
  }
  std::cerr << "mpirun -n RANKS mpi_benchmark BACKEND strong|tiles POINTS [RUNS]" << std::endl;
  return 2;
}
