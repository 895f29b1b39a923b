// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// is_valid_result() accepts a result, and refuses it, with a reason, as soon as one promise is broken. It has an answer
// for whatever a result holds: it neither throws nor goes on for ever. Each field with a value that the points or the
// other fields contradict is refused by it, or, of statistics and uncertainties, by the tests.

#include "api_support.h"
#include "testing/corruptions.h"

#include <map>

namespace valid_result {

using Data = Shapes::Data;
using CGAL::Tandem::Statistics;

Parameters make_parameters()
{
  Parameters p = ::make_parameters(.006, 50);
  p.fixed_directions = {{1, 2, 3}, {.36, .48, -.8}, {-1, 1, 1}};
  p.regularize_axis_symmetry = true;
  p.symmetry_direction = {.36, .48, -.8};
  return p;
}

// Of a box, with points that are ignored at its ends.
struct Box {
  Cloud cloud = make_box(300);
  Given given;
  Shapes shapes;
  std::size_t parallel = 1; // to shape 0

  explicit Box(Given g = Given::normals) : given(g)
  {
    cloud.insert(cloud.begin(), {Kernel::Point_3(0, infinity, 0), Kernel::Vector_3(0, 0, 1)});
    add(cloud, {0, 0, not_a_number}, {0, 0, 1});
    add(cloud, {.1, .1, .1}, {0, 0, 0});
    shapes = detect_valid("box", cloud, make_parameters(), given);
    CHECK(shapes.number_of_shapes() == 6 && shapes.statistics().number_of_orthogonal_pairs == 3);
    CHECK(shapes.statistics().number_of_ignored_points() == (given == Given::normals ? 3 : 2));
    while(!shapes.are_parallel(0, parallel))
      ++parallel;
  }

  std::string reason(const Data& data) const { return violation(cloud, Shapes(data), given); }

  // `corrupt` changes the data; the reason given has to contain `word`.
  template <class F>
  void refuse(const char* word, F corrupt) const
  {
    Data data = shapes.data();
    corrupt(data);
    const std::string why = reason(data);
    CHECK_AT(why.find(word) != std::string::npos, std::string(word) + " is not in: " + why);
  }
};

void set_label(Data& d, std::size_t i, std::int32_t label)
{
  change_table(d.shape_of, [&](std::vector<std::int32_t>& labels) { labels[i] = label; });
}

} // namespace valid_result

BOOST_FIXTURE_TEST_SUITE(test_valid_result, valid_result::Box)

using namespace valid_result;

BOOST_AUTO_TEST_CASE(test_points)
{
  const std::size_t i = shapes.points(0)[0], j = shapes.points(1)[0];
  refuse("too far", [=](Data& d) {
    set_label(d, i, 1);
    set_label(d, j, 0);
  });
  const std::size_t least = *std::min_element(shapes.data().size.begin(), shapes.data().size.end());
  refuse("too small", [=](Data& d) { d.parameters.minimum_region_size = least + 1; });
  refuse("oblique", [](Data& d) { d.parameters.maximum_angle = .5; });
  refuse("too far", [](Data& d) { d.parameters.maximum_distance = .0005; });
  refuse("maximum_distance is 1e-20, allowed is at least", [](Data& d) { d.parameters.maximum_distance = 1e-20; });
  for(const double wrong : {0., 1e-300, 1e300})
    refuse("maximum_distance", [=](Data& d) { d.parameters.maximum_distance = wrong; });
  refuse("fixed_directions is (0, 0, 0) at index 1", [](Data& d) { d.parameters.fixed_directions[1] = {0, 0, 0}; });
}

BOOST_AUTO_TEST_CASE(test_planes)
{
  refuse("too far", [](Data& d) { d.coefficients[0][3] += .006; });
  refuse("unit normal", [](Data& d) { d.coefficients[0][0] *= 1.0001; });
  refuse("parallel",
         [this](Data& d) { d.coefficients[parallel][0] = std::nextafter(d.coefficients[parallel][0], 0.); });
  refuse("parallel", [this](Data& d) {
    for(double& x : d.coefficients[parallel])
      x = -x;
  });
  refuse("coplanar", [this](Data& d) {
    d.coplanar_group[parallel] = d.coplanar_group[0];
    for(int& g : d.coplanar_group) // no group is empty
      g -= g == int(d.coefficients.size()) - 1 && d.coplanar_group[0] != g;
  });
  refuse("not orthogonal", [](Data& d) {
    const std::array<double, 4> old = d.coefficients[0];
    for(std::size_t s = 0; s < d.coefficients.size(); ++s)
      if(d.parallel_group[s] == d.parallel_group[0]) { // turned so little that all points still fit
        d.coefficients[s][0] = old[0] - 1e-14 * old[1];
        d.coefficients[s][1] = old[1] + 1e-14 * old[0];
      }
  });
}

BOOST_AUTO_TEST_CASE(test_statistics)
{
  CHECK(shapes.statistics().mean_distance > .1 * shapes.parameters().maximum_distance);
  refuse("mean_distance", [](Data& d) { d.statistics.mean_distance *= 1.01; });
  refuse("free_points", [](Data& d) { ++d.statistics.free_points.unselected; });
}

// Points of a strip are taken out of the largest face, so that it falls into two parts.
BOOST_AUTO_TEST_CASE(test_connectivity)
{
  refuse("not connected", [this](Data& d) {
    const Kernel::Vector_3 across(.36, .48, -.8), along(-.8, .6, 0), up(.48, .64, .6);
    const Kernel::Vector_3 normal = shapes.plane(0).orthogonal_vector();
    const Kernel::Vector_3 axis = std::fabs(normal * across) > .9  ? along
                                  : std::fabs(normal * along) > .9 ? up
                                                                   : across;
    const auto place = [&](std::size_t i) { return (cloud[i].first - CGAL::ORIGIN) * axis; };
    double middle = 0;
    for(std::size_t i : shapes.points(0))
      middle += place(i) / double(shapes.size(0));
    for(std::size_t i : shapes.points(0))
      if(std::fabs(place(i) - middle) < .2) {
        set_label(d, i, -1);
        --d.size[0];
      }
  });
}

BOOST_AUTO_TEST_CASE(test_results_of_nothing)
{
  for(const Cloud& points : {cloud, Cloud()})
    CHECK(violation(points, Shapes(Data())).find("maximum_distance is 0") == 0);
  detect_valid("nothing", Cloud(), Parameters(), Given::nothing);
}

// What neither the points nor the other fields contradict: other parameters for the same shapes, how the call went, and
// numbers and normals within their bounds. Points without lists are grouped again.
bool may_be_accepted(const std::string& field, const Data& data, const Data& original)
{
  const std::set<std::string> contradicted = {"parameters.maximum_distance", "parameters.regularize_axis_symmetry",
                                              "parameters.fixed_directions[1]"};
  const auto is_near = [](std::size_t a, std::size_t b) { return a + 1 == b || b + 1 == a; };
  const Statistics &t = data.statistics, &right = original.statistics;
  if(field.find("parameters.") == 0)
    return !throws<std::invalid_argument>([&] { CGAL::Tandem::check_parameters(data.parameters); }) &&
           contradicted.count(field) == 0;
  if(field == "statistics.number_of_rounds" || field == "statistics.peak_bytes")
    return is_near(t.number_of_rounds + t.peak_bytes, right.number_of_rounds + right.peak_bytes);
  if(field == "points.first")
    return data.points.first.empty();
  return field == "statistics.is_cancelled" || field == "statistics.estimate_note" ||
         (field.find("normal[") == 0 && field != "normal[0]");
}

BOOST_AUTO_TEST_CASE(test_each_field)
{
  for(Given has : {Given::normals, Given::nothing}) {
    const Box box(has);
    std::map<std::string, int> refused;
    for(std::size_t number = 0;; ++number) {
      Data data = box.shapes.data();
      data.points = box.shapes.point_groups();
      const Corruption corruption(data, number);
      if(!corruption.is_made())
        break;
      const bool is_refused = !box.reason(data).empty();
      refused[corruption.field()] += is_refused;
      CHECK_AT(is_refused || may_be_accepted(corruption.field(), data, box.shapes.data()), corruption.name());
    }
    CHECK_AT(refused.size() > 50, std::to_string(refused.size()) + " fields");
    for(const auto& [field, times] : refused)
      if(field != "statistics.is_cancelled" && field.find("parameters.regularize_") != 0)
        CHECK_AT(times > 0 || field.find("normal[") == 0, field + " is never refused");
  }
}

BOOST_AUTO_TEST_SUITE_END()
