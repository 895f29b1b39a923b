// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Four kernels, five kinds of range, both lists of named parameters, the class
// and the function, all tags: the same cloud gives the same result, and the range is left alone. Progress rises from 0 to
// 1; a cancelled detection leaves a valid result; what the callback throws ends it at once.

#include "testing/box_cloud.h"
#include "testing/measured_violation.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Iterator_range.h>
#include <CGAL/Point_set_3.h>
#include <CGAL/Simple_cartesian.h>

#include <boost/iterator/counting_iterator.hpp>

BOOST_AUTO_TEST_SUITE(test_kernels_and_ranges)

namespace np = CGAL::Tandem::parameters;
using CGAL::Tandem::detect_planes;

// Of a range of indices into arrays, and how often each was read.
template <class Value, std::array<float, 3> Box_point::*member>
struct Counting_map {
  using key_type = int;
  using value_type = Value;
  using reference = Value;
  using category = boost::readable_property_map_tag;
  const std::vector<Box_point>* cloud;
  std::vector<int>* reads;

  friend Value get(const Counting_map& map, int i)
  {
    ++(*map.reads)[std::size_t(i)];
    const auto& v = (*map.cloud)[std::size_t(i)].*member;
    return Value(v[0], v[1], v[2]);
  }
};

template <class Shapes>
void check_box(const Shapes& shapes, const std::string& name)
{
  CHECK_AT(shapes.number_of_shapes() == 6, name + ": " + std::to_string(shapes.number_of_shapes()));
  CHECK_AT(shapes.number_of_parallel_groups() == 3, name);
  CHECK_AT(shapes.number_of_coplanar_groups() == 6, name);
  CHECK_AT(shapes.orthogonal_groups().size() == 3, name);
  CHECK_AT(shapes.statistics().degrees_of_freedom == 9, name);
  CHECK_AT(shapes.statistics().complexity == .5, name);
  CHECK_AT(shapes.statistics().coverage > .9, name);
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    for(std::size_t i : shapes.points(s))
      CHECK_AT(shapes.shape_index(i) == int(s), name);
}

// Returns the hash.
template <class Kernel>
std::uint64_t test_pairs(const std::vector<Box_point>& cloud, const std::string& name)
{
  const Pairs<Kernel> points = make_pairs<Kernel>(cloud);
  const Pairs<Kernel> copy = points;
  const auto list = np::point_map(First<Kernel>()).normal_map(Second<Kernel>()).maximum_distance(.006);
  const auto shapes = detect_planes<CGAL::Sequential_tag>(points, list);
  check_box(shapes, name);
  CHECK_AT(points == copy, name);
  check_equal(violation_of(points, shapes, list), "", name);
  CHECK_AT(shapes.hash() == detect_planes<CGAL::Parallel_if_available_tag>(points, list).hash(), name);
  CHECK_AT(shapes.hash() == detect_planes<CGAL::Tandem::Cuda_if_available_tag>(points, list).hash(), name);
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) { // the normals point out of the box
    const auto n = shapes.oriented_plane(s).orthogonal_vector();
    std::size_t agreeing = 0;
    for(std::size_t i : shapes.points(s))
      agreeing += CGAL::to_double(n * points[i].second) > 0;
    CHECK_AT(2 * agreeing > shapes.points(s).size(), name);
  }
  return shapes.hash();
}

template <class Kernel>
std::uint64_t test_point_set(const std::vector<Box_point>& cloud, const std::string& name)
{
  CGAL::Point_set_3<typename Kernel::Point_3> points;
  points.add_normal_map();
  for(const auto& p : make_pairs<Kernel>(cloud))
    points.insert(p.first, p.second);
  const auto shapes = detect_planes(points, np::maximum_distance(.006));
  check_box(shapes, name);
  check_equal(violation_of(points, shapes, CGAL::parameters::Default_named_parameters()), "", name);
  CHECK_AT(!shapes.has_estimated_normals(), name);

  // Without its normals, by request or because there are none.
  const auto estimated = detect_planes(points, np::maximum_distance(.006).normal_map(CGAL::Default()));
  check_box(estimated, name);
  points.remove_normal_map();
  const auto bare = detect_planes(points, np::maximum_distance(.006));
  CHECK_AT(estimated.has_estimated_normals() && bare.has_estimated_normals(), name);
  CHECK_AT(estimated.hash() == bare.hash(), name);
  return shapes.hash();
}

template <class Kernel>
std::uint64_t test_points(const std::vector<Box_point>& cloud, const std::string& name)
{
  std::vector<typename Kernel::Point_3> points;
  for(const auto& p : make_pairs<Kernel>(cloud))
    points.push_back(p.first);
  const auto shapes = detect_planes(points, np::maximum_distance(.006));
  check_box(shapes, name);
  check_equal(violation_of(points, shapes, CGAL::parameters::Default_named_parameters()), "", name);
  for(std::size_t i = 0; i < points.size(); ++i)
    if(shapes.shape_index(i) >= 0)
      CHECK_AT(std::fabs(CGAL::to_double(shapes.estimated_normal(i).squared_length()) - 1) < 1e-6, name);
  return shapes.hash();
}

std::uint64_t test_indices(const std::vector<Box_point>& cloud)
{
  using Index = boost::counting_iterator<int>; // holds its item itself
  const CGAL::Iterator_range<Index> indices(Index(0), Index(int(cloud.size())));
  std::vector<int> points(cloud.size(), 0), normals = points;
  const Counting_map<Epick::Point_3, &Box_point::position> point_map = {&cloud, &points};
  const Counting_map<Epick::Vector_3, &Box_point::normal> normal_map = {&cloud, &normals};
  const auto shapes = detect_planes(
    indices, np::combine(CGAL::parameters::point_map(point_map).normal_map(normal_map), np::maximum_distance(.006)));
  check_box(shapes, "indices");
  detect_planes(indices, np::point_map(point_map).maximum_distance(.006));
  CHECK(points == std::vector<int>(cloud.size(), 2) && normals == std::vector<int>(cloud.size(), 1));
  return shapes.hash();
}

std::uint64_t test_class(const std::vector<Box_point>& cloud)
{
  using Traits = CGAL::Tandem::Tandem_traits_3<Epick, Pairs<Epick>, First<Epick>, Second<Epick>, CGAL::Sequential_tag>;
  CGAL::Tandem::Parameters settings;
  settings.maximum_distance = .006;
  const Pairs<Epick> points = make_pairs<Epick>(cloud);
  CGAL::Tandem::Planar_shape_detection_3<Traits> detection(points, np::settings(settings), Traits());
  std::size_t rounds = 1, assigned = 0;
  for(; detection.iterate(); ++rounds)
    assigned = (std::max)(assigned, detection.shapes().statistics().number_of_assigned_points);
  CHECK(rounds > 1 && assigned > 0);
  detection.finish();
  CHECK(detection.parameters().maximum_offset == .006);
  CHECK(detection.shapes().statistics().number_of_rounds == rounds);
  CHECK(!detection.iterate());
  check_box(detection.shapes(), "class");
  return detection.shapes().hash();
}

BOOST_AUTO_TEST_CASE(test_all_agree)
{
  const std::vector<Box_point> cloud = make_box_cloud();
  const std::uint64_t hash = test_pairs<Epick>(cloud, "epick");
  CHECK((test_pairs<CGAL::Simple_cartesian<double>>(cloud, "double") == hash));
  CHECK((test_pairs<CGAL::Simple_cartesian<float>>(cloud, "float") == hash));
  CHECK((test_pairs<CGAL::Exact_predicates_exact_constructions_kernel>(cloud, "epeck") == hash));
  CHECK((test_point_set<Epick>(cloud, "point set of epick") == hash));
  CHECK((test_point_set<CGAL::Simple_cartesian<float>>(cloud, "point set of float") == hash));
  CHECK((test_point_set<CGAL::Exact_predicates_exact_constructions_kernel>(cloud, "point set of epeck") == hash));
  CHECK(test_indices(cloud) == hash);
  CHECK(test_class(cloud) == hash);
  const std::uint64_t estimated = test_points<Epick>(cloud, "points of epick");
  CHECK((test_points<CGAL::Simple_cartesian<float>>(cloud, "points of float") == estimated));
  CHECK((test_points<CGAL::Simple_cartesian<double>>(cloud, "points of double") == estimated));
  CHECK((test_points<CGAL::Exact_predicates_exact_constructions_kernel>(cloud, "points of epeck") == estimated));
}

// Whether what the callback throws in its n-th call reaches the caller, without another call.
template <class Range, class List>
bool throws_at(std::size_t n, const Range& points, const List& list)
{
  struct Stop {};
  std::size_t count = 0;
  const CGAL::Tandem::Callback stop = [&](double) -> bool {
    if(++count == n)
      throw Stop();
    return true;
  };
  try {
    detect_planes(points, list.callback(stop));
  } catch(const Stop&) {
    return count == n;
  }
  return false;
}

BOOST_AUTO_TEST_CASE(test_callback)
{
  const Pairs<Epick> points = make_pairs<Epick>(make_box_cloud());
  const auto list = np::point_map(First<Epick>()).normal_map(Second<Epick>()).maximum_distance(.006);
  const auto silent = detect_planes(points, list);
  CHECK(!silent.is_cancelled());

  std::vector<double> progress;
  const CGAL::Tandem::Callback record = [&](double p) {
    progress.push_back(p);
    return true;
  };
  CHECK(detect_planes(points, list.callback(record)).hash() == silent.hash());
  CHECK(progress.size() >= 3 && progress.front() == 0 && progress.back() == 1);
  for(std::size_t i = 1; i < progress.size(); ++i)
    CHECK_AT(progress[i - 1] <= progress[i] && progress[i] <= 1, std::to_string(i));

  using Stage = CGAL::Tandem::Detection_stage;
  for(Stage stage : {Stage::sort, Stage::neighbors, Stage::seeds, Stage::rounds, Stage::end_game, Stage::done})
    CHECK_AT(
      std::any_of(progress.begin(), progress.end(), [&](double p) { return CGAL::Tandem::stage_at(p) == stage; }),
      "stage " + std::to_string(int(stage)));

  for(std::size_t calls = 1; calls < progress.size(); ++calls) {
    std::size_t count = 0;
    const CGAL::Tandem::Callback cancel = [&](double) { return ++count < calls; };
    const auto shapes = detect_planes(points, list.callback(cancel));
    CHECK_AT(shapes.is_cancelled() && count == calls, std::to_string(calls));
    CHECK_AT(calls > 1 || shapes.number_of_shapes() == 0, std::to_string(calls));
    CHECK_AT(shapes.number_of_points() == points.size(), std::to_string(calls));
    check_equal(violation_of(points, shapes, list), "", std::to_string(calls));
    CHECK_AT(throws_at(calls, points, list), std::to_string(calls));
  }
}

BOOST_AUTO_TEST_SUITE_END()
