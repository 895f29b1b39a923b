// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Looks at the shapes after each round of growth and regularization, and writes those
// of the rounds 1, 2, 3 and of the end: round_1.ply, ...
//   step_by_step [CLOUD [maximum_distance]]

#include "house_cloud.h"

#include <CGAL/Point_set_3.h>
#include <CGAL/Point_set_3/IO.h>
#include <CGAL/Shape_regularization_tandem.h>

#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_set = CGAL::Point_set_3<Kernel::Point_3>;

// The class behind detect_planes() needs its traits: the kernel, the range with its maps, and what executes.
using Traits = CGAL::Tandem::Tandem_traits_3<Kernel, Point_set, Point_set::Point_map, Point_set::Vector_map,
                                             CGAL::Parallel_if_available_tag>;
using Detection = CGAL::Tandem::Planar_shape_detection_3<Traits>;

void look(Point_set& points, const Detection::Shapes& shapes, const std::string& name)
{
  std::cout << name << ": " << shapes.number_of_shapes() << " shapes of " << shapes.number_of_parallel_groups()
            << " directions, " << 100 * shapes.statistics().coverage << " %\n";
  CGAL::Tandem::add_shape_property(points, shapes);
  CGAL::IO::write_point_set(name + ".ply", points);
}

int main(int argc, char* argv[])
{
  Point_set points;
  points.add_normal_map();
  for(const auto& [point, normal] : example_cloud(argc, argv))
    points.insert(point, normal);

  Detection detection(points, CGAL::Tandem::parameters::maximum_distance(argc > 2 ? std::atof(argv[2]) : .05));
  for(int round = 1; detection.iterate(); ++round)
    if(round <= 3)
      look(points, detection.shapes(), "round_" + std::to_string(round));

  // Shapes of a round are a view of work in progress. All that is promised holds from here on.
  detection.finish();
  look(points, detection.shapes(), "end");
  return detection.shapes().number_of_shapes() > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
