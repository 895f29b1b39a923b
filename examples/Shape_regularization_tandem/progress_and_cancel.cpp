// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shows the progress of a detection, and cancels another one.
//   progress_and_cancel [CLOUD [maximum_distance]]

#include "house_cloud.h"

#include <CGAL/Shape_regularization_tandem.h>

#include <cstdlib>
#include <functional>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;

int main(int argc, char* argv[])
{
  const std::vector<Point_with_normal> points = example_cloud(argc, argv);
  const auto np = CGAL::Tandem::parameters::point_map(Point_map())
                    .normal_map(Normal_map())
                    .maximum_distance(argc > 2 ? std::atof(argv[2]) : .05);

  // The callback runs on the calling thread, several times a stage, with the progress from 0 to 1.
  double last = 0;
  bool is_monotone = true;
  const std::function<bool(double)> report = [&](double progress) {
    is_monotone = is_monotone && progress >= last;
    last = progress;
    return true;
  };
  const auto all = CGAL::Tandem::detect_planes(points, np.callback(report));
  std::cout << "done: " << all.number_of_shapes() << " shapes, " << all.statistics().number_of_assigned_points
            << " points\n";

  // `false` ends the detection. What was found until then is finished and verified: all guarantees hold for it.
  const std::function<bool(double)> stop = [](double progress) {
    return progress <= CGAL::Tandem::first_progress(CGAL::Tandem::Detection_stage::rounds);
  };
  const auto some = CGAL::Tandem::detect_planes(points, np.callback(stop));
  std::string why;
  const bool is_valid = CGAL::Tandem::is_valid_result(points, some, np, &why);
  std::cout << (some.is_cancelled() ? "cancelled: " : "complete: ") << some.number_of_shapes() << " shapes, "
            << some.statistics().number_of_assigned_points << " points, " << (is_valid ? "valid" : why) << '\n';
  return is_monotone && last == 1 && some.is_cancelled() && is_valid ? EXIT_SUCCESS : EXIT_FAILURE;
}
