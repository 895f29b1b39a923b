// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The regularity step as a whole, on analytic sets of shapes: coplanar ones, switches, degenerate input, and that
// neither the order of the shapes nor the compiler matters.

#include "testing/rectangles.h"

#include <cstdio>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_regularity)

using namespace CGAL::Tandem::internal;

namespace {

BOOST_AUTO_TEST_CASE(test_coplanar)
{
  auto flat = [](double z, double x) {
    return Rectangle{{0, 0.001, 1}, {x * epsilon, 0, z * epsilon}, 5 * epsilon, 5 * epsilon, 100};
  };
  const Relations r = run({flat(0, 0), flat(0.5, 50), flat(3.5, 100), flat(7, 0), flat(8.3, 50)}, all_on(260));
  check_tables(r, 5, "coplanar");
  check_equal(r.plane_of[1], r.plane_of[0], "half an epsilon apart");
  check_equal(double(r.planes.size()), 4, "planes; 3 and 1.3 epsilon apart");
  check_close(r.planes[0].offset / epsilon, 0.25, 0.06, "mean offset");
  // the 2000 points of each are moved by a quarter of epsilon, which costs 250 in all
  const Relations costly = run({flat(0, 0), flat(0.5, 50)}, all_on(240));
  check_equal(double(costly.planes.size()), 2, "planes that are not worth one");
  check_equal(double(costly.directions.size()), 1, "they stay parallel");
}

BOOST_AUTO_TEST_CASE(test_switches)
{
  const std::vector<Rectangle> box = tilted_box(9);
  Regularity_options o = all_on(200);
  o.orthogonality = false;
  check_equal(double(orthogonal_pairs(run(box, o).directions).size()), 0, "right angles, orthogonality off");
  check_equal(double(run(box, o).directions.size()), 3, "directions, orthogonality off");
  o.parallelism = false;
  check_equal(double(run(box, o).directions.size()), 6, "directions, all off");
  o = all_on(200);
  o.parallelism = false;
  check(orthogonal_pairs(run(box, o).directions).size() >= 3, "right angles, parallelism off");
  o.parallelism = true;
  o.angle_tolerance_deg = 0;
  check_equal(double(run(box, o).directions.size()), 6, "directions, no tolerance");
}

BOOST_AUTO_TEST_CASE(test_degenerate)
{
  check_equal(double(run(Shape_fits()).planes.size()), 0, "planes of nothing");
  Shape_fit point = {};
  point.scatter.count = 5;
  point.fit = fit_plane(point.scatter);
  Shape_fit empty = {};
  const Shape_fits shapes = {point, empty, make_shape({{0, 0, 1}, {0, 0, 0}}), point};
  const Relations r = run(shapes);
  check_equal(double(r.direction_of.size()), 4, "shapes, some of them degenerate");
  for(double w : {0.0, 1e-9}) { // flat faces
    Rectangle a{{0, 0, 1}, {0, 0, 0}}, b{{w, 0, 1}, {5e5, 0, 0}};
    a.noise = b.noise = 0;
    check_equal(double(run({a, b}).directions.size()), 1, "directions of flat faces");
  }
}

// The partition may not depend on the order of the shapes.
BOOST_AUTO_TEST_CASE(test_permutation)
{
  const std::vector<Rectangle> faces = village();
  const Relations r = run(faces);
  std::mt19937 random(17);
  for(int trial = 0; trial < 5; ++trial) {
    std::vector<int> order(faces.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    std::vector<Rectangle> shuffled;
    for(int i : order)
      shuffled.push_back(faces[i]);
    const Relations s = run(shuffled);
    check_equal(double(s.directions.size()), double(r.directions.size()), "directions after a permutation");
    std::set<std::pair<int, int>> pairs, planes;
    for(std::size_t k = 0; k < order.size(); ++k) {
      pairs.insert({s.direction_of[k], r.direction_of[order[k]]});
      planes.insert({s.plane_of[k], r.plane_of[order[k]]});
    }
    check_equal(double(pairs.size()), double(r.directions.size()), "parallel groups match one to one");
    check_equal(double(planes.size()), double(r.planes.size()), "coplanar groups match one to one");
  }
}

std::uint64_t hash(const Relations& r)
{
  std::uint64_t h = 1469598103934665603ull;
  auto add = [&](const void* data, std::size_t n) {
    for(std::size_t i = 0; i < n; ++i)
      h = (h ^ static_cast<const unsigned char*>(data)[i]) * 1099511628211ull;
  };
  add(r.directions.data(), r.directions.size() * sizeof(Vector));
  for(const Regular_plane& p : r.planes)
    add(&p, sizeof p);
  add(r.direction_of.data(), r.direction_of.size() * sizeof(int));
  add(r.plane_of.data(), r.plane_of.size() * sizeof(int));
  return h;
}

// Inputs of exact integers, so that the hash is the same with all compilers and flags.
Shape_fits integer_scene(int n)
{
  std::mt19937 random(23);
  auto below = [&](int m) { return std::int32_t(random() % std::uint32_t(m)); };
  Shape_fits shapes;
  for(int i = 0; i < n; ++i) {
    const int turn = 50 * (i % 16), size = 50 + below(500);
    std::int32_t u[3] = {1000 - turn / 3, turn, 0}, v[3] = {0, 0, 1000}; // walls, floors, roofs, anything
    for(int k = 0; k < 3; ++k) {
      if(i % 4 == 1)
        v[k] = k == 0 ? -turn : k == 1 ? 1000 - turn / 3 : 0;
      else if(i % 4 == 2)
        v[k] = k == 0 ? -turn / 2 : k == 1 ? 500 : 400;
      u[k] += below(i % 4 == 3 && i % 3 == 0 ? 2000 : 30);
      v[k] += below(30);
    }
    const std::int32_t base[3] = {below(1 << 24), below(1 << 24), 3000 * below(30)};
    Moments m;
    for(int k = 0; k < 60; ++k) {
      const std::int32_t a = below(2 * size) - size, b = below(2 * size) - size;
      m.add({base[0] + (a * u[0] + b * v[0]) / 20 + below(400), base[1] + (a * u[1] + b * v[1]) / 20 + below(400),
             base[2] + (a * u[2] + b * v[2]) / 20 + below(400), 0});
    }
    const Scatter s = make_scatter(m);
    shapes.push_back({s, fit_plane(s)});
  }
  return shapes;
}

BOOST_AUTO_TEST_CASE(print_hash)
{
  const Shape_fits shapes = integer_scene(600);
  const Relations r = run(shapes);
  check_tables(r, shapes.size(), "integer scene");
  std::printf("hash %016llx: %zu shapes, %zu directions, %zu right angles, %zu planes\n", (unsigned long long)hash(r),
              shapes.size(), r.directions.size(), orthogonal_pairs(r.directions).size(), r.planes.size());
  check_equal(double(hash(run(shapes)) == hash(r)), 1, "same bits twice");
}

} // namespace

BOOST_AUTO_TEST_SUITE_END()
