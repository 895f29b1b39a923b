// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The regularity step as a whole, on analytic sets of shapes: which become parallel, orthogonal and coplanar, and which
// do not, switches, and degenerate input.

#include "testing/rectangles.h"

#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_regularity)

using namespace CGAL::Tandem::internal;

BOOST_AUTO_TEST_CASE(parallel)
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
  check_equal(r.directions.size(), 2u, "directions of the parallel scene");

  std::vector<Rectangle> chain = {small(polar(0, 0), 0), small(polar(7, 0), 100), small(polar(14, 0), 200)};
  chain[1].count = 200; // alone it would link the other two
  const Relations c = run(chain, o);
  check_equal(c.directions.size(), 2u, "directions of a chain of 7 degrees");
  check(c.direction_of[0] != c.direction_of[2], "the ends of the chain stay apart");
  check_equal(run(chain, all_on(.001)).directions.size(), 3u, "directions of a chain that is not worth it");
}

BOOST_AUTO_TEST_CASE(orthogonal)
{
  for(int seed = 0; seed < 50; ++seed) {
    const Relations r = run(tilted_box(seed), all_on(200));
    check_tables(r, 6, "box " + std::to_string(seed));
    check_equal(r.directions.size(), 3u, "directions of box " + std::to_string(seed));
    check_equal(orthogonal_pairs(r.directions).size(), 3u, "right angles of box " + std::to_string(seed));
    check_equal(r.planes.size(), 6u, "planes of box " + std::to_string(seed));
  }
  // a master with two followers 40 degrees apart, neither of them exact before
  const Relations r = run({{polar(0, 89), {0, 0, 0}, 40 * epsilon, 40 * epsilon, 200, 9000},
                           {polar(10, 1), {1e6, 0, 0}, 20000, 9000},
                           {polar(50, -1), {2e6, 0, 0}, 20000, 9000}},
                          all_on(400));
  check_equal(r.directions.size(), 3u, "directions of master and followers");
  check_equal(orthogonal_pairs(r.directions).size(), 2u, "right angles of master and followers");
  check(std::fabs(dot(r.directions[1], r.directions[2]) - cosine_deg(40)) < 0.03, "followers keep their angle");
}

// Gabled roofs on two walls: each roof plane is orthogonal to one wall, not to the other.
BOOST_AUTO_TEST_CASE(chained_frames)
{
  for(int seed = 0; seed < 50; ++seed) {
    std::vector<Rectangle> house = tilted_box(seed);
    const Vector n[3] = {house[0].normal, house[2].normal, house[4].normal};
    for(double tilt : {35.0, -35.0, 20.0})
      house.push_back(
        {add_scaled(cosine_deg(tilt) * n[2], sine_deg(tilt), n[0]), {3e5, tilt * 1e4, 0}, 9000, 7000, 150, 300});
    const Relations r = run(house, all_on(200));
    check_equal(r.directions.size(), 6u, "directions of house " + std::to_string(seed));
    check_equal(inexact_pairs(r, 4), 0, "nearly orthogonal pairs of house " + std::to_string(seed));
    check_equal(orthogonal_pairs(r.directions).size(), 6u, "right angles of house " + std::to_string(seed));
  }
}

BOOST_AUTO_TEST_CASE(houses_of_a_village)
{
  const std::vector<Rectangle> faces = village();
  for(double price : {5., 10., 20., 40.}) {
    const Relations r = run(faces, all_on(price));
    check_tables(r, faces.size(), "village");
    check_equal(r.directions.size(), 65u, "directions of the village, price " + std::to_string(price));
    check_equal(inexact_pairs(r, 0.3), 0, "nearly orthogonal pairs of the village");
  }
}

BOOST_AUTO_TEST_CASE(coplanar)
{
  auto flat = [](double z, double x) {
    return Rectangle{{0, 0.001, 1}, {x * epsilon, 0, z * epsilon}, 5 * epsilon, 5 * epsilon, 100};
  };
  const Relations r = run({flat(0, 0), flat(0.5, 50), flat(3.5, 100), flat(7, 0), flat(8.3, 50)}, all_on(260));
  check_tables(r, 5, "coplanar");
  check_equal(r.plane_of[1], r.plane_of[0], "half an epsilon apart");
  check_equal(r.planes.size(), 4u, "planes; 3 and 1.3 epsilon apart");
  check_close(r.planes[0].offset / epsilon, 0.25, 0.06, "mean offset");
  // the 2000 points of each are moved by a quarter of epsilon, which costs 250 in all
  const Relations costly = run({flat(0, 0), flat(0.5, 50)}, all_on(240));
  check_equal(costly.planes.size(), 2u, "planes that are not worth one");
  check_equal(costly.directions.size(), 1u, "they stay parallel");
}

BOOST_AUTO_TEST_CASE(switches)
{
  const std::vector<Rectangle> box = tilted_box(9);
  Regularity_options o = all_on(200);
  o.orthogonality = false;
  check_equal(orthogonal_pairs(run(box, o).directions).size(), 0u, "right angles, orthogonality off");
  check_equal(run(box, o).directions.size(), 3u, "directions, orthogonality off");
  o.parallelism = false;
  check_equal(run(box, o).directions.size(), 6u, "directions, all off");
  o = all_on(200);
  o.parallelism = false;
  check(orthogonal_pairs(run(box, o).directions).size() >= 3, "right angles, parallelism off");
  o.parallelism = true;
  o.angle_tolerance_deg = 0;
  check_equal(run(box, o).directions.size(), 6u, "directions, no tolerance");
}

BOOST_AUTO_TEST_CASE(degenerate)
{
  check_equal(run(Shape_fits()).planes.size(), 0u, "planes of nothing");
  Shape_fit point = {};
  point.scatter.count = 5;
  point.fit = fit_plane(point.scatter);
  Shape_fit empty = {};
  const Shape_fits shapes = {point, empty, make_shape({{0, 0, 1}, {0, 0, 0}}), point};
  const Relations r = run(shapes);
  check_equal(r.direction_of.size(), 4u, "shapes, some of them degenerate");
  for(double w : {0.0, 1e-9}) { // flat faces
    Rectangle a{{0, 0, 1}, {0, 0, 0}}, b{{w, 0, 1}, {5e5, 0, 0}};
    a.noise = b.noise = 0;
    check_equal(run({a, b}).directions.size(), 1u, "directions of flat faces");
  }
}

BOOST_AUTO_TEST_SUITE_END()
