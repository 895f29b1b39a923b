// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which shapes become parallel and orthogonal, and which do not, on analytic sets of shapes.

#include "testing/rectangles.h"

#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_directions)

using namespace CGAL::Tandem::internal;

namespace {

BOOST_AUTO_TEST_CASE(test_parallel)
{
  // short shapes: it costs little to turn them
  auto small = [](const Vector& n, double z) { return Rectangle{n, {0, 0, z * epsilon}, 3 * epsilon, 3 * epsilon}; };
  const Regularity_options o = all_on(1000);
  const Relations r = run({small(polar(0, 88), 0), small(polar(90, 89), 100), small(polar(200, 89), 200),
                           small(polar(0, 70), 300), small(-polar(10, 90), 400)},
                          o);
  check_tables(r, 5, "parallel");
  for(int i : {1, 2, 4})
    check_equal(r.direction_of[i], r.direction_of[0], "joins the group, shape " + std::to_string(i));
  check(r.direction_of[3] != r.direction_of[0], "20 degrees off does not join");
  check_equal(double(r.directions.size()), 2, "directions of the parallel scene");

  std::vector<Rectangle> chain = {small(polar(0, 0), 0), small(polar(7, 0), 100), small(polar(14, 0), 200)};
  chain[1].count = 200; // alone it would link the other two
  const Relations c = run(chain, o);
  check_equal(double(c.directions.size()), 2, "directions of a chain of 7 degrees");
  check(c.direction_of[0] != c.direction_of[2], "the ends of the chain stay apart");
  check_equal(double(run(chain, all_on(.001)).directions.size()), 3, "directions of a chain that is not worth it");
}

BOOST_AUTO_TEST_CASE(test_orthogonal)
{
  for(int seed = 0; seed < 200; ++seed) {
    const Relations r = run(tilted_box(seed), all_on(200));
    check_tables(r, 6, "box " + std::to_string(seed));
    check_equal(double(r.directions.size()), 3, "directions of box " + std::to_string(seed));
    check_equal(double(orthogonal_pairs(r.directions).size()), 3, "right angles of box " + std::to_string(seed));
    check_equal(double(r.planes.size()), 6, "planes of box " + std::to_string(seed));
  }
  // a master with two followers 40 degrees apart, neither of them exact before
  const Relations r = run({{polar(0, 89), {0, 0, 0}, 40 * epsilon, 40 * epsilon, 200, 9000},
                           {polar(10, 1), {1e6, 0, 0}, 20000, 9000},
                           {polar(50, -1), {2e6, 0, 0}, 20000, 9000}},
                          all_on(400));
  check_equal(double(r.directions.size()), 3, "directions of master and followers");
  check_equal(double(orthogonal_pairs(r.directions).size()), 2, "right angles of master and followers");
  check(std::fabs(dot(r.directions[1], r.directions[2]) - cosine_deg(40)) < 0.03, "followers keep their angle");
}

// Gabled roofs on two walls: each roof plane is orthogonal to one wall, not to the other.
BOOST_AUTO_TEST_CASE(test_chained_frames)
{
  for(int seed = 0; seed < 100; ++seed) {
    std::vector<Rectangle> house = tilted_box(seed);
    const Vector n[3] = {house[0].normal, house[2].normal, house[4].normal};
    for(double tilt : {35.0, -35.0, 20.0})
      house.push_back(
        {add_scaled(cosine_deg(tilt) * n[2], sine_deg(tilt), n[0]), {3e5, tilt * 1e4, 0}, 9000, 7000, 150, 300});
    const Relations r = run(house, all_on(200));
    check_equal(double(r.directions.size()), 6, "directions of house " + std::to_string(seed));
    check_equal(inexact_pairs(r, 4), 0, "nearly orthogonal pairs of house " + std::to_string(seed));
    check_equal(double(orthogonal_pairs(r.directions).size()), 6, "right angles of house " + std::to_string(seed));
  }
}

BOOST_AUTO_TEST_CASE(test_village)
{
  const std::vector<Rectangle> faces = village();
  for(double price : {5., 10., 20., 40.}) {
    const Relations r = run(faces, all_on(price));
    check_tables(r, faces.size(), "village");
    check_equal(double(r.directions.size()), 65, "directions of the village, price " + std::to_string(price));
    check_equal(inexact_pairs(r, 0.3), 0, "nearly orthogonal pairs of the village");
  }
}

} // namespace

BOOST_AUTO_TEST_SUITE_END()
