// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Estimated normals on scenes with known faces, and of degenerate clouds. engine/test_same_bits has their bits.

#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/neighbors/estimate_normals.h>
#include <CGAL/Tandem/internal/neighbors/find_neighbors.h>

#include "testing/checks.h"
#include "testing/turned_box.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
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

std::vector<Grid_point> with_normals(std::vector<Grid_point> points, int k = tuning::normals::maximum_neighbors)
{
  Sequential_backend backend;
  std::vector<std::uint32_t> neighbors(points.size() * std::size_t(k) + 1);
  find_neighbors(backend, points.data(), std::uint32_t(points.size()), k, neighbors.data());
  const Cloud_view cloud = {
    points.data(), neighbors.data(), std::uint32_t(points.size()), k, {points.data(), nullptr, nullptr}};
  estimate_normals(backend, cloud, points.data(), epsilon, Ranks<Sequential_backend>(backend));
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

// Shares of normals that are within 25 and 10 degrees.
BOOST_AUTO_TEST_CASE(quality)
{
  for(const auto& [options, minimum_25, minimum_10] :
      {std::make_tuple(Box_options{20000, 0, 0}, .99, .99), std::make_tuple(Box_options{20000, 2000, 64}, .98, .98),
       std::make_tuple(Box_options{40000, 10000, 300}, .95, .94)}) {
    std::vector<Item> items = make_box(options);
    sort_along_curve(items);
    const std::vector<Grid_point> points = with_normals(points_of(items));
    const double share_25 = good_share(items, points, cos_25), share_10 = good_share(items, points, cos_10);
    CHECK_AT(share_25 >= minimum_25 && share_10 >= minimum_10,
             std::to_string(share_25) + " and " + std::to_string(share_10) + " of the normals are good");
  }
}

// Clutter off a face by more than the noise must not look like the face.
BOOST_AUTO_TEST_CASE(clutter)
{
  const std::int64_t sigma = 256;
  std::vector<Item> items = make_box({30000, 30000, sigma});
  sort_along_curve(items);
  const std::vector<Grid_point> points = with_normals(points_of(items));
  const double outside = aligned_clutter(items, points, 3.5 * sigma, 7 * sigma);
  CHECK_AT(outside < .25, std::to_string(outside));
  CHECK_AT(good_share(items, points, cos_25) > .93, std::to_string(good_share(items, points, cos_25)));
}

void check_no_normals(const char* test, const std::vector<Grid_point>& points)
{
  for(const Grid_point& p : with_normals(points))
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
      const std::vector<Grid_point> r = with_normals(points_of(items), k);
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

BOOST_AUTO_TEST_SUITE_END()
