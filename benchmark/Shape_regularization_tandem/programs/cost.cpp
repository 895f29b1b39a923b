// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One detection whose times are instructions, not seconds, so they are the same in each run. Prints them by stage, in
// millions. scripts/cost.sh compiles it and runs it under valgrind's callgrind.
//   cost house|scan|CLOUD.ply DUMP     DUMP: the --callgrind-out-file

#include "clouds/read_ply.h"
#include "cuda/hall_scan.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Shape_regularization_tandem.h>

#include <valgrind/callgrind.h>

#include <chrono>
#include <cstdio>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Clock = std::chrono::steady_clock;
using CGAL::Tandem::benchmark::Ply_cloud;
namespace scenes = CGAL::Tandem::scenes;

static std::string dump_path;

// Replaces that of the standard library, which times the stages. A tick is an instruction since the call before: each
// call ends a dump of callgrind, which has their number. What the clock itself does is not counted.
Clock::time_point Clock::now() noexcept
{
  static int calls = 0;
  static rep instructions = 0;
  CALLGRIND_DUMP_STATS;
  std::ifstream dump(dump_path + "." + std::to_string(++calls));
  std::string word;
  while(dump >> word && word != "summary:") {
  }
  rep since_last_call = 0;
  dump >> since_last_call;
  instructions += since_last_call;
  CALLGRIND_ZERO_STATS;
  return time_point(duration(instructions));
}

static Ply_cloud make_house()
{
  const scenes::Scene scene = scenes::make_scene("house", {100000, .002, .2, false, scenes::Normals::none});
  return {scene.points, scene.normals, scene.label};
}

static Ply_cloud make_scan()
{
  Ply_cloud cloud;
  const CGAL::Tandem::benchmark::Hall_scan scan;
  for(std::uint64_t i = 0; i < 300000; ++i) {
    const auto s = scan(i);
    cloud.points.push_back({s.position[0], s.position[1], s.position[2]});
    cloud.normals.push_back({s.normal[0], s.normal[1], s.normal[2]});
  }
  return cloud;
}

template <class NP>
static void count(const std::vector<Point_with_normal>& points, const NP& np)
{
  CALLGRIND_START_INSTRUMENTATION;
  const Clock::time_point start = Clock::now();
  const auto shapes = CGAL::Tandem::detect_planes<CGAL::Sequential_tag>(points, np);
  const Clock::duration total = Clock::now() - start;
  CALLGRIND_STOP_INSTRUMENTATION;
  const auto print = [](const char* stage, double ticks) { std::printf("%s,%.1f\n", stage, 1e-6 * ticks); };
  const auto print_seconds = [&](const char* stage, double seconds) { print(stage, seconds * Clock::period::den); };
  const CGAL::Tandem::Stage_times& times = shapes.statistics().times;
  print("total", double(total.count()));
  print_seconds("sort", times.sort);
  print_seconds("neighbors", times.neighbors);
  print_seconds("normals", times.normals);
  print_seconds("growth", times.growth);
  print_seconds("regularity", times.regularity);
  print_seconds("finish", times.finish);
}

static void run(const Ply_cloud& cloud, double maximum_distance, std::size_t minimum_region_size)
{
  const auto points = CGAL::Tandem::benchmark::points_with_normals<Kernel>(cloud.points, cloud.normals);
  const auto np = CGAL::Tandem::parameters::point_map(CGAL::First_of_pair_property_map<Point_with_normal>())
                    .maximum_distance(maximum_distance)
                    .minimum_region_size(minimum_region_size);
  if(cloud.has_normals())
    count(points, np.normal_map(CGAL::Second_of_pair_property_map<Point_with_normal>()));
  else
    count(points, np);
}

int main(int argc, char** argv)
try {
  if(argc != 3)
    throw std::invalid_argument("usage: cost house|scan|CLOUD.ply DUMP");
  const std::string name = argv[1];
  dump_path = argv[2];
  if(name == "house")
    run(make_house(), 0.2, 200);
  else if(name == "scan")
    run(make_scan(), 0.012, 200);
  else
    run(CGAL::Tandem::benchmark::read_ply(name), 0.15, 100);
  return 0;
} catch(const std::exception& e) {
  std::fprintf(stderr, "cost: %s\n", e.what());
  return 1;
}
