// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labels of further points by known planes, against a search without any structure; and results of known planes: those
// of a detection, and planes with all relations.

#include "api_support.h"

#include <CGAL/Shape_regularization_tandem/join_coplanar_shapes.h>
#include <CGAL/Shape_regularization_tandem/label_points.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>
#include <CGAL/Shape_regularization_tandem/shape_facts.h>
#include <CGAL/Shape_regularization_tandem/shapes_of_planes.h>

#include <boost/property_map/function_property_map.hpp>

#include <functional>

BOOST_AUTO_TEST_SUITE(test_label_points)

using CGAL::Tandem::Coefficients;
using Labels = std::vector<std::int32_t>;
using Tag = CGAL::Sequential_tag;

// Shapes of a part of a cloud, and the whole cloud.
struct Case {
  std::string name;
  Cloud part, whole;
  Shapes shapes;

  template <class List>
  Labels labels(const List& list) const
  {
    return CGAL::Tandem::label_points<Tag>(shapes, whole, list);
  }
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

double distance_to(const Coefficients& q, const Kernel::Point_3& p)
{
  return std::fabs(std::fma(q[0], p.x(), std::fma(q[1], p.y(), std::fma(q[2], p.z(), q[3]))));
}

// The definition, point by point. reach: infinite where planes have no end.
struct Definition {
  std::function<double(const Cloud::value_type&)> tolerance;
  bool has_normals = true;
  double reach = infinity;

  std::int32_t label_of(const Case& c, const Cloud::value_type& item) const
  {
    const auto& [p, n] = item;
    const double cosine = std::cos(c.shapes.parameters().maximum_angle * CGAL_PI / 180);
    std::pair<double, double> best = {infinity, infinity}; // distances to a plane and to a point of its shape
    std::int32_t label = -1;
    for(std::size_t s = 0; s < c.shapes.number_of_shapes(); ++s) {
      const Kernel::Vector_3 normal = c.shapes.plane(s).orthogonal_vector();
      const double distance = distance_to(c.shapes.coefficients(s), p);
      if(!(distance <= tolerance(item)) ||
         (has_normals && !(std::fabs(normal * n) / std::sqrt(n.squared_length()) >= cosine)))
        continue;
      double squared = reach < infinity ? infinity : 0;
      for(std::size_t i : c.shapes.points(s))
        squared = (std::min)(squared, CGAL::squared_distance(p, c.part[i].first));
      if(squared <= reach * reach && std::make_pair(distance, squared) < best) {
        best = {distance, squared};
        label = std::int32_t(s);
      }
    }
    return label;
  }
};

void check_labels(const Case& c, const Labels& found, const Definition& definition, const std::string& what)
{
  Labels expected;
  for(const auto& item : c.whole)
    expected.push_back(definition.label_of(c, item));
  const long at = first_difference(found, expected);
  CHECK_AT(at < 0, c.name + ", " + what + ": first of point " + std::to_string(at));
}

// Of points with tolerances of their own, from a quarter to four times maximum_distance, the smaller one counts.
void check_definition(const Case& c)
{
  using Item = Cloud::value_type;
  const double epsilon = c.shapes.parameters().maximum_distance;
  const auto all = [=](const Item&) { return epsilon; };
  const auto half = [=](const Item&) { return epsilon / 2; };
  const auto own = [=](const Item& item) { return epsilon * std::exp2(2 * std::sin(1e4 * item.first.x())); };
  const auto lesser = [=](const Item& item) { return (std::min)(own(item), epsilon); };
  check_labels(c, c.labels(maps), {all}, "planes");
  check_labels(c, c.labels(positions), {all, false}, "positions");
  check_labels(c, c.labels(maps.maximum_distance(epsilon / 2)), {half}, "half the distance");
  check_labels(c, c.labels(maps.maximum_distance_map(boost::make_function_property_map<Item>(own))), {lesser}, "own");
  for(double reach : {10 * epsilon, 500 * epsilon}) {
    const auto list = maps.shape_points(std::cref(c.part)).reach(reach);
    check_labels(c, c.labels(list), {all, true, reach}, "reach");
  }
}

// With the points of the shapes, or by their planes alone.
template <class T = Tag>
Labels labels_of(const Case& c, const Cloud& points, bool has_reach)
{
  return has_reach ? CGAL::Tandem::label_points<T>(c.shapes, points, maps.shape_points(std::cref(c.part)))
                   : CGAL::Tandem::label_points<T>(c.shapes, points, maps);
}

// In any order and by threads. With a default reach most of the whole cloud gets the labels that its part has.
void check_order(const Case& c)
{
  const Cloud reversed(c.whole.rbegin(), c.whole.rend());
  for(bool has_reach : {false, true}) {
    Labels labels = labels_of(c, c.whole, has_reach);
    const auto labeled = std::size_t(std::count_if(labels.begin(), labels.end(), [](int s) { return s >= 0; }));
    CHECK_AT(double(labeled) > .95 * 3 * double(c.shapes.statistics().number_of_assigned_points), c.name);
    CHECK(!has_reach || labels == c.labels(maps.shape_points(c.part))); // a copy
    std::reverse(labels.begin(), labels.end());
    CHECK_AT(labels_of<CGAL::Parallel_if_available_tag>(c, reversed, has_reach) == labels, c.name);
  }
}

// Points that are not valid, and those that no shape can take, disturb no other.
void check_bad_points(const Case& c)
{
  Cloud bad(6, c.part[c.shapes.points(0)[0]]); // a point of shape 0
  bad[1].first = {not_a_number, 0, 0};
  bad[2].first = {0, infinity, 0};
  bad[3].second = {0, 0, 0};
  bad[4].first = {1e300, 1e300, 1e300};
  for(bool has_reach : {false, true}) {
    const Labels labels = labels_of(c, bad, has_reach);
    CHECK(labels[0] >= 0 && labels == Labels({labels[0], -1, -1, -1, -1, labels[0]}));
    CHECK(labels_of(c, Cloud(), has_reach).empty());
  }
  const Case none = {"none", {}, {}, select_shapes(c.shapes, Labels())};
  CHECK(none.shapes.number_of_shapes() == 0 && labels_of(none, c.whole, false) == Labels(c.whole.size(), -1));
}

// The points of the shapes have to be those of the detection, in their order.
void check_refusals(const Case& c)
{
  const auto refuse = [&](const auto& list, const char* name, const std::string& value) {
    CHECK_REFUSED(c.labels(list), name, value.c_str());
  };
  refuse(maps.maximum_distance(0.), "maximum_distance", "0");
  refuse(maps.maximum_angle(90), "maximum_angle", "90");
  refuse(maps.shape_points(std::cref(c.part)).reach(-1.), "reach", "-1");
  refuse(maps.shape_points(std::cref(c.whole)), "shape_points", std::to_string(c.whole.size()));
  const Cloud reversed(c.part.rbegin(), c.part.rend());
  refuse(maps.shape_points(std::cref(reversed)), "is not on the plane of its shape", "pass the range of the detection");
}

BOOST_AUTO_TEST_CASE(test_scenes)
{
  for(const char* name : {"indoor", "house"}) {
    const Case c = make_case(name);
    check_definition(c);
    check_order(c);
    check_bad_points(c);
    check_refusals(c);
  }
}

// Two squares of one plane: without their points, the first one takes all. Squares of lengths of other scales overflow,
// or vanish; powers of two change no label.
BOOST_AUTO_TEST_CASE(test_coplanar)
{
  const Case c = make_case("squares_gap");
  CHECK(c.shapes.number_of_coplanar_groups() < c.shapes.number_of_shapes());
  const Labels by_points = labels_of(c, c.whole, true), by_planes = labels_of(c, c.whole, false);
  for(std::size_t i = 0; i < c.part.size(); ++i)
    if(const int s = c.shapes.shape_index(i); s >= 0)
      CHECK_AT(by_points[3 * i] == s && by_planes[3 * i] == 0, std::to_string(i));
  for(int exponent : {-600, 600}) {
    Case scaled = c;
    for(Cloud* cloud : {&scaled.part, &scaled.whole})
      *cloud = transformed(*cloud, std::ldexp(1, exponent));
    const double distance = std::ldexp(c.shapes.parameters().maximum_distance, exponent);
    scaled.shapes = detect_valid(c.name, scaled.part, make_parameters(distance, 30));
    CHECK_AT(labels_of(scaled, scaled.whole, true) == by_points, std::to_string(exponent));
  }
}

Shapes shapes_of(const std::vector<Coefficients>& planes, const Cloud& cloud, const Parameters& parameters,
                 Given given = Given::normals)
{
  return given == Given::normals ? CGAL::Tandem::shapes_of_planes<Tag>(planes, cloud, maps.settings(parameters))
                                 : CGAL::Tandem::shapes_of_planes<Tag>(planes, cloud, positions.settings(parameters));
}

// The planes of a detection give the same planes, relations and numbers, and the labels of label_points().
BOOST_AUTO_TEST_CASE(test_planes_of_detection)
{
  Case c = make_case("indoor");
  const Shapes known = shapes_of(c.shapes.data().coefficients, c.whole, c.shapes.parameters());
  check_same_planes(c.shapes, known, "indoor");
  const Labels labels = c.labels(maps);
  CHECK(std::equal(labels.begin(), labels.end(), known.shape_indices().begin()));
  const auto assigned = double(std::count_if(labels.begin(), labels.end(), [](int s) { return s >= 0; }));
  const CGAL::Tandem::Statistics& t = known.statistics();
  CHECK(double(t.number_of_assigned_points) == assigned && t.coverage == assigned / double(c.whole.size()));
  CHECK(double(t.free_points.total()) == double(c.whole.size()) - assigned);
  CHECK(t.degrees_of_freedom == c.shapes.statistics().degrees_of_freedom);
  CHECK(t.mean_distance > 0 && t.mean_distance < c.shapes.parameters().maximum_distance);
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

const Cloud corner = make_corner();
const Parameters of_corner = make_parameters(.01, 0);
const Coefficients corner_plane = {0, 0, 1, 0};

BOOST_AUTO_TEST_CASE(test_relations)
{
  const Shapes shapes = shapes_of(
    {{0, 0, 2, 0}, {-3, 0, 0, 0}, {0, 0, -1, 1}, {0, 0, 1, 0}, {0, 0, 1, -5}, {1, 0, 0, -0.}}, corner, of_corner);
  const std::vector<Coefficients> expected = {{0, 0, 1, 0}, {-1, 0, 0, 0}, {0, 0, 1, -1},
                                              {0, 0, 1, 0}, {0, 0, 1, -5}, {-1, 0, 0, 0}};
  CHECK(shapes.data().coefficients == expected);
  CHECK(shapes.data().parallel_group == std::vector<int>({0, 1, 0, 0, 0, 1}));
  CHECK(shapes.data().coplanar_group == std::vector<int>({0, 1, 2, 0, 3, 1}));
  CHECK(shapes.are_orthogonal(0, 1) && shapes.are_orthogonal(1, 0) && shapes.orthogonal_groups().size() == 1);
  CHECK(shapes.data().size == std::vector<std::size_t>({361, 361, 361, 0, 0, 0}));
  CHECK(!shapes.is_flipped(0) && !shapes.is_flipped(1) && !shapes.is_flipped(2));
  check_close(shapes.uncertainty(2).centroid[2], 1, 1e-12, "centroid");
  const auto areas = polygons(shapes, corner, maps);
  CHECK(areas.number_of_entries() == 6 && areas.number_of_empty_entries() == 3);
  check_close(areas.area(2), .95 * .9, .03, "area"); // it is straight at the plane of the wall
  // Known planes have no score, and get none where they are selected or joined.
  for(const Shapes& s : {shapes, join_coplanar_shapes(shapes, corner, maps), select_shapes(shapes, Labels{2, 1, 0})}) {
    const CGAL::Tandem::Result_score& score = s.statistics().score;
    CHECK(score.fit == 0 && score.links == 0 && score.size == 0 && score.price == 0 && score.freedom == 0);
  }
}

BOOST_AUTO_TEST_CASE(test_extreme_planes)
{
  // Lengths of normals whose squares overflow or vanish change no plane.
  const Shapes shapes = shapes_of({{1e308, 1e308, 0, 0}, {0, 0, 1e-310, 0}, {0, 1e-310, 0, 1e-310}}, corner, of_corner);
  check_close(shapes.coefficients(0)[0], std::sqrt(.5), 1e-15, "of a large normal");
  CHECK(shapes.coefficients(1) == Coefficients({0, 0, 1, 0}) && shapes.coefficients(2) == Coefficients({0, 1, 0, 1}));
  const std::vector<Coefficients> wrong = {
    {0, 0, 0, 1}, {0, not_a_number, 1, 0}, {0, 0, infinity, 0}, {0, 0, 1, infinity}, {0, 0, 1e-310, 5}};
  for(const Coefficients& c : wrong)
    CHECK_REFUSED(shapes_of({corner_plane, c}, corner, of_corner), "Plane 1", "not null");
}

// Without normals only distances count, and there are none to be asked for.
BOOST_AUTO_TEST_CASE(test_settings_of_planes)
{
  const std::vector<Coefficients> section = {{0, 1, 0, -.5}};
  const Shapes shapes = shapes_of(section, corner, of_corner, Given::nothing);
  check_equal(shapes.size(0), std::size_t(57), "points of a section");
  CHECK(!shapes.has_estimated_normals());
  CHECK(shapes.hash() == Shapes::hash(shapes.shape_indices(), shapes.data().coefficients)); // of no normals
  check_equal(shapes_of(section, corner, of_corner).size(0), std::size_t(0), "points with other normals");
  CHECK(shapes_of(section, Cloud(), Parameters(), Given::nothing).number_of_points() == 0);
  CHECK(shapes_of({}, corner, Parameters(), Given::nothing).number_of_shapes() == 0);
  Parameters p = of_corner;
  p.maximum_angle = .9;
  const std::string note = shapes_of(section, corner, p).statistics().angle_note;
  CHECK_AT(!note.empty() && note == CGAL::Tandem::internal::angle_note(p), note);
  p.maximum_distance = -1;
  CHECK_REFUSED(shapes_of({}, corner, p), "maximum_distance");
}

BOOST_AUTO_TEST_SUITE_END()
