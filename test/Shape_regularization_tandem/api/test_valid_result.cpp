// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// is_valid_result() accepts a result, and rejects it as soon as one promise is
// broken: each corruption below breaks a single one. Statistics and uncertainties are measured again by the tests.

#include "testing/box_cloud.h"
#include "testing/change_table.h"
#include "testing/measured_violation.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>

#include <cmath>

BOOST_AUTO_TEST_SUITE(test_valid_result)

namespace np = CGAL::Tandem::parameters;
using Shapes = CGAL::Tandem::Planar_shapes_3<Epick>;
using Data = Shapes::Data;

class Corruptions {
public:
  Corruptions(const Pairs<Epick>& points, const Shapes& shapes) : points_(points), shapes_(shapes) {}

  // `corrupt` changes the data; the reason given has to contain `word`.
  template <class F>
  void check_rejected(const char* name, const char* word, F corrupt)
  {
    Data data = shapes_.data();
    corrupt(data);
    const std::string why = violation_of(points_, Shapes(data), maps());
    CHECK_AT(!why.empty(), name);
    CHECK_AT(why.find(word) != std::string::npos, std::string(name) + " is rejected because: " + why);
  }

  // The first assigned point of shape s at or after `from`.
  static std::size_t point_of(const Data& data, int s, std::size_t from = 0)
  {
    while(data.shape_of[from] != s)
      ++from;
    return from;
  }

  // A shape that is parallel to shape 0.
  static std::size_t parallel_to_first(const Data& data)
  {
    std::size_t s = 1;
    while(data.parallel_group[s] != data.parallel_group[0])
      ++s;
    return s;
  }

  static decltype(np::point_map(First<Epick>()).normal_map(Second<Epick>())) maps()
  {
    return np::point_map(First<Epick>()).normal_map(Second<Epick>());
  }

private:
  const Pairs<Epick>& points_;
  const Shapes& shapes_;
};

template <class F>
void change_labels(Data& d, F change)
{
  change_table(d.shape_of, change);
}

void set_label(Data& d, std::size_t i, std::int32_t label)
{
  change_labels(d, [&](std::vector<std::int32_t>& labels) { labels[i] = label; });
}

void test_points(Corruptions& c)
{
  c.check_rejected("label too large", "out of range", [](Data& d) { set_label(d, 5, int(d.coefficients.size())); });
  c.check_rejected("label below -1", "out of range", [](Data& d) { set_label(d, 5, -2); });
  c.check_rejected("missing label", "shape indices",
                   [](Data& d) { change_labels(d, [](std::vector<std::int32_t>& labels) { labels.pop_back(); }); });
  c.check_rejected("swapped labels", "too far", [](Data& d) {
    const std::size_t i = Corruptions::point_of(d, 0), j = Corruptions::point_of(d, 1);
    set_label(d, i, 1);
    set_label(d, j, 0);
  });
  c.check_rejected("point freed behind its shape", "size",
                   [](Data& d) { set_label(d, Corruptions::point_of(d, 0), -1); });
  c.check_rejected("wrong size", "size", [](Data& d) { ++d.size[0]; });
  c.check_rejected("oblique normal", "oblique", [](Data& d) { d.parameters.maximum_angle = .5; });
  c.check_rejected("smaller epsilon", "too far", [](Data& d) { d.parameters.maximum_distance = .0005; });
}

void test_planes(Corruptions& c)
{
  c.check_rejected("moved plane", "too far", [](Data& d) { d.coefficients[0][3] += .006; });
  c.check_rejected("normal that is not unit", "unit normal", [](Data& d) { d.coefficients[0][0] *= 1.0001; });
  c.check_rejected("infinite offset", "unit normal", [](Data& d) { d.coefficients[0][3] = 1 / 0.; });
  c.check_rejected("NaN", "unit normal", [](Data& d) { d.coefficients[0][1] = std::nan(""); });
  c.check_rejected("last bit of a parallel normal", "parallel", [](Data& d) {
    double& x = d.coefficients[Corruptions::parallel_to_first(d)][0];
    x = std::nextafter(x, 0.);
  });
  c.check_rejected("sign of a parallel normal", "parallel", [](Data& d) {
    for(double& x : d.coefficients[Corruptions::parallel_to_first(d)])
      x = -x;
  });
  c.check_rejected("planes called coplanar", "coplanar", [](Data& d) {
    d.coplanar_group[Corruptions::parallel_to_first(d)] = d.coplanar_group[0];
    for(int& g : d.coplanar_group) // no group is empty
      g -= g == int(d.coefficients.size()) - 1 && d.coplanar_group[0] != g;
  });
  c.check_rejected("planes called orthogonal", "not orthogonal", [](Data& d) {
    const std::array<double, 4> old = d.coefficients[0];
    for(std::size_t s = 0; s < d.coefficients.size(); ++s)
      if(d.parallel_group[s] == d.parallel_group[0]) { // turned so little that all points still fit
        d.coefficients[s][0] = old[0] - 1e-14 * old[1];
        d.coefficients[s][1] = old[1] + 1e-14 * old[0];
      }
  });
  c.check_rejected("unknown group", "no group", [](Data& d) { d.parallel_group[1] = 1 << 30; });
  c.check_rejected("negative group", "no group", [](Data& d) { d.coplanar_group[1] = -1; });
  c.check_rejected("unknown orthogonal pair", "orthogonal", [](Data& d) { d.orthogonal_groups.emplace_back(0, 17); });
  c.check_rejected("missing plane", "tables", [](Data& d) { d.coefficients.pop_back(); });
}

void test_shapes(Corruptions& c)
{
  c.check_rejected("small shape", "too small", [](Data& d) { d.parameters.minimum_region_size = 100000; });
  c.check_rejected("orthogonal pair removed", "not listed", [](Data& d) { d.orthogonal_groups.pop_back(); });
  c.check_rejected("coverage", "coverage", [](Data& d) { d.statistics.coverage = .5; });
  c.check_rejected("mean distance", "mean_distance", [](Data& d) { d.statistics.mean_distance = 1; });
  c.check_rejected("fit", "score.fit", [](Data& d) { d.statistics.score.fit *= 1.02; });
  c.check_rejected("links", "score.links", [](Data& d) { d.statistics.score.links -= .5; });
  c.check_rejected("freedom", "score.freedom", [](Data& d) { d.statistics.score.freedom += 1; });
  c.check_rejected("free points", "sum of free_points", [](Data& d) { ++d.statistics.free_points.misfit; });
  c.check_rejected("reasons", "free_points.", [](Data& d) {
    ++d.statistics.free_points.misfit;
    --d.statistics.free_points.clutter;
  });
  c.check_rejected("centroid", "centroid of", [](Data& d) { d.uncertainty[1].centroid[0] += .001; });
  c.check_rejected("noise", "noise of", [](Data& d) { d.uncertainty[1].noise += .001; });
  c.check_rejected("offset", "offset_deviation", [](Data& d) { d.uncertainty[1].offset_deviation *= 1.01; });
  for(std::size_t k = 0; k < 6; ++k)
    c.check_rejected("covariance", "normal_covariance", [k](Data& d) {
      const auto& covariance = d.uncertainty[1].normal_covariance;
      d.uncertainty[1].normal_covariance[k] += .02 * (covariance[0] + covariance[3] + covariance[5]);
    });
  c.check_rejected("angle", "normal_covariance", [](Data& d) { d.uncertainty[1].angle_deg *= 1.01; });
  c.check_rejected("number of shapes", "number_of_shapes", [](Data& d) { ++d.statistics.number_of_shapes; });
}

// Points of a strip are taken out of the largest face, so that it falls into two parts.
void test_connectivity(Corruptions& c, const Pairs<Epick>& points)
{
  c.check_rejected("disconnected shape", "not connected", [&](Data& d) {
    const Epick::Vector_3 across(.36, .48, -.8), along(-.8, .6, 0), up(.48, .64, .6);
    double middle = 0;
    std::vector<std::size_t> members;
    for(std::size_t i = 0; i < points.size(); ++i)
      if(d.shape_of[i] == 0)
        members.push_back(i);
    const auto& n = d.coefficients[0];
    const Epick::Vector_3 normal(n[0], n[1], n[2]);
    const Epick::Vector_3 axis = std::fabs(normal * across) > .9 ? along : std::fabs(normal * along) > .9 ? up : across;
    const double fit = d.statistics.score.fit / double(d.statistics.number_of_assigned_points);
    for(std::size_t i : members)
      middle += (points[i].first - CGAL::ORIGIN) * axis / double(members.size());
    change_labels(d, [&](std::vector<std::int32_t>& labels) {
      for(std::size_t i : members)
        if(std::fabs((points[i].first - CGAL::ORIGIN) * axis - middle) < .12) {
          labels[i] = -1;
          --d.statistics.number_of_assigned_points;
          ++d.statistics.free_points.clutter;
          --d.size[0];
          d.statistics.score.fit -= fit;
        }
    });
    measure_shapes_again(d);
    d.statistics.coverage = double(d.statistics.number_of_assigned_points) / double(points.size());
  });
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  const Pairs<Epick> points = make_pairs<Epick>(make_box_cloud());
  const Shapes shapes = CGAL::Tandem::detect_planes(points, Corruptions::maps().maximum_distance(.006));
  CHECK(shapes.number_of_shapes() == 6);
  const std::string why = violation_of(points, shapes, Corruptions::maps());
  CHECK_AT(why.empty(), why);
  Corruptions corruptions(points, shapes);
  test_points(corruptions);
  test_planes(corruptions);
  test_shapes(corruptions);
  test_connectivity(corruptions, points);
}

BOOST_AUTO_TEST_SUITE_END()
