// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Detects planes by many processes: each has a part of the points, and all find the planes of the whole.
//   mpirun -n RANKS detect_planes_by_ranks [CLOUD [maximum_distance]]

#include "house_cloud.h"

#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Shape_regularization_tandem/mpi.h>

#include <boost/mpi/communicator.hpp>
#include <boost/mpi/environment.hpp>

#include <cstdlib>
#include <iostream>

using Point_with_normal = std::pair<house::Kernel::Point_3, house::Kernel::Vector_3>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;

int main(int argc, char* argv[])
{
  const boost::mpi::environment environment(argc, argv, boost::mpi::threading::funneled);
  const boost::mpi::communicator world;

  // Every rank has other points; here, each takes every n-th one. Tiles would be as good.
  const std::vector<Point_with_normal> cloud = example_cloud(argc, argv);
  std::vector<Point_with_normal> points;
  for(std::size_t i = std::size_t(world.rank()); i < cloud.size(); i += std::size_t(world.size()))
    points.push_back(cloud[i]);

  const auto np = CGAL::Tandem::parameters::point_map(Point_map())
                    .normal_map(Normal_map())
                    .maximum_distance(argc > 2 ? std::atof(argv[2]) : .05)
                    .communicator(world);
  const auto shapes = CGAL::Tandem::detect_planes<CGAL::Tandem::Mpi_tag<>>(points, np);

  // Planes and statistics are those of all points, shape_index(i) and points(s) are of the points of this rank.
  const bool is_valid = CGAL::Tandem::is_valid_result(points, shapes, np); // called by all ranks
  if(world.rank() == 0)
    std::cout << shapes.number_of_shapes() << " shapes with " << shapes.statistics().number_of_assigned_points << " of "
              << shapes.statistics().number_of_points << " points\n"
              << (is_valid ? "all guarantees hold\n" : "a guarantee does not hold\n");
  return is_valid ? EXIT_SUCCESS : EXIT_FAILURE;
}
