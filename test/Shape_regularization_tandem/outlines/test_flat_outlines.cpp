// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Outlines of shapes to which no other plane gives a direction: squares have four corners, also those of parallel planes,
// and a circle stays one.

#include "testing/test_support.h"

#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <cmath>
#include <string>

BOOST_AUTO_TEST_SUITE(test_flat_outlines)

using Areas = CGAL::Tandem::Shape_polygons_3<Kernel>;

class Flats {
public:
  // Turned about the vertical axis.
  void add_square(double x, double y, double z, double side, double angle)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    for(double i = 0; i < 100 * side * side; ++i) {
      const double u = side * random.uniform(), v = side * random.uniform();
      put(x + c * u - s * v, y + s * u + c * v, z);
    }
  }

  void add_disk(double x, double y, double z, double radius)
  {
    for(double i = 0; i < 400 * radius * radius; ++i) {
      const double u = 2 * random.uniform() - 1, v = 2 * random.uniform() - 1;
      if(u * u + v * v < 1)
        put(x + radius * u, y + radius * v, z);
    }
  }

  Areas areas() const
  {
    const Shapes shapes = detect(cloud, make_parameters(.03, 200));
    return CGAL::Tandem::polygons(shapes, cloud, CGAL::Tandem::parameters::point_map(First<Kernel>()));
  }

private:
  void put(double x, double y, double z)
  {
    cloud.emplace_back(Kernel::Point_3(x, y, z + .005 * random.gaussian()), Kernel::Vector_3(0, 0, 1));
  }

  scenes::Random random{11};
  Cloud cloud;
};

std::vector<Kernel::Vector_3> edges_of(const Areas& areas, std::size_t s)
{
  CHECK_AT(areas.polygons(s).size() == 1, std::to_string(areas.polygons(s).size()));
  const auto& outer = areas.polygons(s).at(0).outer;
  std::vector<Kernel::Vector_3> result;
  for(std::size_t i = 0; i < outer.size(); ++i)
    result.push_back(areas.points()[outer[(i + 1) % outer.size()]] - areas.points()[outer[i]]);
  return result;
}

// Whether the vectors are parallel or orthogonal.
bool are_regular(const Kernel::Vector_3& a, const Kernel::Vector_3& b)
{
  const double product = std::sqrt(a.squared_length() * b.squared_length());
  return std::fabs(a * b) < 1e-9 * product || std::sqrt(CGAL::cross_product(a, b).squared_length()) < 1e-9 * product;
}

void check_square(const Areas& areas, std::size_t s, const Kernel::Vector_3& direction)
{
  const auto edges = edges_of(areas, s);
  CHECK_AT(edges.size() == 4, std::to_string(edges.size()));
  for(const Kernel::Vector_3& e : edges)
    CHECK(are_regular(e, direction));
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  for(double angle : {0., .2, .7}) {
    Flats one, parallel, apart;
    one.add_square(0, 0, 0, 10, angle);
    const Areas square = one.areas();
    CHECK(square.number_of_entries() == 1);
    const Kernel::Vector_3 first = edges_of(square, 0)[0];
    check_square(square, 0, first);
    CHECK_AT(std::fabs(square.area(0) / 100 - 1) < .03, std::to_string(square.area(0)));
    parallel.add_square(0, 0, 0, 10, angle);
    parallel.add_square(20, 0, 3, 8, angle);
    const Areas two = parallel.areas();
    CHECK(two.number_of_entries() == 2);
    for(std::size_t s = 0; s < 2; ++s)
      check_square(two, s, edges_of(two, 0)[0]); // they have one direction
    apart.add_square(0, 0, 0, 10, angle);
    apart.add_square(30, 0, 3, 8, angle + .5);
    const Areas turned = apart.areas();
    CHECK(turned.number_of_entries() == 2);
    for(std::size_t s = 0; s < 2; ++s)
      check_square(turned, s, edges_of(turned, s)[0]);
  }
  Flats round;
  round.add_disk(0, 0, 0, 4);
  const Areas disk = round.areas();
  CHECK(disk.number_of_entries() == 1);
  const auto edges = edges_of(disk, 0);
  CHECK_AT(edges.size() > 12, std::to_string(edges.size()));
  CHECK_AT(std::fabs(disk.area(0) / (16 * CGAL_PI) - 1) < .04, std::to_string(disk.area(0)));
  std::size_t regular = 0;
  for(const Kernel::Vector_3& e : edges)
    regular += are_regular(e, edges[0]);
  CHECK_AT(regular <= edges.size() / 4, std::to_string(regular));
}

BOOST_AUTO_TEST_SUITE_END()
