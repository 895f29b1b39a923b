// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// is_valid_result() accepts a result, and rejects it as soon as one promise is broken: each corruption below breaks a
// single one. Wrong values of single fields are those of test_corrupted_fields.

#include "testing/box_cloud.h"
#include "testing/change_table.h"
#include "testing/measured_violation.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>

namespace valid_result {

using Shapes = CGAL::Tandem::Planar_shapes_3<Epick>;
using Data = Shapes::Data;
using Labels = std::vector<std::int32_t>;

const auto maps = CGAL::Tandem::parameters::point_map(First<Epick>()).normal_map(Second<Epick>());

struct Box {
  Pairs<Epick> points = make_pairs<Epick>(make_box_cloud());
  Shapes shapes = CGAL::Tandem::detect_planes(points, maps.maximum_distance(.006));
  std::size_t parallel = 1; // to shape 0

  Box()
  {
    CHECK(shapes.number_of_shapes() == 6);
    check_equal(violation_of(points, shapes, maps), "", "before");
    while(!shapes.are_parallel(0, parallel))
      ++parallel;
  }

  // `corrupt` changes the data; the reason given has to contain `word`.
  template <class F>
  void check_rejected(const char* name, const char* word, F corrupt) const
  {
    Data data = shapes.data();
    corrupt(data);
    const std::string why = violation_of(points, Shapes(data), maps);
    CHECK_AT(why.find(word) != std::string::npos, std::string(name) + " is rejected because: " + why);
  }
};

void set_label(Data& d, std::size_t i, std::int32_t label)
{
  change_table(d.shape_of, [&](Labels& labels) { labels[i] = label; });
}

} // namespace valid_result

BOOST_FIXTURE_TEST_SUITE(test_valid_result, valid_result::Box)

using namespace valid_result;

BOOST_AUTO_TEST_CASE(test_points)
{
  const std::size_t i = shapes.points(0)[0], j = shapes.points(1)[0];
  const auto labeled = [](std::size_t at, std::int32_t label) { return [=](Data& d) { set_label(d, at, label); }; };
  check_rejected("label too large", "out of range", labeled(5, 6));
  check_rejected("label below -1", "out of range", labeled(5, -2));
  check_rejected("missing label", "shape indices",
                 [](Data& d) { change_table(d.shape_of, [](Labels& labels) { labels.pop_back(); }); });
  check_rejected("swapped labels", "too far", [=](Data& d) {
    set_label(d, i, 1);
    set_label(d, j, 0);
  });
  check_rejected("point freed behind its shape", "size", labeled(i, -1));
  const std::size_t least = *std::min_element(shapes.data().size.begin(), shapes.data().size.end());
  check_rejected("small shape", "too small", [=](Data& d) { d.parameters.minimum_region_size = least + 1; });
  check_rejected("oblique normal", "oblique", [](Data& d) { d.parameters.maximum_angle = .5; });
  check_rejected("smaller epsilon", "too far", [](Data& d) { d.parameters.maximum_distance = .0005; });
}

BOOST_AUTO_TEST_CASE(test_planes)
{
  check_rejected("moved plane", "too far", [](Data& d) { d.coefficients[0][3] += .006; });
  check_rejected("normal that is not unit", "unit normal", [](Data& d) { d.coefficients[0][0] *= 1.0001; });
  check_rejected("last bit of a parallel normal", "parallel",
                 [this](Data& d) { d.coefficients[parallel][0] = std::nextafter(d.coefficients[parallel][0], 0.); });
  check_rejected("sign of a parallel normal", "parallel", [this](Data& d) {
    for(double& x : d.coefficients[parallel])
      x = -x;
  });
  check_rejected("planes called coplanar", "coplanar", [this](Data& d) {
    d.coplanar_group[parallel] = d.coplanar_group[0];
    for(int& g : d.coplanar_group) // no group is empty
      g -= g == int(d.coefficients.size()) - 1 && d.coplanar_group[0] != g;
  });
  check_rejected("planes called orthogonal", "not orthogonal", [](Data& d) {
    const std::array<double, 4> old = d.coefficients[0];
    for(std::size_t s = 0; s < d.coefficients.size(); ++s)
      if(d.parallel_group[s] == d.parallel_group[0]) { // turned so little that all points still fit
        d.coefficients[s][0] = old[0] - 1e-14 * old[1];
        d.coefficients[s][1] = old[1] + 1e-14 * old[0];
      }
  });
  check_rejected("missing plane", "tables", [](Data& d) { d.coefficients.pop_back(); });
}

// By less than what the generic changes of test_corrupted_fields are.
BOOST_AUTO_TEST_CASE(test_measures)
{
  check_rejected("fit", "score.fit", [](Data& d) { d.statistics.score.fit *= 1.02; });
  check_rejected("links", "score.links", [](Data& d) { d.statistics.score.links -= .5; });
  check_rejected("reasons", "free_points.", [](Data& d) {
    ++d.statistics.free_points.misfit;
    --d.statistics.free_points.clutter;
  });
  check_rejected("centroid", "centroid of", [](Data& d) { d.uncertainty[1].centroid[0] += .001; });
  check_rejected("noise", "noise of", [](Data& d) { d.uncertainty[1].noise += .001; });
  check_rejected("offset", "offset_deviation", [](Data& d) { d.uncertainty[1].offset_deviation *= 1.01; });
  check_rejected("angle", "normal_covariance", [](Data& d) { d.uncertainty[1].angle_deg *= 1.01; });
}

// Points of a strip are taken out of the largest face, so that it falls into two parts.
BOOST_AUTO_TEST_CASE(test_connectivity)
{
  check_rejected("disconnected shape", "not connected", [this](Data& d) {
    const Epick::Vector_3 across(.36, .48, -.8), along(-.8, .6, 0), up(.48, .64, .6);
    const auto& n = d.coefficients[0];
    const Epick::Vector_3 normal(n[0], n[1], n[2]);
    const Epick::Vector_3 axis = std::fabs(normal * across) > .9 ? along : std::fabs(normal * along) > .9 ? up : across;
    const double fit = d.statistics.score.fit / double(d.statistics.number_of_assigned_points);
    const auto place = [&](std::size_t i) { return (points[i].first - CGAL::ORIGIN) * axis; };
    double middle = 0;
    for(std::size_t i : shapes.points(0))
      middle += place(i) / double(shapes.size(0));
    for(std::size_t i : shapes.points(0))
      if(std::fabs(place(i) - middle) < .12) {
        set_label(d, i, -1);
        --d.statistics.number_of_assigned_points;
        ++d.statistics.free_points.clutter;
        --d.size[0];
        d.statistics.score.fit -= fit;
      }
    measure_shapes_again(d);
    d.statistics.coverage = double(d.statistics.number_of_assigned_points) / double(points.size());
  });
}

BOOST_AUTO_TEST_SUITE_END()
