// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labels of further points by known planes, against a search without any structure.

#include "testing/test_support.h"

#include <CGAL/Shape_regularization_tandem/label_points.h>
#include <CGAL/Shape_regularization_tandem/select_shapes.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_label_points)

namespace np = CGAL::Tandem::parameters;
using CGAL::Tandem::label_points;
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
  const scenes::Scene scene = make_scene(name, scene_options(is_sanitized ? 4000 : 12000, .0005, .1));
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
      const CGAL::Tandem::Coefficients& q = c.shapes.coefficients(s);
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

template <class Tag>
void check_same_labels(const Case& c, const Labels& expected, bool has_reach, const std::string& name)
{
  const Labels labels = has_reach ? label_points<Tag>(c.shapes, c.whole, maps.shape_points(std::cref(c.part)))
                                  : label_points<Tag>(c.shapes, c.whole, maps);
  CHECK_AT(labels == expected, name);
}

void check_order(const Case& c)
{
  for(bool has_reach : {false, true}) {
    const Labels labels = has_reach ? label_points(c.shapes, c.whole, maps.shape_points(std::cref(c.part)))
                                    : label_points(c.shapes, c.whole, maps);
    check_same_labels<CGAL::Sequential_tag>(c, labels, has_reach, "sequential");
    Case turned = c;
    std::reverse(turned.whole.begin(), turned.whole.end());
    check_same_labels<CGAL::Parallel_if_available_tag>(turned, Labels(labels.rbegin(), labels.rend()), has_reach,
                                                       "the other way round");
  }
}

// Points that are not valid, and those that no shape can take, disturb no other.
void check_bad_points(const Case& c)
{
  Case bad = c;
  bad.whole.resize(6, c.whole[0]);
  for(std::size_t i = 0; i < bad.whole.size(); ++i)
    bad.whole[i] = c.whole[c.shapes.points(0)[0] * 3]; // a point of shape 0
  const double nan = std::nan("");
  bad.whole[1].first = Kernel::Point_3(nan, 0, 0);
  bad.whole[2].first = Kernel::Point_3(0, infinity, 0);
  bad.whole[3].second = Kernel::Vector_3(0, 0, 0);
  bad.whole[4].first = Kernel::Point_3(1e300, 1e300, 1e300);
  for(bool has_reach : {false, true}) {
    const Labels labels = has_reach ? label_points(c.shapes, bad.whole, maps.shape_points(std::cref(c.part)))
                                    : label_points(c.shapes, bad.whole, maps);
    CHECK(labels[0] >= 0 && labels[5] == labels[0]);
    CHECK(labels[1] == -1 && labels[2] == -1 && labels[3] == -1 && labels[4] == -1);
  }
  CHECK(label_points(c.shapes, Cloud(), maps).empty());
  CHECK(label_points(select_shapes(c.shapes, Labels()), c.whole, maps) == Labels(c.whole.size(), -1));
}

void check_refusals(const Case& c)
{
  using Refusal = std::invalid_argument;
  check_throws<Refusal>([&] { label_points(c.shapes, c.whole, maps.maximum_distance(0)); }, {"maximum_distance", "0"},
                        __LINE__);
  check_throws<Refusal>([&] { label_points(c.shapes, c.whole, maps.maximum_angle(90)); }, {"maximum_angle", "90"},
                        __LINE__);
  check_throws<Refusal>([&] { label_points(c.shapes, c.whole, maps.shape_points(c.part).reach(-1)); }, {"reach", "-1"},
                        __LINE__);
  check_throws<Refusal>([&] { label_points(c.shapes, c.whole, maps.shape_points(c.whole)); },
                        {"shape_points", std::to_string(c.whole.size()).c_str()}, __LINE__);
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
void check_coplanar()
{
  const Case c = make_case("squares_gap");
  CHECK(c.shapes.number_of_coplanar_groups() < c.shapes.number_of_shapes());
  const Labels by_points = label_points(c.shapes, c.whole, maps.shape_points(std::cref(c.part)));
  const Labels by_planes = label_points(c.shapes, c.whole, maps);
  for(std::size_t i = 0; i < c.part.size(); ++i)
    if(const int s = c.shapes.shape_index(i); s >= 0) {
      CHECK_AT(by_points[3 * i] == s, std::to_string(i));
      CHECK_AT(by_planes[3 * i] == 0, std::to_string(i));
    }
}

// Squares of lengths of such scales overflow, or vanish. Powers of two change no label.
void check_scales()
{
  const Case c = make_case("squares_gap");
  const Labels labels = label_points(c.shapes, c.whole, maps.shape_points(std::cref(c.part)));
  for(int exponent : {-600, 600}) {
    Case scaled = c;
    for(Cloud* cloud : {&scaled.part, &scaled.whole})
      for(auto& item : *cloud)
        item.first = CGAL::ORIGIN + std::ldexp(1, exponent) * (item.first - CGAL::ORIGIN);
    const double distance = std::ldexp(c.shapes.parameters().maximum_distance, exponent);
    scaled.shapes = detect_valid(c.name, scaled.part, make_parameters(distance, 30));
    check_equal(scaled.shapes.number_of_shapes(), c.shapes.number_of_shapes(), "shapes");
    CHECK_AT(label_points(scaled.shapes, scaled.whole, maps.shape_points(std::cref(scaled.part))) == labels,
             std::to_string(exponent));
  }
}

BOOST_AUTO_TEST_CASE(all_cases)
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
  check_coplanar();
  check_scales();
}

BOOST_AUTO_TEST_SUITE_END()
