// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The uncertainty of planes: moments against plain loops on several back ends, generated planes of known noise, whose
// errors are as large as is said, and points that determine no plane.

#include "testing/surfels_of_three.h"

#include <CGAL/Tandem/internal/result/measure_planes.h>

#include <cmath>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_uncertainty)

using namespace CGAL::Tandem::internal;
using CGAL::Tandem::Plane_uncertainty;

template <class Backend>
class Moments_of_fixture {
public:
  Moments_of_fixture(Backend& backend, const std::string& name, const Fixture& f)
    : backend_(backend), name_(name), f_(f)
  {}

  void run()
  {
    compare(f_.cloud, f_.cells, {f_.cloud.surfels, f_.label.data(), nullptr}, name_);
    const Surfels_of_three s(f_);
    compare(s.cloud, s.cells, {s.cloud.surfels, s.label.data(), s.point_label.data()}, name_ + ", surfels");
  }

private:
  // Every second label is a shape, of half its number.
  void compare(const Cloud_view& cloud, const std::vector<Range>& cells, const Labels_of_points& labels,
               const std::string& name)
  {
    std::vector<std::uint32_t> shape;
    for(std::uint32_t i = 0; i < cloud.size; ++i)
      shape.push_back(labels.label[i] < first_mark && labels.label[i] % 2 == 0 ? labels.label[i] / 2 : no_index);
    std::vector<Shared_moments> expected(f_.plane.size()), got(f_.plane.size());
    for(std::uint32_t p = 0; p < f_.point.size(); ++p) {
      const std::uint32_t i = cloud.surfels.of_point(p);
      if(shape[i] != no_index && (labels.point_label == nullptr || labels.point_label[p] == labels.label[i]))
        add_point(expected[shape[i]], f_.point[p], 1);
    }
    for(const std::uint32_t parts : {1u, 3u}) {
      std::fill(got.begin(), got.end(), Shared_moments());
      backend_.template for_each_cell<Moment_table>(
        parts * cells.size(), Sum_moments<Backend, Final_members>{
                                cloud, {cells.data(), nullptr, parts}, {{labels, shape.data()}}, got.data()});
      check_moments(got, expected, name);
    }
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

namespace {

// v' C v
double form(const std::array<double, 6>& c, const Vector& v)
{
  return quadratic_form({c[0], c[1], c[2], c[3], c[4], c[5]}, v);
}

// Means over many planes, which are 2, 1 and 1 for a true covariance.
struct Errors {
  double normal = 0, offset = 0, noise = 0;
  int within_one = 0, planes = 0; // whether the normal is within one standard deviation

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
    within_one += distance2 < 1;
    this->offset += offset * offset / (u.offset_deviation * u.offset_deviation);
    this->noise += u.noise * u.noise / (noise * noise);
    ++planes;
  }

  // Within four standard deviations of the means of so many planes. 39 % are within one of two dimensions.
  void check(const std::string& name) const
  {
    const double n = planes;
    CHECK_AT(std::fabs(normal / n - 2) < 4 * std::sqrt(4 / n), name + ": normal " + std::to_string(normal / n));
    CHECK_AT(std::fabs(offset / n - 1) < 4 * std::sqrt(2 / n), name + ": offset " + std::to_string(offset / n));
    CHECK_AT(std::fabs(noise / n - 1) < .03, name + ": noise " + std::to_string(noise / n));
    CHECK_AT(std::fabs(within_one / n - .3935) < 4 * std::sqrt(.24 / n), name + ": " + std::to_string(within_one / n));
  }
};

// A rectangle of 1 by `width`, with noise across the plane, or in all directions.
Cloud noisy_plane(scenes::Random& random, const scenes::Frame& frame, double width, double noise, bool is_isotropic)
{
  Cloud cloud;
  for(int i = 0; i < 600; ++i) {
    const scenes::Vec p = {random.uniform(), width * random.uniform(), noise * random.gaussian()};
    const scenes::Vec aside = {noise * random.gaussian(), noise * random.gaussian(), 0};
    add(cloud, frame.point(is_isotropic ? p + aside : p), frame.z);
  }
  return cloud;
}

void test_noise(const std::string& name, double width, double noise, bool is_isotropic)
{
  scenes::Random random(46);
  Errors errors;
  for(int seed = 0; seed < 200; ++seed) {
    const scenes::Frame turned =
      scenes::Frame().turned({random.gaussian(), random.gaussian(), random.gaussian()}, random.uniform());
    const scenes::Frame frame = turned.at({100 * random.uniform(), 200, 300});
    const Cloud cloud = noisy_plane(random, frame, width, noise, is_isotropic);
    const Shapes shapes = detect_valid(name, cloud, make_parameters(7 * noise, 300));
    check_equal(shapes.number_of_shapes(), std::size_t(1), name);
    if(shapes.number_of_shapes() != 1)
      continue;
    check_equal(shapes.size(0), cloud.size(), name + ": points");
    errors.add(shapes, frame, noise);
  }
  errors.check(name);
}

Plane_uncertainty uncertainty_of(const std::vector<Grid_point>& points, double offset = 0)
{
  Moments m;
  for(const Grid_point& p : points)
    m.add(p);
  return plane_uncertainty(make_scatter(m), {{0, 0, 1}, offset}, 50);
}

void test_degenerate()
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

} // namespace

BOOST_AUTO_TEST_CASE(all_cases)
{
  test_on_all_backends<Moments_of_fixture>();
  test_degenerate();
  test_noise("noise across the plane", 1, .01, false);
  test_noise("noise in all directions", .5, .02, true);
  test_noise("a strip", .06, .005, true);
}

BOOST_AUTO_TEST_SUITE_END()
