// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labels of further points by known planes, against a search without any structure; and results of known planes: those of
// a detection, and planes with all relations.

#include "testing/test_support.h"

#include <CGAL/Shape_regularization_tandem/join_coplanar_shapes.h>
#include <CGAL/Shape_regularization_tandem/label_points.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>
#include <CGAL/Shape_regularization_tandem/select_shapes.h>
#include <CGAL/Shape_regularization_tandem/shapes_of_planes.h>

#include <limits>

BOOST_AUTO_TEST_SUITE(test_label_points)

namespace np = CGAL::Tandem::parameters;
using CGAL::Tandem::Coefficients;
using CGAL::Tandem::join_coplanar_shapes;
using CGAL::Tandem::label_points;
using CGAL::Tandem::select_shapes;
using CGAL::Tandem::shapes_of_planes;
using Labels = std::vector<std::int32_t>;

const auto positions = np::point_map(First<Kernel>());
const auto maps = positions.normal_map(Second<Kernel>());
constexpr double infinity = std::numeric_limits<double>::infinity();

// Shapes of a part of a cloud, and the whole cloud.
struct Case {
  std::string name;
  Cloud part, whole;
  Shapes shapes;
};

Case make_case(const std::string& name)
{
  const scenes::Scene scene = make_scene(name, scene_options(is_sanitized ? 4000 : 9000, .0005, .1));
  Case c;
  c.name = name;
  c.whole = to_cloud(scene);
  for(std::size_t i = 0; i < c.whole.size(); i += 3)
    c.part.push_back(c.whole[i]);
  c.shapes = detect_valid(name, c.part, make_parameters(.002 * scene.diagonal, 30));
  CHECK_AT(c.shapes.number_of_shapes() > 1, name);
  return c;
}

// The definition, point by point. reach: infinite where planes have no end.
Labels naive_labels(const Case& c, double tolerance, bool has_normals, double reach)
{
  const double cosine = std::cos(c.shapes.parameters().maximum_angle * CGAL_PI / 180);
  Labels labels;
  for(const auto& [p, n] : c.whole) {
    double best = infinity, nearest = infinity;
    labels.push_back(-1);
    for(std::size_t s = 0; s < c.shapes.number_of_shapes(); ++s) {
      const Coefficients& q = c.shapes.coefficients(s);
      const double distance = std::fabs(std::fma(q[0], p.x(), std::fma(q[1], p.y(), std::fma(q[2], p.z(), q[3]))));
      const double aligned = std::fabs(q[0] * n.x() + q[1] * n.y() + q[2] * n.z()) / std::sqrt(n.squared_length());
      if(!(distance <= tolerance) || (has_normals && !(aligned >= cosine)))
        continue;
      double squared = reach < infinity ? infinity : 0;
      for(std::size_t i : c.shapes.points(s))
        squared = reach < infinity ? (std::min)(squared, CGAL::squared_distance(p, c.part[i].first)) : 0;
      if(squared <= reach * reach && (distance < best || (distance == best && squared < nearest))) {
        best = distance;
        nearest = squared;
        labels.back() = std::int32_t(s);
      }
    }
  }
  return labels;
}

void check_labels(const Case& c, const Labels& found, const Labels& expected, const std::string& what)
{
  const long at = first_difference(found, expected);
  CHECK_AT(at < 0, c.name + ", " + what + ": first of point " + std::to_string(at));
  CHECK_AT(std::count_if(found.begin(), found.end(), [](int s) { return s >= 0; }) > std::ptrdiff_t(found.size() / 4),
           c.name + ", " + what);
}

void check_definition(const Case& c)
{
  const double epsilon = c.shapes.parameters().maximum_distance;
  check_labels(c, label_points(c.shapes, c.whole, maps), naive_labels(c, epsilon, true, infinity), "planes");
  check_labels(c, label_points(c.shapes, c.whole, positions), naive_labels(c, epsilon, false, infinity), "positions");
  check_labels(c, label_points(c.shapes, c.whole, maps.maximum_distance(epsilon / 2)),
               naive_labels(c, epsilon / 2, true, infinity), "half the distance");
  for(double reach : {epsilon, 10 * epsilon, 500 * epsilon}) {
    const auto list = maps.shape_points(std::cref(c.part)).reach(reach);
    if(reach > epsilon)
      check_labels(c, label_points(c.shapes, c.whole, list), naive_labels(c, epsilon, true, reach), "reach");
    // A point of a shape is within reach of that.
    const Labels own = label_points(c.shapes, c.part, list);
    for(std::size_t i = 0; i < own.size(); ++i)
      CHECK_AT(own[i] >= 0 || c.shapes.shape_index(i) < 0, c.name + ": point " + std::to_string(i));
  }
}

// Most of the whole cloud gets the labels that its part has.
void check_default_reach(const Case& c)
{
  const Labels labels = label_points(c.shapes, c.whole, maps.shape_points(std::cref(c.part)));
  const auto share = [](const auto& all) {
    return double(std::count_if(all.begin(), all.end(), [](int s) { return s >= 0; })) / double(all.size());
  };
  CHECK_AT(share(labels) > .95 * share(c.shapes.shape_indices()), c.name);
  CHECK(labels == label_points(c.shapes, c.whole, maps.shape_points(c.part))); // a copy
}

// With the points of the shapes, or by their planes alone.
template <class Tag = CGAL::Sequential_tag>
Labels labels_of(const Case& c, const Cloud& points, bool has_reach)
{
  return has_reach ? label_points<Tag>(c.shapes, points, maps.shape_points(std::cref(c.part)))
                   : label_points<Tag>(c.shapes, points, maps);
}

void check_order(const Case& c)
{
  for(bool has_reach : {false, true}) {
    Labels labels = labels_of(c, c.whole, has_reach);
    std::reverse(labels.begin(), labels.end());
    const Cloud reversed(c.whole.rbegin(), c.whole.rend());
    CHECK_AT(labels_of<CGAL::Parallel_if_available_tag>(c, reversed, has_reach) == labels, c.name);
  }
}

// Points that are not valid, and those that no shape can take, disturb no other.
void check_bad_points(const Case& c)
{
  Cloud bad(6, c.part[c.shapes.points(0)[0]]); // a point of shape 0
  bad[1].first = Kernel::Point_3(std::nan(""), 0, 0);
  bad[2].first = Kernel::Point_3(0, infinity, 0);
  bad[3].second = Kernel::Vector_3(0, 0, 0);
  bad[4].first = Kernel::Point_3(1e300, 1e300, 1e300);
  for(bool has_reach : {false, true}) {
    const Labels labels = labels_of(c, bad, has_reach);
    CHECK(labels[0] >= 0 && labels[5] == labels[0]);
    CHECK(labels[1] == -1 && labels[2] == -1 && labels[3] == -1 && labels[4] == -1);
  }
  CHECK(label_points(c.shapes, Cloud(), maps).empty());
  CHECK(label_points(select_shapes(c.shapes, Labels()), c.whole, maps) == Labels(c.whole.size(), -1));
}

void check_refusals(const Case& c)
{
  const auto refuse = [&](const auto& list, const char* name, const std::string& value) {
    check_throws<std::invalid_argument>([&] { label_points(c.shapes, c.whole, list); }, {name, value.c_str()},
                                        __LINE__);
  };
  refuse(maps.maximum_distance(0), "maximum_distance", "0");
  refuse(maps.maximum_angle(90), "maximum_angle", "90");
  refuse(maps.shape_points(c.part).reach(-1), "reach", "-1");
  refuse(maps.shape_points(c.whole), "shape_points", std::to_string(c.whole.size()));
}

// The points of the shapes have to be those of the detection, in their order.
void check_changed_points(const Case& c)
{
  Cloud reversed(c.part.rbegin(), c.part.rend()), invalid = c.part;
  invalid[c.shapes.points(0)[0]].first = Kernel::Point_3(std::nan(""), 0, 0);
  for(const Cloud& changed : {reversed, invalid})
    check_throws<std::invalid_argument>([&] { label_points(c.shapes, c.whole, maps.shape_points(std::cref(changed))); },
                                        {"is not on the plane of its shape", "pass the range of the detection"},
                                        __LINE__);
}

// Two squares of one plane: without their points, the first one takes all.
BOOST_AUTO_TEST_CASE(test_coplanar)
{
  const Case c = make_case("squares_gap");
  CHECK(c.shapes.number_of_coplanar_groups() < c.shapes.number_of_shapes());
  const Labels by_points = labels_of(c, c.whole, true), by_planes = labels_of(c, c.whole, false);
  for(std::size_t i = 0; i < c.part.size(); ++i)
    if(const int s = c.shapes.shape_index(i); s >= 0) {
      CHECK_AT(by_points[3 * i] == s, std::to_string(i));
      CHECK_AT(by_planes[3 * i] == 0, std::to_string(i));
    }
}

// Squares of lengths of such scales overflow, or vanish. Powers of two change no label.
BOOST_AUTO_TEST_CASE(test_scales)
{
  const Case c = make_case("squares_gap");
  const Labels labels = labels_of(c, c.whole, true);
  for(int exponent : {-600, 600}) {
    Case scaled = c;
    for(Cloud* cloud : {&scaled.part, &scaled.whole})
      for(auto& item : *cloud)
        item.first = CGAL::ORIGIN + std::ldexp(1, exponent) * (item.first - CGAL::ORIGIN);
    const double distance = std::ldexp(c.shapes.parameters().maximum_distance, exponent);
    scaled.shapes = detect_valid(c.name, scaled.part, make_parameters(distance, 30));
    check_equal(scaled.shapes.number_of_shapes(), c.shapes.number_of_shapes(), "shapes");
    CHECK_AT(labels_of(scaled, scaled.whole, true) == labels, std::to_string(exponent));
  }
}

BOOST_AUTO_TEST_CASE(test_scenes)
{
  for(const char* name : {"indoor", "house"}) {
    const Case c = make_case(name);
    check_definition(c);
    check_default_reach(c);
    check_order(c);
    check_bad_points(c);
    check_refusals(c);
    check_changed_points(c);
  }
}

// The planes of a detection give the same planes, relations and numbers, and the labels of label_points().
BOOST_AUTO_TEST_CASE(test_planes_of_detection)
{
  const scenes::Scene scene = make_scene("indoor", scene_options(8000, .0005, .1));
  const Cloud cloud = to_cloud(scene);
  const Shapes detected = detect_valid("indoor", cloud, make_parameters(.002 * scene.diagonal, 50));
  const auto list = maps.settings(detected.parameters());
  const Shapes known = shapes_of_planes(detected.data().coefficients, cloud, list);
  check_same_planes(detected, known, "indoor");
  const std::vector<std::int32_t> labels = label_points(detected, cloud, maps);
  CHECK(std::equal(labels.begin(), labels.end(), known.shape_indices().begin()));
  const CGAL::Tandem::Statistics &t = known.statistics(), &d = detected.statistics();
  std::size_t assigned = 0;
  double distances = 0;
  for(std::size_t s = 0; s < known.number_of_shapes(); ++s) {
    CHECK_AT(known.points(s).size() == known.size(s), std::to_string(s));
    assigned += known.size(s);
    for(std::size_t i : known.points(s)) {
      const Coefficients& c = known.coefficients(s);
      const Kernel::Point_3& p = cloud[i].first;
      distances += std::fabs(c[0] * p.x() + c[1] * p.y() + c[2] * p.z() + c[3]);
    }
  }
  check_equal(t.number_of_assigned_points, assigned, "assigned");
  check_equal(t.free_points.total(), cloud.size() - assigned, "free");
  check_equal(t.degrees_of_freedom, d.degrees_of_freedom, "degrees of freedom");
  check_close(t.mean_distance, distances / double(assigned), 1e-12, "mean distance");
  CHECK(t.coverage >= d.coverage); // planes have no end
}

// Points on the planes x = 0, z = 0 and z = 1, with their normals.
Cloud make_corner()
{
  Cloud cloud;
  for(int i = 1; i < 20; ++i)
    for(int j = 1; j < 20; ++j) {
      add(cloud, {0, i / 20., j / 20.}, {-1, 0, 0});
      add(cloud, {i / 20., j / 20., 0}, {0, 0, 1});
      add(cloud, {i / 20., j / 20., 1}, {0, 0, 1});
    }
  return cloud;
}

BOOST_AUTO_TEST_CASE(test_relations)
{
  const Cloud cloud = make_corner();
  const std::vector<Coefficients> planes = {{0, 0, 2, 0}, {-3, 0, 0, 0}, {0, 0, -1, 1},
                                            {0, 0, 1, 0}, {0, 0, 1, -5}, {1, 0, 0, -0.}};
  const Shapes shapes = shapes_of_planes(planes, cloud, maps.maximum_distance(.01));
  const std::vector<Coefficients> expected = {{0, 0, 1, 0}, {-1, 0, 0, 0}, {0, 0, 1, -1},
                                              {0, 0, 1, 0}, {0, 0, 1, -5}, {-1, 0, 0, 0}};
  CHECK(shapes.data().coefficients == expected);
  CHECK(shapes.data().parallel_group == std::vector<int>({0, 1, 0, 0, 0, 1}));
  CHECK(shapes.data().coplanar_group == std::vector<int>({0, 1, 2, 0, 3, 1}));
  CHECK(shapes.are_orthogonal(0, 1) && shapes.orthogonal_groups().size() == 1);
  CHECK(shapes.data().size == std::vector<std::size_t>({361, 361, 361, 0, 0, 0}));
  CHECK(!shapes.is_flipped(0) && !shapes.is_flipped(1) && !shapes.is_flipped(2));
  check_close(shapes.uncertainty(2).centroid[2], 1, 1e-12, "centroid");
  const auto areas = polygons(shapes, cloud, maps);
  CHECK(areas.number_of_entries() == 6 && areas.number_of_empty_entries() == 3);
  check_close(areas.area(2), .95 * .9, .03, "area"); // it is straight at the plane of the wall
}

// Known planes have no score, and get none where they are selected or joined.
BOOST_AUTO_TEST_CASE(test_score)
{
  const Cloud cloud = make_corner();
  const Shapes shapes = shapes_of_planes({{0, 0, 1, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}}, cloud, maps.maximum_distance(.01));
  for(const Shapes& s :
      {shapes, join_coplanar_shapes(shapes, cloud, maps), select_shapes(shapes, std::vector<int>{2, 1, 0}),
       select_shapes(shapes, std::vector<int>{0})}) {
    const CGAL::Tandem::Result_score& score = s.statistics().score;
    CHECK(score.fit == 0 && score.links == 0 && score.size == 0 && score.price == 0 && score.freedom == 0);
  }
}

// Lengths of normals whose squares overflow or vanish change no plane.
BOOST_AUTO_TEST_CASE(test_extreme_planes)
{
  const Cloud cloud = make_corner();
  const Shapes shapes =
    shapes_of_planes({{1e308, 1e308, 0, 0}, {0, 0, 1e-310, 0}, {0, 1e-310, 0, 1e-310}}, cloud, maps);
  check_close(shapes.coefficients(0)[0], std::sqrt(.5), 1e-15, "of a large normal");
  CHECK(shapes.coefficients(1) == Coefficients({0, 0, 1, 0}) && shapes.coefficients(2) == Coefficients({0, 1, 0, 1}));
}

BOOST_AUTO_TEST_CASE(test_notes)
{
  const Shapes shapes = shapes_of_planes({{0, 0, 1, 0}}, make_corner(), maps.maximum_angle(.9));
  CHECK(shapes.statistics().angle_note == CGAL::Tandem::angle_note(shapes.parameters()));
  CHECK(!shapes.statistics().angle_note.empty());
}

// Without normals only distances count, and there are none to be asked for.
BOOST_AUTO_TEST_CASE(test_without_normals)
{
  const Cloud cloud = make_corner();
  const Shapes shapes = shapes_of_planes({{0, 1, 0, -.5}}, cloud, positions.maximum_distance(.01));
  check_equal(shapes.size(0), std::size_t(57), "points of a section");
  CHECK(!shapes.has_estimated_normals());
  CHECK(shapes.hash() == Shapes::hash(shapes.shape_indices(), shapes.data().coefficients)); // of no normals
  check_equal(shapes_of_planes({{0, 1, 0, -.5}}, cloud, maps.maximum_distance(.01)).size(0), std::size_t(0),
              "points with other normals");
  CHECK(shapes_of_planes({{0, 1, 0, 0}}, Cloud(), positions).number_of_points() == 0);
  CHECK(shapes_of_planes({}, cloud, positions).number_of_shapes() == 0);
}

BOOST_AUTO_TEST_CASE(test_refusals)
{
  const Cloud cloud = make_corner();
  const double nan = std::nan("");
  for(const Coefficients& c : {Coefficients{0, 0, 0, 1},
                               {0, nan, 1, 0},
                               {0, 0, infinity, 0},
                               {0, 0, 1, nan},
                               {0, 0, 1, infinity},
                               {0, 0, 1e-310, 5}})
    check_throws<std::invalid_argument>(
      [&] {
        shapes_of_planes({{0, 0, 1, 0}, c}, cloud, maps);
      },
      {"Plane 1", "not null"}, __LINE__);
  check_throws<std::invalid_argument>([&] { shapes_of_planes({}, cloud, maps.maximum_distance(-1)); },
                                      {"maximum_distance"}, __LINE__);
}

BOOST_AUTO_TEST_SUITE_END()
