// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Times of the back ends on simulated scans, host to host: one CSV row a run.
//   cuda_benchmark [BACKEND [RUNS [POINTS...]]]
// BACKEND: cuda (the default), parallel or sequential. The first run of a process is cold.

#include "hall_scan.h"

#include <CGAL/Shape_regularization_tandem.h>

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
  CGAL::Tandem::benchmark::for_each_on_all_processors(of_hall, [&](std::size_t i) {
    const auto s = hall(i);
    cloud[i] = {Kernel::Point_3(float(s.position[0]), float(s.position[1]), float(s.position[2])),
                Kernel::Vector_3(float(s.normal[0]), float(s.normal[1]), float(s.normal[2]))};
  });
  CGAL::Tandem::benchmark::for_each_on_all_processors(points - of_hall, [&](std::size_t i) {
    const Point_with_normal& p = cloud[i % of_hall];
    const Kernel::Vector_3 shift(100 * float(1 + i / of_hall), 0, 0);
    cloud[of_hall + i] = {p.first + shift, p.second};
  });
  return cloud;
}

template <class Tag>
void run(const Cloud& cloud, int runs)
{
  namespace np = CGAL::Tandem::parameters;
  for(int i = 0; i < runs; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const auto shapes = CGAL::Tandem::detect_planes<Tag>(
      cloud, np::point_map(CGAL::First_of_pair_property_map<Point_with_normal>())
               .normal_map(CGAL::Second_of_pair_property_map<Point_with_normal>())
               .maximum_distance(0.012)
               .minimum_region_size((std::max)(std::size_t(200), (std::min)(cloud.size(), points_of_hall) / 10000)));
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    const auto& s = shapes.statistics();
    std::cout << s.backend << ',' << cloud.size() << ',' << i << ',' << wall.count() * 1000;
    for(double t : {s.times.sort, s.times.neighbors, s.times.growth, s.times.regularity, s.times.finish})
      std::cout << ',' << t * 1000;
    std::cout << ',' << s.number_of_rounds << ',' << shapes.number_of_shapes() << ',' << s.coverage << ','
              << double(s.peak_bytes) / double(cloud.size()) << ',' << std::hex << shapes.hash() << std::dec
              << std::endl;
  }
}

int main(int argc, char** argv)
{
  const std::string backend = argc > 1 ? argv[1] : "cuda";
  const int runs = argc > 2 ? std::atoi(argv[2]) : 3;
  std::vector<std::size_t> sizes;
  for(int i = 3; i < argc; ++i)
    sizes.push_back(std::size_t(std::strtod(argv[i], nullptr)));
  if(sizes.empty())
    sizes = {1000000, 5200000};
  std::cout << "# " << CGAL::Tandem::cuda_device_report() << '\n'
            << "backend,points,run,wall ms,sort,neighbors,growth,regularity,final,rounds,shapes,coverage,bytes a "
               "point,hash\n";
  try {
    for(std::size_t size : sizes) {
      const Cloud cloud = scan(size);
      if(backend == "sequential")
        run<CGAL::Sequential_tag>(cloud, runs);
      else if(backend == "parallel")
        run<CGAL::Parallel_if_available_tag>(cloud, runs);
      else
#ifdef CGAL_TANDEM_USE_CUDA
        run<CGAL::Tandem::Cuda_tag>(cloud, runs);
#else
        throw std::runtime_error("built without CUDA");
#endif
    }
  } catch(const std::exception& e) {
    std::cerr << "cuda_benchmark: " << e.what() << std::endl;
    return EXIT_FAILURE;
  }
}
