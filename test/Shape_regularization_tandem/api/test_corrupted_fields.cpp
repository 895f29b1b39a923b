// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// is_valid_result() has an answer for whatever a result holds: it neither throws nor goes on for ever. Each field with
// a value that the points or the other fields contradict is refused, with a reason.

#include "testing/box_cloud.h"
#include "testing/corruptions.h"
#include "testing/measured_violation.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

BOOST_AUTO_TEST_SUITE(test_corrupted_fields)

namespace np = CGAL::Tandem::parameters;
using CGAL::Tandem::Parameters;
using CGAL::Tandem::Statistics;
using Shapes = CGAL::Tandem::Planar_shapes_3<Epick>;
using Data = Shapes::Data;

enum class Normals { given, estimated };

struct Case {
  Pairs<Epick> points;
  Normals normals;

  template <class F>
  auto with_maps(F f) const
  {
    const auto list = np::point_map(First<Epick>());
    return normals == Normals::given ? f(list.normal_map(Second<Epick>())) : f(list);
  }

  Shapes detect(const Parameters& p) const
  {
    return with_maps([&](const auto& list) { return CGAL::Tandem::detect_planes(points, list.settings(p)); });
  }

  // Empty if the check accepts the data. A reason is given exactly if it does not.
  std::string reason(const Data& data) const
  {
    std::string why = "not set";
    const Shapes shapes(data);
    return with_maps([&](const auto& list) {
      const bool is_valid = CGAL::Tandem::is_valid_result(points, shapes, list, &why);
      CHECK_AT(is_valid == why.empty(), why);
      return is_valid ? CGAL::Tandem::internal::measured_violation(points, shapes, list) : why;
    });
  }
};

// Of a box, with points that are ignored at its ends.
Case make_case(Normals normals)
{
  Pairs<Epick> points = make_pairs<Epick>(make_box_cloud(300));
  points.insert(points.begin(), {Epick::Point_3(0, HUGE_VAL, 0), Epick::Vector_3(0, 0, 1)});
  points.emplace_back(Epick::Point_3(0, 0, std::nan("")), Epick::Vector_3(0, 0, 1));
  points.emplace_back(Epick::Point_3(.1, .1, .1), CGAL::NULL_VECTOR);
  return {points, normals};
}

Parameters make_parameters()
{
  Parameters p;
  p.maximum_distance = p.maximum_offset = .006;
  p.minimum_region_size = 50;
  p.fixed_directions = {{1, 2, 3}, {.36, .48, -.8}, {-1, 1, 1}};
  p.regularize_axis_symmetry = true;
  p.symmetry_direction = {.36, .48, -.8};
  return p;
}

bool starts_with(const std::string& text, const std::string& start)
{
  return text.compare(0, start.size(), start) == 0;
}

bool are_allowed(const Parameters& p)
{
  try {
    CGAL::Tandem::check_parameters(p);
    return true;
  } catch(const std::invalid_argument&) {
    return false;
  }
}

// What neither the points nor the other fields contradict: other parameters for the same shapes, how the call went, and
// numbers and normals within their bounds. Points without lists are grouped again.
bool may_be_accepted(const std::string& field, const Data& data, const Data& original)
{
  const std::set<std::string> contradicted = {"parameters.maximum_distance", "parameters.regularize_axis_symmetry",
                                              "parameters.fixed_directions[1]"};
  const Statistics &t = data.statistics, &right = original.statistics;
  if(starts_with(field, "parameters."))
    return are_allowed(data.parameters) && contradicted.count(field) == 0;
  if(field == "statistics.number_of_rounds")
    return t.number_of_rounds + 1 == right.number_of_rounds || t.number_of_rounds == right.number_of_rounds + 1;
  if(field == "statistics.peak_bytes")
    return t.peak_bytes + 1 == right.peak_bytes || t.peak_bytes == right.peak_bytes + 1;
  if(field == "points.first")
    return data.points.first.empty();
  return field == "statistics.is_cancelled" || field == "statistics.estimate_note" ||
         (starts_with(field, "normal[") && field != "normal[0]");
}

void check_each_field(Normals normals)
{
  const Case c = make_case(normals);
  const Shapes shapes = c.detect(make_parameters());
  const Data& original = shapes.data();
  CHECK(shapes.number_of_shapes() == 6 && shapes.statistics().number_of_orthogonal_pairs == 3);
  CHECK(shapes.statistics().number_of_ignored_points() == (normals == Normals::given ? 3 : 2));
  CHECK_AT(c.reason(original).empty(), c.reason(original));
  std::map<std::string, int> refused;
  for(std::size_t number = 0;; ++number) {
    Data data = original;
    data.points = shapes.point_groups();
    const Corruption corruption(data, number);
    if(!corruption.is_made())
      break;
    const std::string why = c.reason(data);
    refused[corruption.field()] += !why.empty();
    CHECK_AT(!why.empty() || may_be_accepted(corruption.field(), data, original), corruption.name());
  }
  CHECK_AT(refused.size() > 50, std::to_string(refused.size()) + " fields");
  for(const auto& [field, times] : refused)
    if(field != "statistics.is_cancelled" && !starts_with(field, "parameters.regularize_"))
      CHECK_AT(times > 0 || starts_with(field, "normal["), field + " is never refused");
}

// Fields that agree with each other, but not with the planes.
BOOST_AUTO_TEST_CASE(test_agreeing_fields)
{
  const Case c = make_case(Normals::given);
  const Data original = c.detect(make_parameters()).data();
  const auto check = [&](const char* word, auto corrupt) {
    Data data = original;
    corrupt(data);
    measure_shapes_again(data);
    const std::string why = c.reason(data);
    CHECK_AT(why.find(word) != std::string::npos, std::string(word) + " is not in: " + why);
  };
  check("not listed", [](Data& d) {
    d.orthogonal_groups.erase(d.orthogonal_groups.begin() + 1);
    Statistics& t = d.statistics; // those of two pairs: one direction is free to turn about another
    --t.number_of_orthogonal_pairs;
    ++t.degrees_of_freedom;
    t.complexity = double(t.degrees_of_freedom) / double(3 * t.number_of_shapes);
  });
  check("twice", [](Data& d) { d.orthogonal_groups.insert(d.orthogonal_groups.begin(), d.orthogonal_groups[0]); });
  check("fixed direction", [](Data& d) { d.fixed_direction.assign(3, -1); });
  check("symmetry", [](Data& d) { d.symmetry_group.assign(3, -1); });
  check("flipped", [](Data& d) { d.is_flipped[0] = !d.is_flipped[0]; });
}

BOOST_AUTO_TEST_CASE(test_parameters)
{
  const Case c = make_case(Normals::given);
  const Data original = c.detect(make_parameters()).data();
  const auto check = [&](const char* name, auto corrupt) {
    Data data = original;
    corrupt(data.parameters);
    const std::string why = c.reason(data);
    CHECK_AT(starts_with(why, name), std::string(name) + " is refused because: " + why);
  };
  for(const double wrong : {0., -1., double(NAN), HUGE_VAL, -HUGE_VAL, 1e-300, 1e300})
    check("maximum_distance", [&](Parameters& p) { p.maximum_distance = wrong; });
  check("maximum_distance is 1e-20 while the extent", [](Parameters& p) { p.maximum_distance = 1e-20; });
  for(const double wrong : {0., 90., 1e300, double(NAN), -HUGE_VAL})
    check("maximum_angle", [&](Parameters& p) { p.maximum_angle = wrong; });
  for(const double wrong : {-1., 45., double(NAN)})
    check("angle_tolerance", [&](Parameters& p) { p.angle_tolerance = wrong; });
  for(const double wrong : {-1., 1e9, double(NAN)}) {
    check("simplicity", [&](Parameters& p) { p.simplicity = wrong; });
    check("regularity", [&](Parameters& p) { p.regularity = wrong; });
    check("surfel_size", [&](Parameters& p) { p.surfel_size = wrong; });
  }
  for(const std::size_t wrong : {std::size_t(0), std::size_t(2), std::size_t(65), ~std::size_t(0)})
    check("k_neighbors", [&](Parameters& p) { p.k_neighbors = wrong; });
  check("fixed_directions[1]", [](Parameters& p) { p.fixed_directions[1] = {0, 0, 0}; });
  check("symmetry_direction", [](Parameters& p) { p.symmetry_direction = {0, NAN, 0}; });
}

BOOST_AUTO_TEST_CASE(test_results_of_nothing)
{
  Case c = make_case(Normals::estimated);
  CHECK(starts_with(c.reason(Data()), "maximum_distance is 0"));
  c.points.clear();
  CHECK(starts_with(c.reason(Data()), "maximum_distance is 0"));
  const std::string why = c.reason(c.detect(Parameters()).data());
  CHECK_AT(why.empty(), why);
}

BOOST_AUTO_TEST_CASE(test_each_field)
{
  check_each_field(Normals::given);
  check_each_field(Normals::estimated);
}

BOOST_AUTO_TEST_SUITE_END()
