// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tolerances of points: each point is within its own, a constant one is that of the detection bit for bit, a depth camera
// gets the planes of its scene, near layers stay apart where far noise is wider than their distance, and points without a
// tolerance have no shape. Bounds: a maximum_distance above all of them, infinite, tiny and no valid ones.

#include "testing/tolerances.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Shape_regularization_tandem/distance_of_noise.h>

#include <limits>
#include <map>

BOOST_AUTO_TEST_SUITE(test_tolerances)

void check_valid(const Cloud& cloud, const Shapes& shapes, const Range_tolerance& map, const std::string& name,
                 Given given = Given::normals)
{
  for(std::size_t i = 0; i < cloud.size(); ++i) {
    if(shapes.shape_index(i) < 0)
      continue;
    const auto& c = shapes.coefficients(std::size_t(shapes.shape_index(i)));
    const auto& p = cloud[i].first;
    const double distance = std::fabs(c[0] * p.x() + c[1] * p.y() + c[2] * p.z() + c[3]);
    CHECK_AT(distance <= (std::min)(get(map, cloud[i]), shapes.parameters().maximum_distance) + 1e-12,
             name + ": point " + std::to_string(i));
  }
  check_equal(violation_with_tolerances(cloud, shapes, map, given), "", name);
}

BOOST_AUTO_TEST_CASE(test_constant_tolerance)
{
  const Cloud cloud = to_cloud(scenes::make_scene("house", scene_options(6000, .001, .02)));
  const Parameters parameters = make_parameters(.04, 40);
  for(const Given given : {Given::normals, Given::nothing}) {
    const Shapes expected = detect(cloud, parameters, given);
    CHECK(expected.number_of_shapes() > 4);
    for(const double tolerance : {.04, 1., HUGE_VAL}) {
      const Range_tolerance map = {tolerance, 0};
      const std::string name = "tolerance " + std::to_string(tolerance);
      const Shapes shapes = detect_with_tolerances(cloud, parameters, map, given);
      check_same(shapes, expected, name);
      CHECK_AT(shapes.hash() == expected.hash(), name);
      check_equal(violation_with_tolerances(cloud, shapes, map, given), "", name);
      check_same(detect_with_tolerances<CGAL::Parallel_if_available_tag>(cloud, parameters, map, given), expected,
                 name + ", parallel");
    }
    // Epsilon is that of the tolerances, too.
    Parameters estimated = parameters;
    estimated.maximum_distance = 0;
    check_same(detect_with_tolerances(cloud, estimated, Range_tolerance{.04, 0}, given), expected, "estimated");
  }
}

// The planes of the scene, and no others: each label has one plane, and each plane one label.
void check_depth_camera(std::uint64_t seed, double tolerance_at_one)
{
  scenes::Random random(seed);
  const Corridor corridor(160 + 20 * int(seed), 120, 4.2 + .4 * double(seed), random);
  const Range_tolerance map = {0, tolerance_at_one};
  Parameters parameters;
  parameters.minimum_region_size = 60;
  for(const Given given : {Given::normals, Given::nothing}) {
    const std::string name = "seed " + std::to_string(seed) + (given == Given::normals ? "" : ", own normals");
    const Shapes shapes = detect_with_tolerances(corridor.cloud, parameters, map, given);
    std::map<int, std::size_t> wall_of_plane;
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
      std::size_t count[5] = {0, 0, 0, 0, 0};
      for(const std::size_t i : shapes.points(s))
        ++count[corridor.label[i]];
      const std::size_t wall = std::size_t(std::max_element(count, count + 5) - count);
      // Where walls are as noisy as they are wide, normals that are estimated at an edge are those of the other one.
      const double least = given == Given::normals ? .97 : .75;
      CHECK_AT(double(count[wall]) > least * double(shapes.size(s)),
               name + ": a shape of two walls: " + std::to_string(count[wall]) + " of " +
                 std::to_string(shapes.size(s)));
      wall_of_plane[shapes.coplanar_group(s)] = wall;
    }
    check_equal(wall_of_plane.size(), std::size_t(5), name + ": planes");
    CHECK_AT(shapes.statistics().coverage > .95, name);
    check_valid(corridor.cloud, shapes, map, name, given);
    check_same(detect_with_tolerances<CGAL::Parallel_if_available_tag>(corridor.cloud, parameters, map, given), shapes,
               name + ", parallel");
    Cloud shuffled = corridor.cloud;
    shuffle(shuffled, seed);
    CHECK_AT(labeled_points(shuffled, detect_with_tolerances(shuffled, parameters, map, given)) ==
               labeled_points(corridor.cloud, shapes),
             name + ", shuffled");
  }
}

BOOST_AUTO_TEST_CASE(test_depth_camera)
{
  for(std::uint64_t seed = 1; seed <= 2; ++seed)
    check_depth_camera(seed, CGAL::Tandem::distance_of_noise(.0028));
  check_depth_camera(4, 3 * .0028);
}

// Two layers near the origin, closer to each other than the tolerance of what is far.
BOOST_AUTO_TEST_CASE(test_layers_beside_noise)
{
  scenes::Random random(8);
  Cloud cloud;
  for(int i = 0; i < 6000; ++i) {
    const double a = random.uniform(), b = random.uniform();
    const bool is_upper = i % 2 == 0;
    add(cloud, {a - .5, b - .5, (is_upper ? .012 : 0) + .001 * random.gaussian()}, {0, 0, 1});
    add(cloud, {8 * a - 4, 8 * b - 4, 10 + .05 * random.gaussian()}, {0, 0, 1});
  }
  const Range_tolerance map = {.003, .0016};
  Parameters parameters;
  parameters.minimum_region_size = 100;
  const Shapes shapes = detect_with_tolerances(cloud, parameters, map);
  check_equal(shapes.number_of_shapes(), std::size_t(3), "two layers, and noise far away");
  check_valid(cloud, shapes, map, "two layers");
  for(std::size_t i = 0; i < cloud.size(); i += 4)
    CHECK_AT(shapes.shape_index(i) < 0 || shapes.shape_index(i) != shapes.shape_index(i + 2),
             "points of both layers in one shape: " + std::to_string(i));
}

namespace np = CGAL::Tandem::parameters;

// One for each item of a range of pairs, by its place there.
template <class K>
struct Listed_tolerance {
  using key_type = typename Pairs<K>::value_type;
  using value_type = double;
  using reference = double;
  using category = boost::readable_property_map_tag;

  const Pairs<K>* cloud;
  const std::vector<double>* tolerance;

  friend double get(const Listed_tolerance& map, const key_type& item)
  {
    return (*map.tolerance)[std::size_t(&item - map.cloud->data())];
  }
};

struct Leveled_cloud {
  Cloud cloud;
  std::vector<double> tolerance;

  Listed_tolerance<Kernel> map() const { return {&cloud, &tolerance}; }
  Shapes detect(const Parameters& p) const { return detect_with_tolerances(cloud, p, map()); }
  std::string violation(const Shapes& shapes) const { return violation_with_tolerances(cloud, shapes, map()); }
};

// Tolerances of a scene between .015 and .045, by place.
Leveled_cloud make_leveled(const char* scene, std::size_t points)
{
  Leveled_cloud c;
  c.cloud = to_cloud(scenes::make_scene(scene, scene_options(points, .0005, .02)));
  for(const auto& item : c.cloud) {
    const auto& p = item.first;
    c.tolerance.push_back(.03 + .015 * std::sin(3 * p.x() + 2 * p.y() + p.z()));
  }
  return c;
}

const std::size_t least = 40;

// Epsilon is not larger than the largest tolerance.
BOOST_AUTO_TEST_CASE(test_far_bound)
{
  const Leveled_cloud c = make_leveled("house", 5000);
  const double largest = *std::max_element(c.tolerance.begin(), c.tolerance.end());
  const Shapes expected = c.detect(make_parameters(largest, least));
  CHECK(expected.number_of_shapes() > 4);
  for(const double bound : {1.0001 * largest, 1e100}) {
    Parameters p = make_parameters(bound, least);
    p.maximum_offset = largest;
    const std::string name = "bound " + std::to_string(bound);
    const Shapes shapes = c.detect(p);
    check_equal(shapes.parameters().maximum_distance, largest, name);
    check_same(shapes, expected, name);
    check_equal(c.violation(shapes), "", name);
  }
  // A smaller one is that of all points with larger tolerances.
  Leveled_cloud bounded = c;
  for(double& t : bounded.tolerance)
    t = (std::min)(t, .02);
  check_same(c.detect(make_parameters(.02, least)), bounded.detect(make_parameters(.02, least)), "a smaller bound");
}

BOOST_AUTO_TEST_CASE(test_infinite)
{
  Leveled_cloud c = make_leveled("house", 5000);
  for(std::size_t i = 0; i < c.tolerance.size(); i += 4)
    c.tolerance[i] = HUGE_VAL;
  // Some, without a number: as if they had the bound that follows from the others.
  Parameters p;
  p.minimum_region_size = least;
  const Shapes some = c.detect(p);
  const double epsilon = some.parameters().maximum_distance;
  CHECK_AT(epsilon > .03 && epsilon <= .045, "epsilon beside infinite tolerances: " + std::to_string(epsilon));
  CHECK(some.number_of_shapes() > 4);
  check_equal(c.violation(some), "", "some infinite");
  Leveled_cloud bounded = c;
  for(double& t : bounded.tolerance)
    t = (std::min)(t, epsilon);
  check_same(some, bounded.detect(make_parameters(epsilon, least)), "some infinite");
  // All: as without a map.
  c.tolerance.assign(c.cloud.size(), HUGE_VAL);
  const Shapes all = c.detect(p), none = detect(c.cloud, p);
  check_equal(all.parameters().maximum_distance, none.parameters().maximum_distance, "all infinite: estimate");
  check_same(all, none, "all infinite");
  check_equal(c.violation(all), "", "all infinite");
}

// Each tenth point has none, or one that no distance is within.
BOOST_AUTO_TEST_CASE(test_points_without_tolerance)
{
  using Limits = std::numeric_limits<double>;
  for(const double other : {0., -1., Limits::quiet_NaN(), -HUGE_VAL, Limits::denorm_min(), Limits::min(), 1e-20})
    for(const double scale : {1., 1024.})
      for(const double bound : {0., scale * .045}) {
        Leveled_cloud c = make_leveled("house", 3000);
        for(std::size_t i = 0; i < c.cloud.size(); ++i) {
          c.cloud[i].first = CGAL::ORIGIN + scale * (c.cloud[i].first - CGAL::ORIGIN);
          c.tolerance[i] = i % 10 == 0 ? other : scale * c.tolerance[i];
        }
        Parameters p;
        p.maximum_distance = p.maximum_offset = bound;
        p.minimum_region_size = least;
        const Shapes shapes = c.detect(p);
        const std::string name = "tolerance " + CGAL::Tandem::to_text(other) + " at " + std::to_string(bound);
        CHECK_AT(shapes.number_of_shapes() > 3, name);
        check_equal(shapes.statistics().number_of_ignored_tolerances, other > 0 ? 0 : (c.cloud.size() + 9) / 10, name);
        for(std::size_t i = 0; i < c.cloud.size(); i += 10)
          CHECK_AT(shapes.shape_index(i) < 0, name);
        check_equal(c.violation(shapes), "", name);
      }
}

BOOST_AUTO_TEST_CASE(test_none_valid)
{
  Leveled_cloud c = make_leveled("house", 500);
  for(const double bound : {0., .02})
    for(const double value : {0., std::numeric_limits<double>::quiet_NaN(), -HUGE_VAL}) {
      c.tolerance.assign(c.cloud.size(), value);
      Parameters p;
      p.maximum_distance = p.maximum_offset = bound;
      const Shapes shapes = c.detect(p);
      const std::string name = "all tolerances " + std::to_string(value);
      check_equal(shapes.number_of_shapes(), std::size_t(0), name);
      check_equal(shapes.statistics().number_of_ignored_tolerances, c.cloud.size(), name);
      check_equal(shapes.statistics().free_points.total(), std::size_t(0), name);
      check_equal(c.violation(shapes), "", name);
    }
  c.tolerance.assign(c.cloud.size(), std::numeric_limits<double>::denorm_min());
  try {
    const Shapes shapes = c.detect(Parameters());
    check_equal(c.violation(shapes), "", "all tiny");
  } catch(const std::exception& refusal) {
    CHECK_AT(std::string(refusal.what()).find("maximum_distance") != std::string::npos, refusal.what());
  }
}

// The shapes of the same numbers in another kernel.
template <class K>
void check_kernel(const char* name)
{
  Leveled_cloud c = make_leveled("house", 4000);
  Pairs<K> other;
  for(auto& item : c.cloud) { // of numbers that both can hold
    const auto& p = item.first;
    const auto& n = item.second;
    const float v[6] = {float(p.x()), float(p.y()), float(p.z()), float(n.x()), float(n.y()), float(n.z())};
    item = {Kernel::Point_3(v[0], v[1], v[2]), Kernel::Vector_3(v[3], v[4], v[5])};
    other.emplace_back(typename K::Point_3(v[0], v[1], v[2]), typename K::Vector_3(v[3], v[4], v[5]));
  }
  const Parameters p = make_parameters(.045, least);
  const auto list = np::settings(p)
                      .point_map(First<K>())
                      .normal_map(Second<K>())
                      .maximum_distance_map(Listed_tolerance<K>{&other, &c.tolerance});
  const auto shapes = CGAL::Tandem::detect_planes<CGAL::Sequential_tag>(other, list);
  const Shapes expected = c.detect(p);
  CHECK_AT(expected.number_of_shapes() > 4, name);
  CHECK_AT(first_difference(shapes.shape_indices(), expected.shape_indices()) < 0, name);
  check_equal(violation_of(other, shapes, list), "", name);
}

BOOST_AUTO_TEST_CASE(test_kernels)
{
  check_kernel<CGAL::Simple_cartesian<float>>("float");
  check_kernel<CGAL::Exact_predicates_exact_constructions_kernel>("exact");
}

// Points that are equal but for their tolerances, each of which is a surfel: their order does not matter.
BOOST_AUTO_TEST_CASE(test_copies)
{
  for(const double surfel_size : {0., Parameters().surfel_size}) {
    Leveled_cloud c = make_leveled("house", 3000), reversed;
    for(std::size_t i = 0; i < 3000; ++i) {
      c.cloud.push_back(c.cloud[i]);
      c.tolerance.push_back(c.tolerance[i] * (i % 2 == 0 ? .02 : .3));
    }
    Parameters p = make_parameters(.045, least);
    p.surfel_size = surfel_size;
    reversed.cloud.assign(c.cloud.rbegin(), c.cloud.rend());
    reversed.tolerance.assign(c.tolerance.rbegin(), c.tolerance.rend());
    const Shapes expected = c.detect(p), shapes = reversed.detect(p);
    const std::string name = "copies, surfel size " + std::to_string(surfel_size);
    check_same_planes(shapes, expected, name);
    for(std::size_t i = 0; i < c.cloud.size(); ++i)
      CHECK_AT(shapes.shape_index(c.cloud.size() - 1 - i) == expected.shape_index(i), name);
  }
}

// Results that are wrong only with tolerances that differ.
BOOST_AUTO_TEST_CASE(test_refused)
{
  Leveled_cloud c = make_leveled("house", 5000);
  const Shapes shapes = c.detect(make_parameters(.045, least));
  CHECK(shapes.number_of_shapes() > 4);
  check_equal(c.violation(shapes), "", "before the changes");
  // A point between its own tolerance and epsilon.
  std::size_t moved = 0;
  for(std::size_t i = 0; i < c.cloud.size() && moved < 20; i += 97) {
    if(shapes.shape_index(i) < 0 || c.tolerance[i] > .035)
      continue;
    const auto& plane = shapes.coefficients(std::size_t(shapes.shape_index(i)));
    const auto before = c.cloud[i];
    const auto& p = before.first;
    const double own = plane[0] * p.x() + plane[1] * p.y() + plane[2] * p.z() + plane[3];
    const double wanted = (c.tolerance[i] + .045) / 2, way = wanted - own;
    c.cloud[i].first = Kernel::Point_3(p.x() + way * plane[0], p.y() + way * plane[1], p.z() + way * plane[2]);
    const std::string why = c.violation(shapes);
    CHECK_AT(why.find("too far from its plane is point " + std::to_string(i)) != std::string::npos,
             "point " + std::to_string(i) + " beyond its tolerance: " + why);
    c.cloud[i] = before;
    ++moved;
  }
  CHECK_AT(moved >= 10, std::to_string(moved) + " points moved");
}

BOOST_AUTO_TEST_SUITE_END()
