// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Times of the back ends, host to host: one CSV row a run. The first run of a process is cold.
//   cuda_benchmark [BACKEND [RUNS [POINTS...]]]
//   cuda_benchmark BACKEND RUNS CLOUD.ply EPSILON MINIMUM [own]
// BACKEND: cuda (the default), parallel or sequential. Of simulated scans with so many points, or of a cloud, with its
// normals if it has any; own: without them. Coordinates become floats.

#include "hall_scan.h"
#include "clouds/read_ply.h"

#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Shape_regularization_tandem/models/for_each_in_parallel.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string>
#include <utility>

using Kernel = CGAL::Simple_cartesian<float>;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Cloud = std::vector<Point_with_normal>;

// More points are those of several halls of one kind, side by side.
constexpr std::size_t points_of_hall = 100000000;

Cloud scan(std::size_t points)
{
  const CGAL::Tandem::benchmark::Hall_scan hall;
  const std::size_t of_hall = (std::min)(points, points_of_hall);
  Cloud cloud(points);
  CGAL::Tandem::internal::for_each_in_parallel(of_hall, [&](std::size_t i) {
    const auto s = hall(i);
    cloud[i] = {Kernel::Point_3(float(s.position[0]), float(s.position[1]), float(s.position[2])),
                Kernel::Vector_3(float(s.normal[0]), float(s.normal[1]), float(s.normal[2]))};
  });
  CGAL::Tandem::internal::for_each_in_parallel(points - of_hall, [&](std::size_t i) {
    const Point_with_normal& p = cloud[i % of_hall];
    const Kernel::Vector_3 shift(100 * float(1 + i / of_hall), 0, 0);
    cloud[of_hall + i] = {p.first + shift, p.second};
  });
  return cloud;
}

struct Job {
  Cloud cloud;
  double maximum_distance;
  std::size_t minimum_region_size;
  bool has_normals;
};

Job job_of_scan(std::size_t points)
{
  return {scan(points), 0.012, (std::max)(std::size_t(200), (std::min)(points, points_of_hall) / 10000), true};
}

Job job_of_file(const std::string& path, double maximum_distance, std::size_t minimum_region_size, bool uses_normals)
{
  CGAL::Tandem::benchmark::Ply_cloud file = CGAL::Tandem::benchmark::read_ply(path);
  if(!uses_normals)
    file.normals.clear();
  return {CGAL::Tandem::benchmark::points_with_normals<Kernel>(file.points, file.normals), maximum_distance,
          minimum_region_size, file.has_normals()};
}

template <class Tag, class NP>
void time_calls(const Job& job, int runs, const NP& np)
{
  for(int i = 0; i < runs; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const auto shapes = CGAL::Tandem::detect_planes<Tag>(job.cloud, np);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    const auto& s = shapes.statistics();
    std::cout << s.backend << ',' << job.cloud.size() << ',' << i << ',' << wall.count() * 1000;
    for(double t :
        {s.times.sort, s.times.neighbors, s.times.normals, s.times.growth, s.times.regularity, s.times.finish})
      std::cout << ',' << t * 1000;
    std::cout << ',' << s.number_of_rounds << ',' << shapes.number_of_shapes() << ',' << s.coverage << ','
              << double(s.peak_bytes) / double(job.cloud.size()) << ',' << std::hex << shapes.hash() << std::dec
              << std::endl;
  }
}

template <class Tag>
void run_with(const Job& job, int runs)
{
  namespace parameters = CGAL::Tandem::parameters;
  const auto np = parameters::point_map(CGAL::First_of_pair_property_map<Point_with_normal>())
                    .maximum_distance(job.maximum_distance)
                    .minimum_region_size(job.minimum_region_size);
  if(job.has_normals)
    time_calls<Tag>(job, runs, np.normal_map(CGAL::Second_of_pair_property_map<Point_with_normal>()));
  else
    time_calls<Tag>(job, runs, np);
}

void run(const std::string& backend, const Job& job, int runs)
{
  if(backend == "sequential")
    run_with<CGAL::Sequential_tag>(job, runs);
  else if(backend == "parallel")
    run_with<CGAL::Parallel_if_available_tag>(job, runs);
#ifdef CGAL_TANDEM_USE_CUDA
  else
    run_with<CGAL::Tandem::Cuda_tag>(job, runs);
#endif
}

const char* const usage = R"(
cuda_benchmark [cuda|parallel|sequential [RUNS [POINTS...]]]
cuda_benchmark cuda|parallel|sequential RUNS CLOUD.ply EPSILON MINIMUM [own])";

int main(int argc, char** argv)
try {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const std::string backend = !arguments.empty() ? arguments[0] : "cuda";
  if(backend != "cuda" && backend != "parallel" && backend != "sequential")
    throw std::runtime_error("unknown back end " + backend + usage);
  if(backend == "cuda" && !CGAL::Tandem::cuda_available())
    throw std::runtime_error(CGAL::Tandem::cuda_device_report());
  const int runs = arguments.size() > 1 ? std::stoi(arguments[1]) : 3;
  std::cout << "# " << CGAL::Tandem::cuda_device_report() << '\n'
            << "backend,points,run,wall "
               "ms,sort,neighbors,normals,growth,regularity,final,rounds,shapes,coverage,bytes a "
               "point,hash\n";
  if(arguments.size() > 2 && arguments[2].find(".ply") != std::string::npos) {
    const bool is_own = arguments.size() == 6 && arguments[5] == "own";
    if(arguments.size() != 5 && !is_own)
      throw std::runtime_error(std::string("a cloud needs EPSILON and MINIMUM") + usage);
    run(backend, job_of_file(arguments[2], std::stod(arguments[3]), std::stoul(arguments[4]), !is_own), runs);
    return EXIT_SUCCESS;
  }
  std::vector<double> sizes = {1e6, 5.2e6}; // are read as such numbers, too
  if(arguments.size() > 2)
    sizes.clear();
  for(std::size_t i = 2; i < arguments.size(); ++i)
    sizes.push_back(std::stod(arguments[i]));
  for(double size : sizes)
    run(backend, job_of_scan(std::size_t(size)), runs);
} catch(const std::exception& e) {
  std::cerr << "cuda_benchmark: " << e.what() << std::endl;
  return EXIT_FAILURE;
}
