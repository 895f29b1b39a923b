// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cloud of the examples: a file or, where none is given, a generated house
// with a garage beside it: 13 faces, 15 by 7 by 7.5 meters, as a scanner would see them.
// As in real houses nothing is quite right: each face is tilted by up to 0.1 degrees, and
// the walls of house and garage that should be flush are 5 millimeters apart.

#ifndef TANDEM_EXAMPLES_HOUSE_CLOUD_H
#define TANDEM_EXAMPLES_HOUSE_CLOUD_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/read_points.h>
#include <CGAL/property_map.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace house {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;

// A parallelogram or half of one, and the wall, roof or floor that it is a part of.
struct Part {
  int face;
  Kernel::Point_3 corner;
  Kernel::Vector_3 side, other_side;
  bool is_triangle;
};

inline std::vector<Part> parts()
{
  using P = Kernel::Point_3;
  using V = Kernel::Vector_3;
  return {{0, P(0, 0, 0), V(10, 0, 0), V(0, 0, 5), false}, // the house: south, north, west, east
          {1, P(10, 7, 0), V(-10, 0, 0), V(0, 0, 5), false},
          {2, P(0, 7, 0), V(0, -7, 0), V(0, 0, 5), false},
          {2, P(0, 3.5, 7.5), V(0, 3.5, -2.5), V(0, -3.5, -2.5), true},
          {3, P(10, 0, 0), V(0, 7, 0), V(0, 0, 5), false},
          {3, P(10, 3.5, 7.5), V(0, -3.5, -2.5), V(0, 3.5, -2.5), true},
          {4, P(0, 0, 5), V(10, 0, 0), V(0, 3.5, 2.5), false}, // its roof and its floor
          {5, P(10, 7, 5), V(-10, 0, 0), V(0, -3.5, 2.5), false},
          {6, P(0, 0, 0), V(0, 7, 0), V(10, 0, 0), false},
          {7, P(11, .005, .02), V(4, 0, 0), V(0, 0, 3), false}, // the garage: south, north, west, east
          {8, P(15, 4, .02), V(-4, 0, 0), V(0, 0, 3), false},
          {9, P(11, 4, .02), V(0, -3.995, 0), V(0, 0, 3), false},
          {10, P(15, .005, .02), V(0, 3.995, 0), V(0, 0, 3), false},
          {11, P(11, .005, 3.02), V(4, 0, 0), V(0, 3.995, 0), false}, // its roof and its floor
          {12, P(11, .005, .02), V(0, 3.995, 0), V(4, 0, 0), false}};
}

// The sequence of std::mt19937 is the same everywhere; that of the distributions is not.
inline double random_unit(std::mt19937& random) { return double(random() >> 8) / double(1 << 24); }

// Four summands are close to a Gaussian.
inline double random_noise(std::mt19937& random, double deviation)
{
  double sum = -2;
  for(int i = 0; i < 4; ++i)
    sum += random_unit(random);
  return deviation * 1.7320508 * sum;
}

// Turned, so that no wall is parallel to an axis, and on a grid of 0.1 mm as scanners write it.
inline Kernel::Point_3 turned(const Kernel::Point_3& p)
{
  const auto rounded = [](double x) { return std::round(x * 1e4) / 1e4; };
  return Kernel::Point_3(rounded(.8 * p.x() - .6 * p.y()), rounded(.6 * p.x() + .8 * p.y()), rounded(p.z()));
}

inline std::vector<Point_with_normal> make_cloud(double points_a_square_meter = 100, double noise = .01)
{
  std::mt19937 random(2016);
  double tilt[13][2];
  for(auto& face : tilt)
    for(double& slope : face)
      slope = .00175 * (2 * random_unit(random) - 1); // .00175 is the tangent of 0.1 degrees
  std::vector<Point_with_normal> points;
  for(const Part& part : parts()) {
    const Kernel::Vector_3 scaled = CGAL::cross_product(part.side, part.other_side);
    const double area = std::sqrt(scaled.squared_length());
    const Kernel::Vector_3 normal = scaled / area;
    const auto n = std::size_t(area * points_a_square_meter / (part.is_triangle ? 2 : 1));
    for(std::size_t i = 0; i < n; ++i) {
      double s = random_unit(random), t = random_unit(random);
      if(part.is_triangle && s + t > 1)
        s = 1 - s, t = 1 - t;
      const Kernel::Vector_3 from_middle = (s - .5) * part.side + (t - .5) * part.other_side;
      const double height = tilt[part.face][0] * (from_middle.x() + from_middle.y()) +
                            tilt[part.face][1] * from_middle.z() + random_noise(random, noise);
      const Kernel::Vector_3 blur(random_noise(random, .05), random_noise(random, .05), random_noise(random, .05));
      const Kernel::Point_3 p = part.corner + s * part.side + t * part.other_side + height * normal;
      const Kernel::Point_3 tip = CGAL::ORIGIN + normal + blur;
      points.emplace_back(turned(p), turned(tip) - CGAL::ORIGIN);
    }
  }
  return points;
}

} // namespace house

// The points of the file that is the first argument, or of the house.
inline std::vector<house::Point_with_normal> example_cloud(int argc, char* argv[])
{
  if(argc < 2)
    return house::make_cloud();
  std::vector<house::Point_with_normal> points;
  if(!CGAL::IO::read_points(argv[1], std::back_inserter(points),
                            CGAL::parameters::point_map(CGAL::First_of_pair_property_map<house::Point_with_normal>())
                              .normal_map(CGAL::Second_of_pair_property_map<house::Point_with_normal>())))
    throw std::runtime_error(std::string(argv[1]) + ": cannot be read");
  return points;
}

#endif // TANDEM_EXAMPLES_HOUSE_CLOUD_H
