// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Estimated normals on scenes with known faces, against the plane of 20 neighbors;
// degenerate clouds; the same bits from all back ends and compilers.

#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/backend/Tbb_backend.h>
#include <CGAL/Tandem/internal/neighbors/estimate_normals.h>
#include <CGAL/Tandem/internal/neighbors/find_neighbors.h>

#include "testing/checks.h"
#include "testing/turned_box.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_normals)

using namespace CGAL::Tandem::internal;
using namespace turned_box;

constexpr double epsilon = 1024; // in steps of the grid

std::vector<Grid_point> points_of(const std::vector<Item>& items)
{
  std::vector<Grid_point> points;
  for(const Item& e : items)
    points.push_back(e.point);
  return points;
}

template <class Backend>
std::vector<Grid_point> with_normals(std::vector<Grid_point> points, int k = tuning::normals::maximum_neighbors)
{
  Backend backend;
  std::vector<std::uint32_t> neighbors(points.size() * std::size_t(k) + 1);
  find_neighbors(backend, points.data(), std::uint32_t(points.size()), k, neighbors.data());
  const Cloud_view cloud = {
    points.data(), neighbors.data(), std::uint32_t(points.size()), k, {points.data(), nullptr, nullptr}};
  estimate_normals(backend, cloud, points.data(), epsilon, Ranks<Backend>(backend));
  return points;
}

// What everybody does.
std::vector<Grid_point> with_pca_normals(std::vector<Grid_point> points)
{
  constexpr int k = 20;
  Sequential_backend backend;
  std::vector<std::uint32_t> neighbors(points.size() * k);
  find_neighbors(backend, points.data(), std::uint32_t(points.size()), k, neighbors.data());
  for(std::size_t i = 0; i < points.size(); ++i) {
    Moments m;
    m.add(points[i]);
    for(int j = 0; j < k; ++j)
      m.add(points[neighbors[i * k + std::size_t(j)]]);
    points[i].normal = encode_normal(fit_plane(make_scatter(m)).normal);
  }
  return points;
}

constexpr double cos_10 = .98481, cos_25 = .90631;

double cosine(const Grid_point& p, int a)
{
  const Int_vector n = decode_normal(p.normal);
  const Vector v = {double(n.x), double(n.y), double(n.z)};
  const Vector t = {axis[a][0] / 25., axis[a][1] / 25., axis[a][2] / 25.};
  return length(v) > 0 ? std::fabs(dot(v, t)) / length(v) : 0;
}

// The share of face points whose normal is within the angle of their face's.
double good_share(const std::vector<Item>& items, const std::vector<Grid_point>& points, double minimum_cosine)
{
  double faces = 0, good = 0;
  for(std::size_t i = 0; i < items.size(); ++i)
    if(items[i].height < 0) {
      ++faces;
      good += cosine(points[i], items[i].face) >= minimum_cosine;
    }
  return good / faces;
}

// The share of clutter between two heights over a face that is aligned with it.
double aligned_clutter(const std::vector<Item>& items, const std::vector<Grid_point>& points, double low, double high)
{
  double all = 0, aligned = 0;
  for(std::size_t i = 0; i < items.size(); ++i)
    if(items[i].height >= low && items[i].height < high) {
      ++all;
      aligned += cosine(points[i], items[i].face) >= cos_25;
    }
  return aligned / all;
}

struct Quality {
  const char* name;
  Box_options options;
  double minimum_25, minimum_10; // and better than the plane of 20 neighbors by the margins
  double margin_25, margin_10;
};

BOOST_AUTO_TEST_CASE(quality)
{
  for(const Quality& q : {Quality{"clean", {20000, 0, 0}, .99, .99, .03, .08},
                          Quality{"little noise", {20000, 2000, 64}, .98, .98, .03, .05},
                          Quality{"noise", {40000, 10000, 300}, .95, .94, .04, .4}}) {
    std::vector<Item> items = make_box(q.options);
    sort_along_curve(items);
    const std::vector<Grid_point> points = with_normals<Sequential_backend>(points_of(items)),
                                  peer = with_pca_normals(points_of(items));
    const auto check = [&](double minimum_cosine, double minimum, double margin) {
      const double good = good_share(items, points, minimum_cosine), peers = good_share(items, peer, minimum_cosine);
      CHECK_AT(good >= minimum && good >= peers + margin, q.name + (": " + std::to_string(good)) +
                                                            " of the normals are good, by the plane of 20 neighbors " +
                                                            std::to_string(peers));
    };
    check(cos_25, q.minimum_25, q.margin_25);
    check(cos_10, q.minimum_10, q.margin_10);
  }
}

// Clutter off a face by more than the noise must not look like the face.
BOOST_AUTO_TEST_CASE(clutter)
{
  const std::int64_t sigma = 256;
  std::vector<Item> items = make_box({30000, 30000, sigma});
  sort_along_curve(items);
  const std::vector<Grid_point> points = with_normals<Sequential_backend>(points_of(items));
  const double outside = aligned_clutter(items, points, 3.5 * sigma, 7 * sigma);
  CHECK_AT(outside < .25, std::to_string(outside));
  CHECK_AT(good_share(items, points, cos_25) > .93, std::to_string(good_share(items, points, cos_25)));
}

void check_no_normals(const char* test, const std::vector<Grid_point>& points)
{
  for(const Grid_point& p : with_normals<Sequential_backend>(points))
    CHECK_AT(p.normal == no_normal, test + (": a normal out of nothing, " + std::to_string(p.normal)));
}

BOOST_AUTO_TEST_CASE(degenerate_points)
{
  check_no_normals("empty", {});
  check_no_normals("one point", {{5, -7, 9, 0}});
  check_no_normals("two points", {{5, -7, 9, 0}, {2000, 9, 4, 0}});
  check_no_normals("all equal", std::vector<Grid_point>(200, Grid_point{1, 2, 3, 0}));
  std::vector<Grid_point> line, rounded_line, far_pair;
  for(int i = 0; i < 300; ++i) {
    line.push_back({i * 3000, i * -2000, i * 1000, 0});
    rounded_line.push_back({i * 3000, std::int32_t(i * 2000. / 7), std::int32_t(i * -500. / 3), 0});
    const std::int32_t end = i % 2 ? (1 << 29) - 1 : -(1 << 29);
    far_pair.push_back({end, end, end, 0});
  }
  check_no_normals("line", line);
  check_no_normals("line, rounded", rounded_line);
  check_no_normals("two places", far_pair);
}

// Flat grids: every normal is exact, also where neighbors are many, few, or far apart.
BOOST_AUTO_TEST_CASE(flat_grids)
{
  for(const std::int32_t spacing : {1, 1000, 1 << 22})
    for(const int k : {3, 6, 12, 20}) {
      std::vector<Item> items;
      for(std::int32_t i = -20; i < 20; ++i)
        for(std::int32_t j = -20; j < 20; ++j)
          items.push_back({{i * spacing, (2 * j + (i & 1)) * spacing, 2 * i * spacing, 0}, 0, -1});
      sort_along_curve(items);
      const std::vector<Grid_point> r = with_normals<Sequential_backend>(points_of(items), k);
      for(const Grid_point& p : r) {
        const Int_vector n = decode_normal(p.normal);
        const Vector v = unit({double(n.x), double(n.y), double(n.z)});
        const double sine = length(cross(v, unit({2, 0, -1})));
        CHECK_AT(length(v) > 0 && sine < 2e-4, std::to_string(sine));
      }
    }
}

// thickness() and plane_normal() against Jacobi, from round to flat to thin.
BOOST_AUTO_TEST_CASE(solver)
{
  Random random(5);
  for(int i = 0; i < 20000; ++i) {
    const int bits[3] = {int(random.below(20)), int(random.below(20)), int(random.below(20))};
    Neighborhood_sum sum;
    Moments moments;
    for(int j = 0; j < 13; ++j) {
      std::int64_t c[3];
      for(int a = 0; a < 3; ++a)
        c[a] = random.below(std::int64_t(2) << bits[a]) - (std::int64_t(1) << bits[a]);
      const Grid_point p = turned(c);
      sum.add({float(p.x), float(p.y), float(p.z)});
      moments.add(p);
    }
    const Neighborhood h = sum.mean();
    const Eigen_system e = eigen_system(make_scatter(moments).matrix);
    const double value[3] = {e.value[0] / 13, e.value[1] / 13, e.value[2] / 13};
    const Thickness t = thickness(h);
    if(value[1] < 1 || value[1] < 4e-6 * value[2])
      continue;
    const double allowed = 2e-6 * value[2];
    CHECK_AT(std::fabs(t.smallest - value[0]) <= allowed + 1e-3 * value[0], std::to_string(i));
    CHECK_AT(std::fabs(t.middle - value[1]) <= allowed + 1e-2 * value[1], std::to_string(i));
    const Float_vector n = plane_normal(h, t.smallest);
    const Vector v = unit({n.x, n.y, n.z});
    if(value[1] - value[0] < .01 * value[1] + 100 * allowed)
      continue;
    CHECK_AT(std::fabs(dot(v, e.vector[0])) > 1 - 1e-3, std::to_string(i));
  }
}

std::uint64_t hash_of(const std::vector<Grid_point>& points)
{
  std::uint64_t h = 1469598103934665603u;
  for(const Grid_point& p : points)
    h = (h ^ p.normal) * 1099511628211u;
  return h;
}

BOOST_AUTO_TEST_CASE(same_bits)
{
  std::vector<Item> items = make_box({20000, 4000, 256});
  sort_along_curve(items);
  const std::vector<Grid_point> sequential = with_normals<Sequential_backend>(points_of(items));
  const std::vector<Grid_point> parallel = with_normals<Tbb_backend>(points_of(items));
  for(std::size_t i = 0; i < items.size(); ++i)
    CHECK_AT(sequential[i].normal == parallel[i].normal, "back ends differ at " + std::to_string(i));
  // Changes with the method; must not change with the compiler, its options or the machine.
  const std::uint64_t expected = 0x667ecc6034502174u;
  check_equal(hash_of(sequential), expected, "hash");
}

BOOST_AUTO_TEST_SUITE_END()
