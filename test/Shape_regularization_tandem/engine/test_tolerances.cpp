// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tolerances of points: each point is within its own, a constant one is that of the detection bit for bit, a depth
// camera gets the planes of its scene, and points without a tolerance have no shape. Bounds: a maximum_distance above
// all of them, infinite, tiny and no valid ones.

#include "testing/tolerances.h"

#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>

#include <boost/property_map/function_property_map.hpp>

#include <limits>
#include <map>
#include <set>

BOOST_AUTO_TEST_SUITE(test_tolerances)

using Limits = std::numeric_limits<double>;

const std::size_t least = 40;

struct Leveled_cloud {
  Cloud cloud;
  std::vector<double> tolerance;

  // One for each item, by its place in the cloud.
  auto map() const
  {
    return boost::make_function_property_map<Cloud::value_type>(
      [this](const Cloud::value_type& item) { return tolerance[std::size_t(&item - cloud.data())]; });
  }
  template <class Tag>
  Shapes detect_with(const Parameters& p, Given given) const
  {
    return detect_with_tolerances<Tag>(cloud, p, map(), given);
  }
  std::string violation(const Shapes& shapes, Given given = Given::normals) const
  {
    return violation_with_tolerances(cloud, shapes, map(), given);
  }

  // The result is valid, each point is within its own tolerance, and neither threads nor the order of points matter.
  Shapes detect(const std::string& name, const Parameters& p, Given given = Given::normals) const
  {
    const Shapes shapes = detect_with<CGAL::Sequential_tag>(p, given);
    check_equal(violation(shapes, given), "", name);
    check_same(detect_with<CGAL::Parallel_if_available_tag>(p, given), shapes, name + ", parallel");
    Leveled_cloud reversed;
    reversed.cloud.assign(cloud.rbegin(), cloud.rend());
    reversed.tolerance.assign(tolerance.rbegin(), tolerance.rend());
    const Shapes of_reversed = reversed.detect_with<CGAL::Sequential_tag>(p, given);
    check_same_planes(of_reversed, shapes, name + ", reversed");
    for(std::size_t i = 0; i < cloud.size(); ++i) {
      const int s = shapes.shape_index(i);
      CHECK_AT(of_reversed.shape_index(cloud.size() - 1 - i) == s, name + ", reversed: point " + std::to_string(i));
      if(s < 0)
        continue;
      const auto& c = shapes.coefficients(std::size_t(s));
      const double distance = Kernel::Vector_3(c[0], c[1], c[2]) * (cloud[i].first - CGAL::ORIGIN) + c[3];
      CHECK_AT(std::fabs(distance) <= (std::min)(tolerance[i], shapes.parameters().maximum_distance) + 1e-12,
               name + ": point " + std::to_string(i));
    }
    return shapes;
  }

  Leveled_cloud bounded(double most) const
  {
    Leveled_cloud result = *this;
    for(double& t : result.tolerance)
      t = (std::min)(t, most);
    return result;
  }
};

// Tolerances of a house between .015 and .045, by place.
Leveled_cloud make_leveled(std::size_t points)
{
  Leveled_cloud c;
  c.cloud = to_cloud(scenes::make_scene("house", scene_options(points, .0005, .02)));
  for(const auto& item : c.cloud)
    c.tolerance.push_back(.03 + .015 * std::sin(3 * item.first.x() + 2 * item.first.y() + item.first.z()));
  return c;
}

BOOST_AUTO_TEST_CASE(test_constant_tolerance)
{
  Leveled_cloud c = make_leveled(6000);
  const Parameters parameters = make_parameters(.04, least);
  Parameters estimated = parameters;
  estimated.maximum_distance = 0;
  for(const Given given : {Given::normals, Given::nothing}) {
    const Shapes expected = detect(c.cloud, parameters, given);
    CHECK(expected.number_of_shapes() > 4);
    for(const double tolerance : {.04, 1., HUGE_VAL}) {
      c.tolerance.assign(c.cloud.size(), tolerance);
      const std::string name = "tolerance " + std::to_string(tolerance);
      const Shapes shapes = c.detect(name, parameters, given);
      check_same(shapes, expected, name);
      CHECK_AT(shapes.hash() == expected.hash(), name);
    }
    // Epsilon is that of the tolerances, too.
    c.tolerance.assign(c.cloud.size(), .04);
    check_same(c.detect("estimated", estimated, given), expected, "estimated");
    // As without a map.
    c.tolerance.assign(c.cloud.size(), HUGE_VAL);
    check_same(c.detect("infinite", estimated, given), detect(c.cloud, estimated, given), "infinite");
  }
}

// Epsilon is not larger than the largest tolerance. A smaller one is that of all points with larger tolerances, and
// those without a number are as if they had the bound that follows from the others.
BOOST_AUTO_TEST_CASE(test_bounds)
{
  Leveled_cloud all = make_leveled(5000);
  Leveled_cloud some = all;
  for(std::size_t i = 0; i < some.tolerance.size(); i += 4)
    some.tolerance[i] = HUGE_VAL;
  const double largest = *std::max_element(all.tolerance.begin(), all.tolerance.end());
  for(const auto& [c, bound, low, high] :
      {std::make_tuple(&all, 1.0001 * largest, largest, largest), std::make_tuple(&all, 1e100, largest, largest),
       std::make_tuple(&all, .02, .02, .02), std::make_tuple(&some, 0., .03, .045)}) {
    const std::string name = "bound " + CGAL::Tandem::internal::to_text(bound);
    Parameters p = make_parameters(bound, least);
    p.maximum_offset = (std::min)(bound, largest);
    const Shapes shapes = c->detect(name, p);
    const double epsilon = shapes.parameters().maximum_distance;
    CHECK_AT(epsilon >= low && epsilon <= high && shapes.number_of_shapes() > 0, name + ": " + std::to_string(epsilon));
    check_same(shapes, c->bounded(epsilon).detect("bounded", make_parameters(epsilon, least)), name);
  }
}

// The planes of the scene, and no others: each label has one plane, and each plane one label. Where walls are as noisy as
// they are wide, normals that are estimated at an edge are those of the other one, and one in a hundred points may have a
// plane of its own.
BOOST_AUTO_TEST_CASE(test_depth_camera)
{
  Parameters parameters;
  parameters.minimum_region_size = 60;
  std::size_t of_walls = 0, assigned = 0; // with own normals
  for(const std::uint64_t seed : {1, 2, 3, 4}) {
    scenes::Random random(seed);
    const Corridor corridor(200, 120, 4.2 + .4 * double(2 - seed % 2), random);
    Leveled_cloud c = {corridor.cloud, {}};
    for(const auto& item : c.cloud)
      c.tolerance.push_back(CGAL::Tandem::distance_of_noise(.0028) * (item.first - CGAL::ORIGIN).squared_length());
    for(const Given given : {Given::normals, Given::nothing}) {
      const std::string name = "seed " + std::to_string(seed) + (given == Given::normals ? "" : ", own normals");
      const Shapes shapes = c.detect(name, parameters, given);
      std::map<int, std::size_t> size_of_plane;
      std::set<std::size_t> walls;
      for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
        std::size_t count[5] = {0, 0, 0, 0, 0};
        for(const std::size_t i : shapes.points(s))
          ++count[corridor.label[i]];
        const std::size_t wall = std::size_t(std::max_element(count, count + 5) - count);
        of_walls += given == Given::normals ? 0 : count[wall];
        assigned += given == Given::normals ? 0 : shapes.size(s);
        CHECK_AT(double(count[wall]) > (given == Given::normals ? .97 : .6) * double(shapes.size(s)),
                 name + ": a shape of two walls: " + std::to_string(s));
        size_of_plane[shapes.coplanar_group(s)] += shapes.size(s);
        walls.insert(wall);
      }
      std::size_t planes = 0;
      for(const auto& plane : size_of_plane)
        planes += given == Given::normals || 100 * plane.second > c.cloud.size();
      check_equal(walls.size(), std::size_t(5), name + ": walls");
      check_equal(planes, std::size_t(5), name + ": planes");
      CHECK_AT(shapes.statistics().coverage > .95, name);
    }
  }
  CHECK_AT(double(of_walls) > .955 * double(assigned), std::to_string(of_walls) + " of " + std::to_string(assigned));
}

// Each tenth point has none, or one that no distance is within; or all have.
BOOST_AUTO_TEST_CASE(test_points_without_tolerance)
{
  for(const double other : {0., -1., Limits::quiet_NaN(), -HUGE_VAL, Limits::denorm_min(), Limits::min(), 1e-20})
    for(const std::size_t step : {10u, 1u})
      for(const double scale : {1., 1024.})
        for(const double bound : {0., scale * .045}) {
          if(step == 1 && other > 0)
            continue;
          Leveled_cloud c = make_leveled(3000);
          for(std::size_t i = 0; i < c.cloud.size(); ++i) {
            c.cloud[i].first = CGAL::ORIGIN + scale * (c.cloud[i].first - CGAL::ORIGIN);
            c.tolerance[i] = i % step == 0 ? other : scale * c.tolerance[i];
          }
          Parameters p = make_parameters(bound, least);
          const std::string name =
            "tolerance " + CGAL::Tandem::internal::to_text(other) + " at " + std::to_string(bound);
          const Shapes shapes = c.detect(name, p);
          const std::size_t without = (c.cloud.size() + step - 1) / step;
          CHECK_AT(step == 1 ? shapes.number_of_shapes() == 0 : shapes.number_of_shapes() > 3, name);
          check_equal(shapes.statistics().number_of_ignored_tolerances, other > 0 ? 0 : without, name);
          CHECK_AT(step > 1 || shapes.statistics().free_points.total() == 0, name);
          for(std::size_t i = 0; i < c.cloud.size(); i += step)
            CHECK_AT(shapes.shape_index(i) < 0, name);
        }
}

// A result with a point between its own tolerance and epsilon.
BOOST_AUTO_TEST_CASE(test_refused)
{
  Leveled_cloud c = make_leveled(5000);
  const Shapes shapes = c.detect("before the changes", make_parameters(.045, least));
  const auto points = shapes.points(0);
  const std::size_t i =
    *std::min_element(points.begin(), points.end(), [&](auto a, auto b) { return c.tolerance[a] < c.tolerance[b]; });
  const auto& plane = shapes.coefficients(0);
  const Kernel::Vector_3 normal(plane[0], plane[1], plane[2]);
  const double own = normal * (c.cloud[i].first - CGAL::ORIGIN) + plane[3];
  c.cloud[i].first = c.cloud[i].first + ((c.tolerance[i] + .045) / 2 - own) * normal;
  const std::string why = c.violation(shapes);
  CHECK_AT(why.find("too far from its plane is point " + std::to_string(i)) != std::string::npos, why);
}

BOOST_AUTO_TEST_SUITE_END()
