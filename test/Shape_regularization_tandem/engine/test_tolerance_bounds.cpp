// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bounds of the tolerances of points: a maximum_distance above all of them, infinite, tiny and no valid ones, other
// kernels, copies of points with other tolerances; and results that is_valid_result() has to refuse.

#include "testing/change_table.h"
#include "testing/tolerances.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <limits>

BOOST_AUTO_TEST_SUITE(test_tolerance_bounds)

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

using Tolerances = std::vector<double>;

struct Leveled_cloud {
  Cloud cloud;
  Tolerances tolerance;

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
void test_far_bound()
{
  const Leveled_cloud c = make_leveled("house", 5000);
  const double largest = *std::max_element(c.tolerance.begin(), c.tolerance.end());
  const Shapes expected = c.detect(make_parameters(largest, least));
  CHECK(expected.number_of_shapes() > 4);
  for(const double bound : {1.0001 * largest, 1., 1000., 1e100}) {
    Parameters p = make_parameters(bound, least);
    p.maximum_offset = largest;
    const std::string name = "bound " + std::to_string(bound);
    const Shapes shapes = c.detect(p);
    check_equal(shapes.parameters().maximum_distance, largest, name);
    check_same(shapes, expected, name);
    check_equal(c.violation(shapes), std::string(), name);
  }
  // A smaller one is that of all points with larger tolerances.
  Leveled_cloud bounded = c;
  for(double& t : bounded.tolerance)
    t = (std::min)(t, .02);
  check_same(c.detect(make_parameters(.02, least)), bounded.detect(make_parameters(.02, least)), "a smaller bound");
}

void test_infinite()
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
  check_equal(c.violation(some), std::string(), "some infinite");
  Leveled_cloud bounded = c;
  for(double& t : bounded.tolerance)
    t = (std::min)(t, epsilon);
  check_same(some, bounded.detect(make_parameters(epsilon, least)), "some infinite");
  // All: as without a map.
  c.tolerance.assign(c.cloud.size(), HUGE_VAL);
  const Shapes all = c.detect(p), none = detect(c.cloud, p);
  check_equal(all.parameters().maximum_distance, none.parameters().maximum_distance, "all infinite: estimate");
  check_same(all, none, "all infinite");
  check_equal(c.violation(all), std::string(), "all infinite");
}

void test_none_valid()
{
  Leveled_cloud c = make_leveled("house", 1000);
  for(const double bound : {0., .02})
    for(const double value : {0., -1., std::numeric_limits<double>::quiet_NaN(), -HUGE_VAL}) {
      c.tolerance.assign(c.cloud.size(), value);
      Parameters p;
      p.maximum_distance = p.maximum_offset = bound;
      const Shapes shapes = c.detect(p);
      const std::string name = "all tolerances " + std::to_string(value);
      check_equal(shapes.number_of_shapes(), std::size_t(0), name);
      check_equal(shapes.statistics().number_of_ignored_tolerances, c.cloud.size(), name);
      check_equal(shapes.statistics().free_points.total(), std::size_t(0), name);
      check_equal(c.violation(shapes), std::string(), name);
    }
}

// Tolerances that no distance is within, and the smallest positive numbers.
void test_tiny()
{
  for(const double tiny :
      {std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::min(), 1e-300, 1e-20})
    for(const double scale : {1., 1024.}) {
      Leveled_cloud c = make_leveled("house", 3000);
      for(auto& item : c.cloud)
        item.first = Kernel::Point_3(scale * item.first.x(), scale * item.first.y(), scale * item.first.z());
      for(std::size_t i = 0; i < c.cloud.size(); ++i)
        c.tolerance[i] = i % 10 == 0 ? tiny : scale * c.tolerance[i];
      for(const double bound : {0., scale * .045}) {
        Parameters p;
        p.maximum_distance = p.maximum_offset = bound;
        p.minimum_region_size = least;
        const Shapes shapes = c.detect(p);
        const std::string name = "tolerances of " + std::to_string(std::log10(tiny)) + " at " + std::to_string(bound);
        CHECK_AT(shapes.number_of_shapes() > 3, name);
        for(std::size_t i = 0; i < c.cloud.size(); i += 10)
          CHECK_AT(shapes.shape_index(i) < 0, name);
        check_equal(c.violation(shapes), std::string(), name);
      }
    }
  // Nothing else.
  Leveled_cloud c = make_leveled("house", 500);
  c.tolerance.assign(c.cloud.size(), std::numeric_limits<double>::denorm_min());
  try {
    const Shapes shapes = c.detect(Parameters());
    check_equal(c.violation(shapes), std::string(), "all tiny");
  } catch(const std::exception& refusal) {
    CHECK_AT(std::string(refusal.what()).find("maximum_distance") != std::string::npos, refusal.what());
  }
}

// The shapes of the same numbers in another kernel.
template <class K>
void test_kernel(const char* name)
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
  std::string why;
  CHECK_AT((why = violation_of(other, shapes, list)).empty(), std::string(name) + ": " + why);
}

// Points that are equal but for their tolerances, each of which is a surfel: their order does not matter.
void test_copies()
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
    std::size_t differing = 0;
    for(std::size_t i = 0; i < c.cloud.size(); ++i)
      differing += shapes.shape_index(c.cloud.size() - 1 - i) != expected.shape_index(i);
    check_equal(differing, std::size_t(0), name + ": points with another shape");
  }
}

// Results that are wrong only with tolerances that differ.
void test_refused()
{
  Leveled_cloud c = make_leveled("house", 5000);
  const Shapes shapes = c.detect(make_parameters(.045, least));
  CHECK(shapes.number_of_shapes() > 4);
  check_equal(c.violation(shapes), std::string(), "before the changes");
  for(const double factor : {.5, .99, 1.01, 1.5}) {
    CGAL::Tandem::Shapes_data data = shapes.data();
    data.statistics.score.fit *= factor;
    const std::string why = c.violation(Shapes(data));
    CHECK_AT(why.find("score.fit") != std::string::npos, "score.fit times " + std::to_string(factor) + ": " + why);
  }
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

BOOST_AUTO_TEST_CASE(all_cases)
{
  test_far_bound();
  test_infinite();
  test_none_valid();
  test_tiny();
  test_kernel<CGAL::Simple_cartesian<float>>("float");
  test_kernel<CGAL::Exact_predicates_exact_constructions_kernel>("exact");
  test_copies();
  test_refused();
}

BOOST_AUTO_TEST_SUITE_END()
