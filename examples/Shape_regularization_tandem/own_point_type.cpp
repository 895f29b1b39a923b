// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Detects the planes of points of a type of one's own, through maps that convert on
// the fly: nothing is copied or changed.

#include "scan_of_house.h"

#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Simple_cartesian.h>

#include <iostream>

using Kernel = CGAL::Simple_cartesian<double>;

// A readable property map: four types and a function get().
struct Position_map {
  using key_type = Scan_point;
  using value_type = Kernel::Point_3;
  using reference = value_type;
  using category = boost::readable_property_map_tag;

  friend value_type get(const Position_map&, const Scan_point& p)
  {
    return value_type(.001 * p.position_in_mm[0], .001 * p.position_in_mm[1], .001 * p.position_in_mm[2]);
  }
};

struct Normal_map {
  using key_type = Scan_point;
  using value_type = Kernel::Vector_3;
  using reference = value_type;
  using category = boost::readable_property_map_tag;

  // Normals need not be of unit length, nor oriented.
  friend value_type get(const Normal_map&, const Scan_point& p)
  {
    return value_type(p.normal[0], p.normal[1], p.normal[2]);
  }
};

int main()
{
  const std::vector<Scan_point> scan = scan_of_house();

  const auto shapes = CGAL::Tandem::detect_planes(
    scan, CGAL::Tandem::parameters::point_map(Position_map()).normal_map(Normal_map()).maximum_distance(.05));

  // Shapes refer to points by their positions in the range.
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    const Scan_point& first = scan[shapes.points(s)[0]];
    std::cout << "shape " << s << ": " << shapes.points(s).size() << " points, the first at " << first.position_in_mm[0]
              << ' ' << first.position_in_mm[1] << ' ' << first.position_in_mm[2] << " mm\n";
  }
  return shapes.number_of_shapes() == 13 ? EXIT_SUCCESS : EXIT_FAILURE;
}
