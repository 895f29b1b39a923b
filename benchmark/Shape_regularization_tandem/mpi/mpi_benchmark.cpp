// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Times, memory and messages of many processes: one CSV row a run, of the slowest and the largest rank.
//   mpirun -n RANKS mpi_benchmark strong|tiles POINTS [RUNS]
// strong: a simulated scan of a hall with so many points, of which each rank has a random part. tiles: each rank has a
// hall of its own with so many points, side by side with those of the others. One thread a rank; with one rank, the
// rows of the back ends of one process follow.

#include "cuda/hall_scan.h"

#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Shape_regularization_tandem/mpi.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>

#include <boost/mpi/environment.hpp>

#include <array>
#include <cstdlib>
#include <fstream>
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

// What the kernel says of this process, in bytes: "VmHWM" is the largest memory so far.
double memory(const std::string& name)
{
  std::ifstream status("/proc/self/status");
  for(std::string line; std::getline(status, line);)
    if(line.compare(0, name.size() + 1, name + ":") == 0)
      return 1024. * std::strtod(line.c_str() + name.size() + 1, nullptr);
  return 0;
}

struct Row {
  double wall = 0, memory = 0;                    // seconds, bytes
  std::array<double, number_of_stages> sent = {}; // bytes, by stage
  CGAL::Tandem::Statistics statistics;
};

// before: bytes of this process when it had nothing but the points.
template <class Traits, class NP, class Bytes>
Row detect(const Cloud& cloud, const NP& np, const Traits& traits, Bytes bytes_sent, double before)
{
  Row row;
  Stage stage = Stage::sort;
  double sent = bytes_sent();
  const auto count = [&](double share) {
    row.sent[std::size_t(stage)] += bytes_sent() - sent;
    sent = bytes_sent();
    stage = CGAL::Tandem::stage_at(share);
    return true;
  };
  const auto start = std::chrono::steady_clock::now();
  CGAL::Tandem::Planar_shape_detection_3<Traits> detection(cloud, np.callback(CGAL::Tandem::Callback(count)), traits);
  detection.detect();
  const auto shapes = detection.shapes();
  row.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  row.sent[number_of_stages - 1] += bytes_sent() - sent;
  row.memory = memory("VmHWM") - before;
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
  std::cout << ',' << s.number_of_rounds << ',' << s.number_of_shapes << ',' << s.coverage << std::endl;
}

int main(int argc, char** argv)
{
  const boost::mpi::environment environment;
  const boost::mpi::communicator world;
  const std::string kind = argc > 1 ? argv[1] : "";
  const std::size_t points = argc > 2 ? std::size_t(std::strtod(argv[2], nullptr)) : 0;
  const int runs = argc > 3 ? std::atoi(argv[3]) : 1;
  if((kind != "strong" && kind != "tiles") || points == 0) {
    std::cerr << "mpirun -n RANKS mpi_benchmark strong|tiles POINTS [RUNS]" << std::endl;
    return 2;
  }
  const std::size_t rank = std::size_t(world.rank()), ranks = std::size_t(world.size());
  const Cloud cloud =
    kind == "tiles" ? scan(0, points, 100 * float(rank)) : scan(points * rank / ranks, points * (rank + 1) / ranks, 0);
  const double before = memory("VmRSS");
  const auto np = CGAL::Tandem::parameters::point_map(Point_map())
                    .normal_map(Normal_map())
                    .maximum_distance(.012)
                    .minimum_region_size((std::max)(std::size_t(200), points / 10000));
  if(rank == 0)
    std::cout << "backend,ranks,points,wall s,sort,neighbors,growth,regularity,final,bytes a point of the largest rank";
  for(const char* stage : {"sort", "neighbors", "normals", "seeds", "rounds", "end game", "result"})
    if(rank == 0)
      std::cout << ",sent a point: " << stage;
  if(rank == 0)
    std::cout << ",rounds,shapes,coverage" << std::endl;
  for(int run = 0; run < runs; ++run) {
    using Traits =
      CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, Point_map, Normal_map, CGAL::Tandem::Mpi_tag<CGAL::Sequential_tag>>;
    const Traits traits;
    world.barrier();
    Row row = detect(
      cloud, np, traits, [&] { return double(traits.backend().communicator().bytes_sent()); }, before);
    MPI_Allreduce(MPI_IN_PLACE, &row.wall, 2, MPI_DOUBLE, MPI_MAX, world);
    MPI_Allreduce(MPI_IN_PLACE, row.sent.data(), int(row.sent.size()), MPI_DOUBLE, MPI_SUM, world);
    if(rank == 0)
      print(row, int(ranks), "mpi");
  }
  const auto in_one_process = [&](auto tag, const std::string& name) {
    using Traits = CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, Point_map, Normal_map, decltype(tag)>;
    for(int run = 0; run < runs; ++run)
      print(detect(
              cloud, np, Traits(), [] { return 0.; }, before),
            1, name);
  };
  if(ranks == 1) {
    in_one_process(CGAL::Sequential_tag(), "sequential");
    in_one_process(CGAL::Parallel_if_available_tag(), "parallel");
  }
}
