// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is measured of a result, with and without surfels, and why points have no shape, against plain loops on several
// back ends. The uncertainty of planes: generated planes of known noise, whose
// errors are as large as is said, and points that determine no plane.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/result/explain_free_points.h>
#include <CGAL/Tandem/internal/result/measure_planes.h>

#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_measures)

using namespace CGAL::Tandem::internal;
using CGAL::Tandem::Plane_uncertainty;

using Counts = std::array<std::int64_t, free_reason::size>;

// Surfels of three points each, at the first of them, with the labels of these; some points have lost theirs.
struct Surfels_of_three {
  std::vector<Grid_point> point;
  std::vector<std::uint32_t> first, surfel, neighbor, label, point_label;
  std::vector<std::uint8_t> level; // by surfel: of the smallest tolerance of its points; empty without levels
  std::vector<Range> cells;
  Cloud_view cloud;

  explicit Surfels_of_three(const Fixture& f)
  {
    for(std::uint32_t p = 0; p < f.point.size(); ++p) {
      if(p % 3 == 0) {
        first.push_back(p);
        point.push_back(f.point[p]);
        label.push_back(f.label[p]);
        if(!f.level.empty())
          level.push_back(f.level[p]);
      }
      if(!level.empty())
        level.back() = (std::max)(level.back(), f.level[p]);
      surfel.push_back(std::uint32_t(point.size() - 1));
      point_label.push_back(p % 5 == 0 ? locked_label : label.back());
    }
    first.push_back(std::uint32_t(f.point.size()));
    const std::uint32_t size = std::uint32_t(point.size());
    neighbor.resize(size * std::size_t(f.cloud.k));
    Sequential_backend backend;
    find_neighbors(backend, point.data(), size, f.cloud.k, neighbor.data());
    for(const Range& cell : f.cells)
      cells.push_back({(cell.first + 2) / 3, (cell.last + 2) / 3});
    cloud = {point.data(), neighbor.data(), size, f.cloud.k, {f.point.data(), first.data(), surfel.data()}};
    cloud.level = level.empty() ? nullptr : level.data();
    cloud.surfels.level = f.cloud.surfels.level;
  }
};

free_reason::Reason reason(const Fixture& f, const Explain_free_points& by, std::uint32_t i, std::uint32_t at,
                           const Grid_point& p)
{
  if(p.normal == no_normal)
    return free_reason::without_normal;
  const Plane own = own_plane(p);
  const double cosine = std::sqrt(double(f.tolerance.squared_cosine)) / 65536;
  const double twice = std::cos(2 * std::acos(cosine));
  const Tolerance own_tolerance = f.tolerance_of(at),
                  wide = {2 * own_tolerance.distance, std::int64_t(twice * twice * 4294967296.)};
  std::vector<std::uint32_t> near = {by.shapes.shape[i]};
  int all = 0, fitting = 0;
  for(const std::uint32_t* q = by.cloud.row(i); q != by.cloud.row(i) + by.cloud.k && *q != no_index; ++q, ++all) {
    near.push_back(by.shapes.shape[*q]);
    fitting += fits(own, by.cloud.point[*q], own_tolerance);
  }
  for(const std::uint32_t s : near)
    if(by.has_given_normals && s != no_index && is_near(f.plane[s], p, own_tolerance.distance) &&
       !fits(f.plane[s], p, own_tolerance))
      return free_reason::misaligned;
  for(const std::uint32_t s : near)
    if(s != no_index && fits(f.plane[s], p, wide))
      return free_reason::misfit;
  return fitting == 0         ? free_reason::without_neighbors
         : fitting > all / 2. ? free_reason::in_small_regions
                              : free_reason::clutter;
}

// Every second label is a shape of the result, of half its number. Some points have no normal.
template <class Backend>
void check_result(Backend& backend, const std::string& name, const Fixture& f, Cloud_view cloud,
                  const std::vector<Range>& cells, const Labels_of_points& labels)
{
  std::vector<std::uint32_t> shape;
  for(std::uint32_t i = 0; i < cloud.size; ++i)
    shape.push_back(labels.label[i] < first_mark && labels.label[i] % 2 == 0 ? labels.label[i] / 2 : no_index);
  std::vector<Grid_point> point(f.point);
  for(std::size_t p = 0; p < point.size(); p += 11)
    point[p].normal = no_normal;
  cloud.surfels.point = point.data();
  const std::uint32_t points = std::uint32_t(point.size());
  std::vector<Shared_moments> sums(f.plane.size());
  for(const bool has_given_normals : {true, false}) {
    const Explain_free_points explain = {cloud, {labels, shape.data()}, f.plane.data(), f.tolerance, has_given_normals};
    Counts expected = {};
    for(std::uint32_t p = 0; p < points; ++p) {
      const std::uint32_t i = cloud.surfels.of_point(p);
      if(shape[i] == no_index || (labels.point_label != nullptr && labels.point_label[p] != labels.label[i]))
        ++expected[reason(f, explain, i, p, point[p])];
      else if(has_given_normals)
        add_point(sums[shape[i]], point[p], 1, cloud.surfels.level_of_point(p));
    }
    const Counts got = backend.template sum<free_reason::size>(points, explain);
    for(std::size_t r = 0; r < free_reason::size; ++r)
      check_equal(got[r], expected[r], name + ": reason " + std::to_string(r));
    CHECK_AT(got[free_reason::misfit] > 0 || points < 100, name);
    CHECK_AT(got[free_reason::misaligned] > 0 ? has_given_normals : !has_given_normals || points < 100, name);
  }
  for(const std::uint32_t parts : {1u, 3u}) {
    std::vector<Shared_moments> sum(sums.size());
    backend.template for_each_cell<Moment_table>(
      parts * cells.size(),
      Sum_moments<Backend>{cloud, {cells.data(), nullptr, parts}, {labels, shape.data()}, sum.data()});
    check_moments(sum, sums, name);
  }
}

BOOST_AUTO_TEST_CASE(bodies)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    const Surfels_of_three s(f);
    check_result(backend, name, f, f.cloud, f.cells, {f.cloud.surfels, f.label.data(), nullptr});
    check_result(backend, name + ", surfels", f, s.cloud, s.cells,
                 {s.cloud.surfels, s.label.data(), s.point_label.data()});
  });
}

BOOST_AUTO_TEST_CASE(doubled_tolerance)
{
  for(const double angle : {.5, 10., 25., 44.9, 45., 60., 89.}) {
    const Tolerance t = doubled(make_tolerance(7, cosine_deg(angle)));
    check_equal(t.distance, make_tolerance(14, 1).distance, "distance");
    const double cosine = angle < 45 ? cosine_deg(2 * angle) : 0;
    CHECK_AT(std::fabs(double(t.squared_cosine) - cosine * cosine * 4294967296.) <= 8, std::to_string(angle));
  }
}

// v' C v
double form(const std::array<double, 6>& c, const Vector& v)
{
  return quadratic_form({c[0], c[1], c[2], c[3], c[4], c[5]}, v);
}

Plane_uncertainty uncertainty_of(const std::vector<Grid_point>& points, double offset = 0)
{
  Moments m;
  for(const Grid_point& p : points)
    m.add(p);
  return plane_uncertainty(make_scatter(m), {{0, 0, 1}, offset}, 50);
}

BOOST_AUTO_TEST_CASE(degenerate_points)
{
  std::vector<Grid_point> points = {{0, 0, 0, 0}, {1000, 0, 0, 0}, {0, 1000, 0, 0}};
  const Plane_uncertainty three = uncertainty_of(points);
  CHECK(three.noise == 50 && std::fabs(three.offset_deviation - 50 / std::sqrt(3.)) < 1e-9 && three.angle_deg > 1);
  points.push_back({1000, 1000, 0, 0});
  const Plane_uncertainty exact = uncertainty_of(points);
  CHECK(exact.noise == 0 && exact.offset_deviation == 0 && exact.angle_deg == 0);
  const Plane_uncertainty moved = uncertainty_of(points, 10); // by relations
  CHECK(moved.noise == 20 && moved.offset_deviation == 10);
  std::vector<Grid_point> line, cluster;
  for(int i = 0; i < 100; ++i) {
    line.push_back({3 * i, 7 * i, 0, 0});
    cluster.push_back({i % 5, i / 5 % 5, i / 25 * 100, 0});
  }
  const Plane_uncertainty u = uncertainty_of(line), v = uncertainty_of(cluster);
  const double degrees = 180 / std::acos(-1.);
  CHECK(std::fabs(u.angle_deg - degrees) < 1e-9 && std::fabs(v.angle_deg - degrees) < 1e-9);
  CHECK(std::fabs(form(u.normal_covariance, unit({7, -3, 0})) - 1) < 1e-9); // nothing is known about the line ...
  CHECK(form(u.normal_covariance, unit({3, 7, 0})) < 1e-9);                 // ... but along it
  CHECK(std::fabs(v.normal_covariance[0] - 1) < 1e-9 && std::fabs(v.normal_covariance[3] - 1) < 1e-9);
}

// Planes of a rectangle of 1 by `width`, with noise across it, or in all directions. In the mean, the squared error of
// the normal by its covariance is 2, that of the offset by its variance 1, and noise^2 that of the points, each within
// four standard deviations.
BOOST_AUTO_TEST_CASE(noise)
{
  scenes::Random random(46);
  for(const auto& [width, noise, is_isotropic] :
      {std::make_tuple(1., .01, false), std::make_tuple(.5, .02, true), std::make_tuple(.06, .005, true)}) {
    double of_normal = 0, of_offset = 0, of_noise = 0;
    constexpr double unit = 1e6, planes = 300;
    for(int plane = 0; plane < planes; ++plane) {
      const scenes::Frame frame = scenes::Frame().turned(random.gaussian_vector(), random.uniform());
      Moments moments;
      for(int i = 0; i < 600; ++i) {
        const scenes::Vec p = {random.uniform(), width * random.uniform(), 0}, e = noise * random.gaussian_vector();
        const scenes::Vec q = unit * frame.point(p + (is_isotropic ? e : scenes::Vec{0, 0, e.z}));
        moments.add({std::int32_t(q.x), std::int32_t(q.y), std::int32_t(q.z), 0});
      }
      const Scatter scatter = make_scatter(moments);
      const Vector n = fit_plane(scatter).normal, x = {frame.x.x, frame.x.y, frame.x.z},
                   y = {frame.y.x, frame.y.y, frame.y.z}, z = {frame.z.x, frame.z.y, frame.z.z};
      const Plane_uncertainty u = plane_uncertainty(scatter, {n, dot(n, scatter.centroid)}, 50);
      const double xx = form(u.normal_covariance, x), yy = form(u.normal_covariance, y),
                   xy = (form(u.normal_covariance, x + y) - xx - yy) / 2;
      const double sign = dot(n, z) < 0 ? -1 : 1, a = sign * dot(n, x), b = sign * dot(n, y),
                   c = dot(z, scatter.centroid);
      CHECK(std::fabs(form(u.normal_covariance, n)) < 1e-12 * (xx + yy)); // it has no variance along itself
      of_normal += (yy * a * a - 2 * xy * a * b + xx * b * b) / (xx * yy - xy * xy) / planes;
      of_offset += c * c / (u.offset_deviation * u.offset_deviation) / planes;
      of_noise += u.noise * u.noise / (noise * noise * unit * unit) / planes;
    }
    const std::string name = "width " + std::to_string(width);
    check_close(of_normal, 2, 4 * std::sqrt(4 / planes), name + ": normal");
    check_close(of_offset, 1, 4 * std::sqrt(2 / planes), name + ": offset");
    check_close(of_noise, 1, .03, name + ": noise");
  }
}

BOOST_AUTO_TEST_SUITE_END()
