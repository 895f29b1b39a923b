// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random scenes keep all guarantees of the manual, in any order of their points. After -- an argument SEED repeats one
// case, and SEED COUNT as many, from SEED on.

#include "testing/corruptions.h"
#include "testing/property_case.h"
#include "testing/same_result.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

BOOST_AUTO_TEST_SUITE(test_properties)

// --- Fidelity without the tolerance for rounding that is_valid_result() has: the caller's points and the public
// interface, with 113 bits.

// The product of two doubles is exact.
using Real = boost::multiprecision::cpp_bin_float_quad;

using Vector = std::array<Real, 3>;

Real dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

template <class Geometry>
Vector to_vector(const Geometry& g)
{
  return {Real(g.x()), Real(g.y()), Real(g.z())};
}

// The first point of a shape that does not fit its plane, or nothing. Distances and angles are compared by their squares.
std::string infidelity(const Cloud& cloud, Given given, const Shapes& shapes)
{
  const Real least_cosine = cos(Real(shapes.parameters().maximum_angle) * acos(Real(-1)) / 180);
  const Real epsilon = Real(shapes.parameters().maximum_distance);
  for(std::size_t i = 0; i < cloud.size(); ++i) {
    if(shapes.shape_index(i) < 0)
      continue;
    const auto& c = shapes.coefficients(std::size_t(shapes.shape_index(i)));
    const Vector normal = {Real(c[0]), Real(c[1]), Real(c[2])};
    const Vector of_point =
      to_vector(given == Given::normals ? cloud[i].second : Kernel::Vector_3(shapes.estimated_normal(i)));
    const Real squared_length = dot(normal, normal);
    const Real distance = dot(normal, to_vector(cloud[i].first)) + Real(c[3]);
    if(!(distance * distance <= epsilon * epsilon * squared_length))
      return "too far from its plane is point " + std::to_string(i);
    const Real aligned = dot(normal, of_point);
    const Real least = least_cosine * least_cosine * squared_length * dot(of_point, of_point);
    if(!(aligned * aligned >= least && least > 0))
      return "too oblique is the normal of point " + std::to_string(i);
  }
  return "";
}

// --- Random scenes

// What the cases cover.
struct Totals {
  std::size_t shapes = 0, coplanar = 0, orthogonal = 0;
};

// Parameters that were given are those of the result.
bool has_parameters(const Shapes& shapes, const Parameters& given)
{
  const Parameters& used = shapes.parameters();
  return (given.maximum_distance == 0 || used.maximum_distance == given.maximum_distance) &&
         (given.maximum_offset == 0 || used.maximum_offset == given.maximum_offset) &&
         (given.minimum_region_size == 0 || used.minimum_region_size == given.minimum_region_size) &&
         used.maximum_angle == given.maximum_angle && used.k_neighbors == given.k_neighbors &&
         used.simplicity == given.simplicity && used.regularity == given.regularity;
}

void check_case(const Property_case& c, Totals& totals)
{
  using Parallel = CGAL::Parallel_if_available_tag;
  const Cloud before = c.cloud;
  const Shapes shapes = detect_valid(c.name, c.cloud, c.parameters, c.given);
  totals.shapes += shapes.number_of_shapes();
  totals.coplanar += shapes.number_of_shapes() - shapes.number_of_coplanar_groups();
  totals.orthogonal += shapes.orthogonal_groups().size();
  check_equal(infidelity(c.cloud, c.given, shapes), "", c.name);
  CHECK_AT(has_parameters(shapes, c.parameters), c.name);
  check_equal(difference(shapes, detect<Parallel>(c.cloud, c.parameters, c.given)), "", c.name);
  CHECK_AT(before.empty() || std::memcmp(before.data(), c.cloud.data(), before.size() * sizeof before[0]) == 0, c.name);
  Cloud shuffled = c.cloud;
  shuffle(shuffled, c.cloud.size());
  check_equal(difference({c.cloud, shapes}, {shuffled, detect<Parallel>(shuffled, c.parameters, c.given)}, c.given), "",
              c.name);
}

BOOST_AUTO_TEST_CASE(test_random_cases)
{
  const std::uint64_t first = argument(1, 1), count = argument(2, argument(1, 0) > 0 ? 1 : 100);
  Totals totals;
  on_random_cases(first, count, [&](const Property_case& c) { check_case(c, totals); });
  CHECK_AT(count < 100 || (totals.shapes > 300 && totals.coplanar > 5 && totals.orthogonal > 20),
           std::to_string(totals.shapes) + " shapes, " + std::to_string(totals.coplanar) + " coplanar, " +
             std::to_string(totals.orthogonal) + " orthogonal pairs");
}

// The checks above can fail: the label of one point is another one, or of all.
BOOST_AUTO_TEST_CASE(test_corruptions)
{
  const Cloud cloud = to_cloud(scenes::make_scene(scenes::make_cube(), scene_options(1500)));
  const Shapes shapes = detect_valid("cube", cloud, points_only(.01, 50));
  check_equal(difference(shapes, shapes), "", "the same");
  for(const bool is_point : {true, false}) {
    Shapes::Data data = shapes.data();
    change_table(data.shape_of, [&](std::vector<std::int32_t>& label) {
      for(std::size_t i = 0, n = is_point ? 1 : label.size(); i < n; ++i)
        label[i] = (label[i] + 1) % 6;
    });
    CHECK_AT(!infidelity(cloud, Given::normals, Shapes(data)).empty(), std::to_string(is_point));
    CHECK_AT(!difference(shapes, Shapes(data)).empty(), std::to_string(is_point));
  }
}

BOOST_AUTO_TEST_SUITE_END()
