// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Estimated normals on scenes with known faces, and of degenerate clouds. engine/test_same_bits has their bits.

#include "testing/body_fixture.h"

#include <tuple>

BOOST_AUTO_TEST_SUITE(test_normals)

using namespace CGAL::Tandem::internal;
using scenes::Vec;

constexpr double epsilon = 1024; // in steps of the grid

const Vec box_size = {60 * epsilon, 40 * epsilon, 24 * epsilon};
const scenes::Frame frame = scenes::Frame().turned({1, 2, 3}, .4);

Grid_point on_grid(const Vec& p) { return {std::int32_t(p.x), std::int32_t(p.y), std::int32_t(p.z), no_normal}; }

// Along the curve, and the order that this is.
std::vector<Grid_point> sorted(const std::vector<Grid_point>& points, std::vector<std::size_t>* order = nullptr)
{
  Fixture f;
  const std::vector<std::size_t> found = set_points(f, points, 1, 64);
  if(order != nullptr)
    *order = found;
  return f.point;
}

// The noisy faces of a turned box, and clutter around it.
struct Box_cloud {
  std::vector<Grid_point> points;
  std::vector<int> face;      // axis of its normal; of clutter, that of the nearest face that it is over
  std::vector<double> height; // of clutter over that face, -1 for the points of a face

  Box_cloud(std::size_t size, double clutter, double sigma)
  {
    scenes::Model model;
    model.add_box_faces(frame, {0, 0, 0}, box_size, scenes::side_all);
    scenes::Options options = scene_options(size, 0, clutter);
    options.noise = sigma / scenes::make_scene(model, scene_options(1)).diagonal;
    const scenes::Scene scene = scenes::make_scene(model, options);
    for(const Vec& p : scene.points)
      points.push_back(on_grid(p));
    std::vector<std::size_t> order;
    points = sorted(points, &order);
    for(const std::size_t i : order) {
      face.push_back(scene.label[i] / 2);
      height.push_back(scene.label[i] < 0 ? 1e9 : -1);
      if(scene.label[i] < 0)
        find_face(scene.points[i]);
    }
  }

private:
  void find_face(const Vec& p)
  {
    const double c[3] = {dot(p, frame.x), dot(p, frame.y), dot(p, frame.z)},
                 size[] = {box_size.x, box_size.y, box_size.z};
    const auto is_within = [&](int k) { return c[k] > 0 && c[k] < size[k]; };
    for(int k = 0; k < 3; ++k) {
      const double over = (std::min)(std::fabs(c[k]), std::fabs(c[k] - size[k]));
      if(is_within((k + 1) % 3) && is_within((k + 2) % 3) && over < height.back()) {
        face.back() = k;
        height.back() = over;
      }
    }
  }
};

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

double cosine(const Grid_point& p, int axis)
{
  const Int_vector n = decode_normal(p.normal);
  const Vec v = {double(n.x), double(n.y), double(n.z)}, t = axis == 0 ? frame.x : axis == 1 ? frame.y : frame.z;
  return length(v) > 0 ? std::fabs(dot(v, t)) / length(v) : 0;
}

// The ratio of points with normals within the angle of their face's, of those between two heights over it.
double good_ratio(const Box_cloud& box, const std::vector<Grid_point>& points, double minimum_cosine, double low = -1,
                  double high = 0)
{
  double all = 0, good = 0;
  for(std::size_t i = 0; i < points.size(); ++i)
    if(box.height[i] >= low && box.height[i] < high) {
      ++all;
      good += cosine(points[i], box.face[i]) >= minimum_cosine;
    }
  return good / all;
}

// Ratios of normals that are within 25 and 10 degrees.
BOOST_AUTO_TEST_CASE(quality)
{
  for(const auto& [size, ratio, sigma, minimum_25, minimum_10] :
      {std::make_tuple(20000, 0., 0., .99, .99), std::make_tuple(22000, .1, 64., .98, .98),
       std::make_tuple(50000, .2, 300., .95, .94)}) {
    const Box_cloud box(std::size_t(size), ratio, sigma);
    const std::vector<Grid_point> points = with_normals(box.points);
    const double ratio_25 = good_ratio(box, points, cos_25), ratio_10 = good_ratio(box, points, cos_10);
    CHECK_AT(ratio_25 >= minimum_25 && ratio_10 >= minimum_10,
             std::to_string(ratio_25) + " and " + std::to_string(ratio_10) + " of the normals are good");
  }
}

// Clutter off a face by more than the noise must not look like the face.
BOOST_AUTO_TEST_CASE(clutter)
{
  const double sigma = 256;
  const Box_cloud box(90000, .67, sigma);
  const std::vector<Grid_point> points = with_normals(box.points);
  const double outside = good_ratio(box, points, cos_25, 3.5 * sigma, 7 * sigma),
               good = good_ratio(box, points, cos_25);
  CHECK_AT(outside < .25 && good > .93, std::to_string(outside) + " of clutter, " + std::to_string(good) + " of faces");
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
      std::vector<Grid_point> points;
      for(std::int32_t i = -20; i < 20; ++i)
        for(std::int32_t j = -20; j < 20; ++j)
          points.push_back({i * spacing, (2 * j + (i & 1)) * spacing, 2 * i * spacing, 0});
      for(const Grid_point& p : with_normals(sorted(points), k)) {
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
  scenes::Random random(5);
  for(int i = 0; i < 20000; ++i) {
    const auto any_size = [&] { return double(1 << random.bits() % 20); };
    const Vec size = {any_size(), any_size(), any_size()};
    Neighborhood_sum sum;
    Moments moments;
    for(int j = 0; j < 13; ++j) {
      const auto any = [&] { return 2 * random.uniform() - 1; };
      const Grid_point p = on_grid(frame.vector({size.x * any(), size.y * any(), size.z * any()}));
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
