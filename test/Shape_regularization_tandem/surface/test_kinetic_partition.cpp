// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// closed_surface() by the kinetic partition of CGAL 6: the same surfaces, whatever CGAL makes of round polygons, and
// nothing that CGAL prints.

#undef NDEBUG

#include "testing/check_closed_surface.h"

#if CGAL_VERSION_NR < 1060000900

int main() { return 77; }

#else

#include <CGAL/Shape_regularization_tandem/Kinetic_partition.h>

#include <iostream>
#include <sstream>

const auto kinetic = np::partition(CGAL::Tandem::Kinetic_partition());

void check_box()
{
  for(const double scale : {std::ldexp(1, -300), 1., std::ldexp(1, 300)}) {
    const Surface box = surface_of_box<Epick>(scale, kinetic.point_map(First<Epick>()));
    CHECK(box.points.size() == 8 && box.faces.size() == 6 && box.number_of_planes == 6);
    if(scale == 1)
      checked_volume(box, "box");
  }
}

// Boxes whose lids are disks around them, far from the origin: the corners of a disk turn by little.
void check_disks()
{
  std::vector<Epick::Point_3> points;
  const auto add = [&](double x, double y, double z) { points.emplace_back(4e5 + x, 5e6 + y, z); };
  for(int i = 0; i < 40; ++i)
    for(int j = 0; j < 40; ++j)
      for(int k = 0; k < 2; ++k) {
        const double a = (i + .5) / 40, b = (j + .5) / 40, angle = 2 * CGAL_PI * a;
        add(k, a, b);
        add(a, k, b);
        add(.5 + b * std::cos(angle), .5 + b * std::sin(angle), k);
      }
  const Found_shapes shapes = CGAL::Tandem::detect_planes(points, np::maximum_distance(.01).minimum_region_size(200));
  const Surface surface = CGAL::Tandem::closed_surface(shapes, points, kinetic);
  CHECK(surface.points.size() == 8 && surface.faces.size() == 6);
  CHECK(std::fabs(checked_volume(surface, "disks") - 1) < 1e-6);
}

void check_streams()
{
  std::ostringstream text;
  std::streambuf* const out = std::cout.rdbuf(text.rdbuf());
  std::streambuf* const errors = std::cerr.rdbuf(text.rdbuf());
  const std::streamsize precision = std::cout.precision(3);
  surface_of_box<Epick>(1, kinetic.point_map(First<Epick>()));
  const std::streamsize precision_after = std::cout.precision(precision);
  std::cout.rdbuf(out);
  std::cerr.rdbuf(errors);
  CHECK(precision_after == 3 && text.str().empty());
}

int main()
{
  check_box();
  check_disks();
  check_streams();
  check_random_scenes(is_sanitized ? 5 : 20, kinetic.maximum_number_of_planes(12));
  return report();
}

#endif
