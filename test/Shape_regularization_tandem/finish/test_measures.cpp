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
#include <vector>

BOOST_AUTO_TEST_SUITE(test_measures)

using namespace CGAL::Tandem::internal;
using namespace std::string_literals;
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

free_reason::Reason reason(const Fixture& f, const Cloud_view& cloud, const std::vector<std::uint32_t>& shape,
                           std::uint32_t i, std::uint32_t at, const Grid_point& p)
{
  if(p.normal == no_normal)
    return free_reason::without_normal;
  const Plane own = own_plane(p);
  const double cosine = std::sqrt(double(f.tolerance.squared_cosine)) / 65536;
  const double twice = std::cos(2 * std::acos(cosine));
  const Tolerance own_tolerance = f.tolerance_of(at),
                  wide = {2 * own_tolerance.distance, std::int64_t(twice * twice * 4294967296.)};
  std::vector<std::uint32_t> near = {shape[i]};
  int all = 0, fitting = 0;
  for(const std::uint32_t* q = cloud.row(i); q != cloud.row(i) + cloud.k && *q != no_index; ++q, ++all) {
    near.push_back(shape[*q]);
    fitting += fits(own, cloud.point[*q], own_tolerance);
  }
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
  Counts expected = {};
  std::vector<Shared_moments> sums(f.plane.size());
  for(std::uint32_t p = 0; p < points; ++p) {
    const std::uint32_t i = cloud.surfels.of_point(p);
    if(shape[i] == no_index || (labels.point_label != nullptr && labels.point_label[p] != labels.label[i]))
      ++expected[reason(f, cloud, shape, i, p, point[p])];
    else
      add_point(sums[shape[i]], point[p], 1, f.level_of(p));
  }
  const Counts got = backend.template sum<free_reason::size>(
    points, Explain_free_points{cloud, {labels, shape.data()}, f.plane.data(), f.tolerance});
  for(std::size_t r = 0; r < free_reason::size; ++r)
    check_equal(got[r], expected[r], name + ": reason " + std::to_string(r));
  CHECK_AT(got[free_reason::misfit] > 0 || points < 100, name);
  for(const std::uint32_t parts : {1u, 3u}) {
    std::vector<Shared_moments> sum(sums.size());
    backend.template for_each_cell<Moment_table>(
      parts * cells.size(),
      Sum_moments<Backend, Final_members>{cloud, {cells.data(), nullptr, parts}, {{labels, shape.data()}}, sum.data()});
    if(f.level.empty())
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

// Means over many planes, which are 2, 1 and 1 for a true covariance.
struct Errors {
  double normal = 0, offset = 0, noise = 0;
  int planes = 0;

  // The squared error of the normal, by its covariance; of the offset, by its variance; and noise^2 by the true one.
  void add(const Shapes& shapes, const scenes::Frame& frame, double noise)
  {
    const Plane_uncertainty& u = shapes.uncertainty(0);
    const auto& c = shapes.coefficients(0);
    Vector n = {c[0], c[1], c[2]};
    const Vector truth = {frame.z.x, frame.z.y, frame.z.z};
    const double sign = dot(n, truth) < 0 ? -1 : 1;
    const Vector error = truth - sign * n;
    const Plane_axes axes(n);
    const double aa = form(u.normal_covariance, axes.a), bb = form(u.normal_covariance, axes.b);
    const double ab = (form(u.normal_covariance, axes.a + axes.b) - aa - bb) / 2;
    const double a = dot(error, axes.a), b = dot(error, axes.b);
    const double distance2 = (bb * a * a - 2 * ab * a * b + aa * b * b) / (aa * bb - ab * ab);
    CHECK_AT(std::fabs(form(u.normal_covariance, n)) < 1e-12 * (aa + bb), "the normal has a variance along itself");
    const scenes::Vec at = scenes::Vec{u.centroid[0], u.centroid[1], u.centroid[2]} - frame.origin;
    const double offset = scenes::dot(frame.z, at);
    normal += distance2;
    this->offset += offset * offset / (u.offset_deviation * u.offset_deviation);
    this->noise += u.noise * u.noise / (noise * noise);
    ++planes;
  }

  // Within four standard deviations of the means of so many planes.
  void check(const std::string& name) const
  {
    const double n = planes;
    CHECK_AT(std::fabs(normal / n - 2) < 4 * std::sqrt(4 / n), name + ": normal " + std::to_string(normal / n));
    CHECK_AT(std::fabs(offset / n - 1) < 4 * std::sqrt(2 / n), name + ": offset " + std::to_string(offset / n));
    CHECK_AT(std::fabs(noise / n - 1) < .03, name + ": noise " + std::to_string(noise / n));
  }
};

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
  std::vector<Grid_point> line, heap;
  for(int i = 0; i < 100; ++i) {
    line.push_back({3 * i, 7 * i, 0, 0});
    heap.push_back({i % 5, i / 5 % 5, i / 25 * 100, 0});
  }
  const Plane_uncertainty u = uncertainty_of(line), v = uncertainty_of(heap);
  const double degrees = 180 / std::acos(-1.);
  CHECK(std::fabs(u.angle_deg - degrees) < 1e-9 && std::fabs(v.angle_deg - degrees) < 1e-9);
  CHECK(std::fabs(form(u.normal_covariance, unit({7, -3, 0})) - 1) < 1e-9); // nothing is known about the line ...
  CHECK(form(u.normal_covariance, unit({3, 7, 0})) < 1e-9);                 // ... but along it
  CHECK(std::fabs(v.normal_covariance[0] - 1) < 1e-9 && std::fabs(v.normal_covariance[3] - 1) < 1e-9);
}

// Rectangles of 1 by `width`, with noise across the plane, or in all directions.
BOOST_AUTO_TEST_CASE(noise)
{
  struct {
    const char* name;
    double width, noise;
    bool is_isotropic;
  } const cases[] = {{"noise across the plane", 1, .01, false},
                     {"noise in all directions", .5, .02, true},
                     {"a strip", .06, .005, true}};
  for(const auto& [name, width, noise, is_isotropic] : cases) {
    scenes::Random random(46);
    Errors errors;
    for(int seed = 0; seed < 150; ++seed) {
      const scenes::Frame turned = scenes::Frame().turned(random.gaussian_vector(), random.uniform());
      const scenes::Frame frame = turned.at({100 * random.uniform(), 200, 300});
      Cloud cloud;
      for(int i = 0; i < 600; ++i) {
        const scenes::Vec p = {random.uniform(), width * random.uniform(), 0}, e = noise * random.gaussian_vector();
        add(cloud, frame.point(p + (is_isotropic ? e : scenes::Vec{0, 0, e.z})), frame.z);
      }
      const Shapes shapes = detect_valid(name, cloud, make_parameters(7 * noise, 300));
      check_counts(name, shapes, 1, 1, 1);
      if(shapes.number_of_shapes() != 1)
        continue;
      check_equal(shapes.size(0), cloud.size(), name + ": points"s);
      errors.add(shapes, frame, noise);
    }
    errors.check(name);
  }
}

BOOST_AUTO_TEST_SUITE_END()
