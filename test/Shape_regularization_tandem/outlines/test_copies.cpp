// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Outlines of points that are there many times, exactly or nearly, and of points in another order.

#include "testing/test_support.h"

#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <algorithm>
#include <cmath>
#include <string>

BOOST_AUTO_TEST_SUITE(test_copies)

using Areas = CGAL::Tandem::Shape_polygons_3<Kernel>;
constexpr double epsilon = .02, width = 4, height = 3;

Areas areas_of(const Shapes& shapes, const Cloud& cloud)
{
  return CGAL::Tandem::polygons(shapes, cloud, CGAL::Tandem::parameters::point_map(First<Kernel>()));
}

// A rectangle, and a wall at its side.
Cloud make_copies(std::size_t places, std::size_t copies, double jitter)
{
  scenes::Random random{3};
  Cloud cloud;
  const auto add = [&](const Kernel::Point_3& place, const Kernel::Vector_3& normal) {
    for(std::size_t i = 0; i < copies; ++i) {
      const Kernel::Vector_3 shift(random.gaussian(), random.gaussian(), random.gaussian());
      cloud.emplace_back(place + jitter * shift, normal);
    }
  };
  for(std::size_t i = 0; i < places; ++i) {
    const double x = width * random.uniform(), y = height * random.uniform(), z = height * random.uniform();
    add({x, y, 0}, {0, 0, 1});
    add({x, 0, z}, {0, -1, 0});
  }
  return cloud;
}

// The same area, whatever the number of copies is: with places that are many times the maximum distance from each other, or less
// than it.
BOOST_AUTO_TEST_CASE(check_copies)
{
  for(std::size_t places : {300, 20000})
    for(std::size_t copies : {1, 8, 50, 200})
      for(double jitter : {0., 1e-6, 1e-3, 4e-3}) {
        if(places > 300 ? copies > 8 || jitter > 1e-6 || is_sanitized : copies > 50 && jitter > 1e-3)
          continue;
        const std::string name = std::to_string(places) + ' ' + std::to_string(copies) + ' ' + std::to_string(jitter);
        const Cloud cloud = make_copies(places, copies, jitter);
        const Shapes shapes = detect(cloud, make_parameters(epsilon, 100 * copies));
        CHECK_AT(shapes.number_of_shapes() == 2, name + ": " + std::to_string(shapes.number_of_shapes()));
        const Areas areas = areas_of(shapes, cloud);
        CHECK_AT(areas.number_of_empty_entries() == 0, name);
        for(std::size_t s = 0; s < areas.number_of_entries(); ++s) {
          CHECK_AT(areas.area(s) > .83 * width * height && areas.area(s) < 1.03 * width * height,
                   name + ": " + std::to_string(areas.area(s)));
          CHECK_AT(areas.polygons(s).size() == 1 && areas.polygons(s)[0].outer.size() < 12, name);
        }
      }
}

// The points of a shape count, not their order.
BOOST_AUTO_TEST_CASE(check_order)
{
  const Cloud cloud = make_copies(2000, 1, .004);
  const Shapes shapes = detect(cloud, make_parameters(epsilon, 100));
  const Areas expected = areas_of(shapes, cloud);
  std::vector<std::size_t> order(cloud.size());
  for(std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::mt19937 random(1);
  for(int run = 0; run < 3; ++run) {
    std::shuffle(order.begin(), order.end(), random);
    Cloud other;
    std::vector<std::int32_t> labels;
    for(std::size_t i : order) {
      other.push_back(cloud[i]);
      labels.push_back(shapes.shape_index(i));
    }
    Shapes::Data data = shapes.data();
    data.shape_of = std::move(labels);
    const Areas areas = areas_of(Shapes(data), other);
    CHECK(areas.points() == expected.points());
    for(std::size_t s = 0; s < expected.number_of_entries(); ++s)
      CHECK(areas.area(s) == expected.area(s));
  }
}

BOOST_AUTO_TEST_SUITE_END()
