// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Kernels, ranges, both lists of named parameters, the class and the function: the same cloud gives the same result.
// Progress rises from 0 to 1; a cancelled detection leaves a valid result; what the callback
// throws ends it at once. And the result as the parts of CGAL take it.

#include "api_support.h"

#include <CGAL/Shape_regularization_tandem/adapters.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Iterator_range.h>
#include <CGAL/Point_set_3.h>

#include <boost/iterator/counting_iterator.hpp>
#include <boost/property_map/function_property_map.hpp>

namespace kernels_and_ranges {

using Tag = CGAL::Sequential_tag;
using CGAL::Tandem::detect_planes;

struct Box {
  Cloud cloud = make_box();
  Parameters parameters = make_parameters(.006, 50);
  Shapes shapes = detect(cloud, parameters);
};

constexpr double largest_squared_distance = .006 * .006 * 1.000001;

} // namespace kernels_and_ranges

BOOST_FIXTURE_TEST_SUITE(test_kernels_and_ranges, kernels_and_ranges::Box)

using namespace kernels_and_ranges;

BOOST_AUTO_TEST_CASE(test_box)
{
  check_valid(cloud, shapes, "box");
  check_counts("box", shapes, 6, 3, 6);
  for(std::size_t s = 0; s < 6; ++s) {
    const Kernel::Vector_3 normal = shapes.oriented_plane(s).orthogonal_vector();
    std::size_t agreeing = 0; // the normals point out of the box
    for(std::size_t i : shapes.points(s))
      agreeing += normal * cloud[i].second > 0;
    CHECK_AT(2 * agreeing > shapes.size(s), std::to_string(s));
    for(std::size_t t = 0; t < 6; ++t) {
      const double cosine = normal * shapes.plane(t).orthogonal_vector();
      CHECK(shapes.are_orthogonal(s, t) == (std::fabs(cosine) < .5));
      CHECK(shapes.are_parallel(s, t) == (std::fabs(cosine) > .5));
    }
  }
}

BOOST_AUTO_TEST_CASE(test_exact_kernel)
{
  using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
  const Pairs<Exact> points = make_pairs<Exact>(make_box_cloud());
  const auto of_exact = detect_in<Exact>(points, parameters);
  CHECK(of_exact.hash() == shapes.hash());
  for(std::size_t s = 0; s < of_exact.number_of_shapes(); ++s) {
    const auto distance = CGAL::squared_distance(points[of_exact.points(s)[0]].first, of_exact.plane(s));
    CHECK(CGAL::to_double(distance) <= largest_squared_distance);
  }
}

// Without maps, and without normals.
BOOST_AUTO_TEST_CASE(test_points_of_floats)
{
  using Float = CGAL::Simple_cartesian<float>;
  std::vector<Float::Point_3> points;
  for(const auto& p : make_pairs<Float>(make_box_cloud()))
    points.push_back(p.first);
  const auto of_floats = detect_planes<Tag>(points, np::settings(parameters));
  CHECK(of_floats.hash() == detect(cloud, parameters, Given::nothing).hash());
  std::string why;
  CHECK_AT(CGAL::Tandem::is_valid_result(points, of_floats, CGAL::parameters::Default_named_parameters(), &why), why);
  for(std::size_t i = 0; i < points.size(); ++i)
    if(of_floats.shape_index(i) >= 0)
      CHECK(std::fabs(of_floats.estimated_normal(i).squared_length() - 1) < 1e-6);
}

BOOST_AUTO_TEST_CASE(test_point_set)
{
  CGAL::Point_set_3<Kernel::Point_3> set;
  set.add_normal_map();
  for(const auto& p : cloud)
    set.insert(p.first, p.second);
  const auto list = np::settings(parameters);
  CHECK(detect_planes<Tag>(set, list).hash() == shapes.hash());
  // With a hole in the indices: an item is not its position.
  set.remove(set.begin());
  const Shapes of_set = detect_planes<Tag>(set, list);
  CHECK(!of_set.has_estimated_normals() && of_set.number_of_shapes() == 6);
  const auto map = CGAL::Tandem::add_shape_property(set, of_set);
  CHECK(set.has_property_map<int>("shape"));
  for(std::size_t s = 0; s < of_set.number_of_shapes(); ++s)
    for(std::size_t i : of_set.points(s)) {
      const auto item = *(set.begin() + std::ptrdiff_t(i));
      CHECK_AT(map[item] == int(s), std::to_string(s));
      CHECK(CGAL::squared_distance(set.point(item), of_set.plane(s)) <= largest_squared_distance);
    }
  // Without its normals, by request or because there are none.
  const Shapes estimated = detect_planes<Tag>(set, list.normal_map(CGAL::Default()));
  set.remove_normal_map();
  const Shapes bare = detect_planes<Tag>(set, list);
  CHECK(estimated.has_estimated_normals() && bare.has_estimated_normals() && estimated.hash() == bare.hash());
}

// Each item is read once, and its normal where it is asked for.
BOOST_AUTO_TEST_CASE(test_indices)
{
  using Index = boost::counting_iterator<int>; // holds its item itself
  const CGAL::Iterator_range<Index> indices(Index(0), Index(int(cloud.size())));
  std::vector<int> points(cloud.size(), 0), normals = points;
  const auto point_map = boost::make_function_property_map<int>([&](int i) {
    ++points[std::size_t(i)];
    return cloud[std::size_t(i)].first;
  });
  const auto normal_map = boost::make_function_property_map<int>([&](int i) {
    ++normals[std::size_t(i)];
    return cloud[std::size_t(i)].second;
  });
  const auto of_indices = detect_planes<Tag>(
    indices, np::combine(CGAL::parameters::point_map(point_map).normal_map(normal_map), np::settings(parameters)));
  CHECK(of_indices.hash() == shapes.hash());
  detect_planes<Tag>(indices, np::point_map(point_map).settings(parameters));
  CHECK(points == std::vector<int>(cloud.size(), 2) && normals == std::vector<int>(cloud.size(), 1));
}

BOOST_AUTO_TEST_CASE(test_class)
{
  using Traits = CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, First<Kernel>, Second<Kernel>, Tag>;
  CGAL::Tandem::Planar_shape_detection_3<Traits> detection(cloud, np::maximum_distance(.006).minimum_region_size(50),
                                                           Traits());
  std::size_t rounds = 1, assigned = 0;
  for(; detection.iterate(); ++rounds)
    assigned = (std::max)(assigned, detection.shapes().statistics().number_of_assigned_points);
  CHECK(rounds > 1 && assigned > 0);
  detection.finish();
  CHECK(detection.parameters().maximum_offset == .006);
  CHECK(detection.shapes().statistics().number_of_rounds == rounds);
  CHECK(!detection.iterate() && detection.shapes().hash() == shapes.hash());
}

BOOST_AUTO_TEST_CASE(test_callback)
{
  const auto detect_with = [&](CGAL::Tandem::Callback callback) {
    return detect_planes<Tag>(cloud, maps.settings(parameters).callback(callback));
  };
  std::vector<double> progress;
  const Shapes complete = detect_with([&](double p) {
    progress.push_back(p);
    return true;
  });
  CHECK(complete.hash() == shapes.hash() && !complete.is_cancelled());
  CHECK(progress.size() >= 3 && progress.front() == 0 && progress.back() == 1);
  CHECK(std::is_sorted(progress.begin(), progress.end()));
  using Stage = CGAL::Tandem::Detection_stage;
  for(Stage stage : {Stage::sort, Stage::neighbors, Stage::seeds, Stage::rounds, Stage::end_game, Stage::done})
    CHECK_AT(
      std::any_of(progress.begin(), progress.end(), [&](double p) { return CGAL::Tandem::stage_at(p) == stage; }),
      "stage " + std::to_string(int(stage)));
  struct Stop {};
  for(std::size_t calls = 1; calls < progress.size(); ++calls) {
    const std::string name = std::to_string(calls) + " calls";
    std::size_t count = 0;
    const Shapes cancelled = detect_with([&](double) { return ++count < calls; });
    CHECK_AT(cancelled.is_cancelled() && count == calls, name);
    CHECK_AT(calls > 1 || cancelled.number_of_shapes() == 0, name);
    check_valid(cloud, cancelled, name);
    count = 0;
    const auto stop = [&](double) -> bool {
      if(++count == calls)
        throw Stop();
      return true;
    };
    CHECK_AT(throws<Stop>([&] { detect_with(stop); }) && count == calls, name);
  }
}

// What the parts of CGAL take. A fit to projected points is the plane again, with normals on the side of the points.
BOOST_AUTO_TEST_CASE(test_adapters)
{
  const auto shape_map = CGAL::Tandem::shape_index_map(shapes);
  const auto plane_map = CGAL::Tandem::plane_index_map(shapes);
  const std::vector<Kernel::Plane_3> planes = CGAL::Tandem::distinct_planes(shapes);
  CHECK(planes.size() == shapes.number_of_coplanar_groups());
  for(std::size_t i = 0; i < shapes.number_of_points(); ++i) {
    const int s = shapes.shape_index(i), plane = get(plane_map, i);
    CHECK(get(shape_map, i) == s && (plane < 0) == (s < 0));
    CHECK(s < 0 || planes[std::size_t(plane)] == shapes.plane(std::size_t(s)));
  }
  const auto items = CGAL::Tandem::projected_points(cloud, shapes, maps);
  CHECK(items.size() == shapes.statistics().number_of_assigned_points);
  auto item = items.begin();
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    for(std::size_t i : shapes.points(s)) {
      const auto& [point, normal, plane] = *item++;
      CHECK(CGAL::squared_distance(point, planes[std::size_t(plane)]) < 1e-28);
      CHECK(CGAL::squared_distance(point, cloud[i].first) <= largest_squared_distance);
      CHECK(normal == shapes.oriented_plane(s).orthogonal_vector());
    }
}

BOOST_AUTO_TEST_SUITE_END()
