// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Why points have no shape: the counts against plain loops on several back ends, with and without surfels, and scenes
// whose free points have one reason.

#include "testing/surfels_of_three.h"

#include <CGAL/Tandem/internal/result/explain_free_points.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_free_points)

using namespace CGAL::Tandem::internal;
using CGAL::Tandem::Free_points;

using Counts = std::array<std::int64_t, free_reason::size>;

template <class Backend>
class Reasons_of_fixture {
public:
  Reasons_of_fixture(Backend& backend, const std::string& name, const Fixture& f)
    : backend_(backend), name_(name), f_(f)
  {}

  void run()
  {
    compare(f_.cloud, {f_.cloud.surfels, f_.label.data(), nullptr}, name_);
    const Surfels_of_three s(f_);
    compare(s.cloud, {s.cloud.surfels, s.label.data(), s.point_label.data()}, name_ + ", surfels");
  }

private:
  // Every second label is a shape of the result.
  void compare(const Cloud_view& cloud, const Labels_of_points& labels, const std::string& name)
  {
    std::vector<std::uint32_t> shape;
    for(std::uint32_t i = 0; i < cloud.size; ++i)
      shape.push_back(labels.label[i] < first_mark && labels.label[i] % 2 == 0 ? labels.label[i] : no_index);
    std::vector<Grid_point> point(f_.point);
    for(std::size_t p = 0; p < point.size(); p += 11)
      point[p].normal = no_normal;
    Cloud_view changed = cloud;
    changed.surfels.point = point.data();
    const std::uint32_t points = std::uint32_t(point.size());
    const Counts got = backend_.template sum<free_reason::size>(
      points, Explain_free_points{changed, {labels, shape.data()}, f_.plane.data(), f_.tolerance});
    Counts expected = {};
    for(std::uint32_t p = 0; p < points; ++p) {
      const std::uint32_t i = cloud.surfels.of_point(p);
      const bool is_rejected = labels.point_label != nullptr && labels.point_label[p] != labels.label[i];
      if(shape[i] == no_index || is_rejected)
        ++expected[reason(cloud, shape, i, p, point[p])];
    }
    for(std::size_t r = 0; r < free_reason::size; ++r)
      check_equal(got[r], expected[r], name + ": reason " + std::to_string(r));
    CHECK_AT(got[free_reason::misfit] > 0 || points < 100, name);
  }

  free_reason::Reason reason(const Cloud_view& cloud, const std::vector<std::uint32_t>& shape, std::uint32_t i,
                             std::uint32_t at, const Grid_point& p) const
  {
    if(p.normal == no_normal)
      return free_reason::without_normal;
    const Plane own = own_plane(p);
    const double cosine = std::sqrt(double(f_.tolerance.squared_cosine)) / 65536;
    const double twice = std::cos(2 * std::acos(cosine));
    const Tolerance own_tolerance = f_.tolerance_of(at),
                    wide = {2 * own_tolerance.distance, std::int64_t(twice * twice * 4294967296.)};
    std::vector<std::uint32_t> near = {shape[i]};
    int all = 0, fitting = 0;
    for(const std::uint32_t* q = cloud.row(i); q != cloud.row(i) + cloud.k && *q != no_index; ++q, ++all) {
      near.push_back(shape[*q]);
      fitting += fits(own, cloud.point[*q], own_tolerance);
    }
    for(const std::uint32_t s : near)
      if(s != no_index && fits(f_.plane[s], p, wide))
        return free_reason::misfit;
    return fitting == 0         ? free_reason::without_neighbors
           : fitting > all / 2. ? free_reason::in_small_regions
                                : free_reason::clutter;
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

namespace {

void test_doubled()
{
  for(const double angle : {.5, 10., 25., 44.9, 45., 60., 89.}) {
    const Tolerance t = doubled(make_tolerance(7, cosine_deg(angle)));
    check_equal(t.distance, make_tolerance(14, 1).distance, "distance");
    const double cosine = angle < 45 ? cosine_deg(2 * angle) : 0;
    CHECK_AT(std::fabs(double(t.squared_cosine) - cosine * cosine * 4294967296.) <= 8, std::to_string(angle));
  }
}

// A square of side 1 with noise across, n points.
void add_square(Cloud& cloud, scenes::Random& random, std::size_t n, const scenes::Vec& at, double noise)
{
  for(std::size_t i = 0; i < n; ++i)
    add(cloud, at + scenes::Vec{random.uniform(), random.uniform(), noise * random.gaussian()}, {0, 0, 1});
}

// All free points but a share have the reason.
void check_reason(const Cloud& cloud, double epsilon, std::size_t Free_points::*reason, const std::string& name,
                  Given given = Given::normals)
{
  const Shapes shapes = detect_valid(name, cloud, make_parameters(epsilon, 50), given);
  const CGAL::Tandem::Statistics& s = shapes.statistics();
  check_equal(s.free_points.total(), cloud.size() - s.number_of_assigned_points, name + ": sum");
  CHECK_AT(s.free_points.total() > 100, name);
  CHECK_AT(double(s.free_points.*reason) > .75 * double(s.free_points.total()),
           name + ": " + std::to_string(s.free_points.*reason) + " of " + std::to_string(s.free_points.total()));
}

void test_scenes()
{
  scenes::Random random(46);
  Cloud wall;
  add_square(wall, random, 4000, {0, 0, 0}, .01);
  check_reason(wall, .012, &Free_points::misfit, "a wall with more noise than the tolerance");

  Cloud plates = wall;
  for(int i = 0; i < 12; ++i)
    add_square(plates, random, 30, {3. * i, 5, 2. * (i % 3)}, .001);
  check_reason(plates, .05, &Free_points::in_small_regions, "small plates");

  Cloud outliers = wall;
  for(int i = 0; i < 500; ++i) {
    const scenes::Vec at = {3 * random.uniform(), 3 * random.uniform(), 1 + 3 * random.uniform()};
    add(outliers, at, {random.gaussian(), random.gaussian(), random.gaussian()});
  }
  check_reason(outliers, .05, &Free_points::without_neighbors, "outliers");

  Cloud line = wall;
  for(int i = 0; i < 500; ++i)
    add(line, {10 + .01 * i, 10, 10}, {0, 0, 1});
  check_reason(line, .05, &Free_points::without_normal, "a line", Given::nothing);

  Cloud ball;
  for(int i = 0; i < 4000; ++i)
    add(ball, {random.uniform(), random.uniform(), random.uniform()}, {0, 0, 1});
  check_reason(ball, .01, &Free_points::clutter, "clutter", Given::nothing);
}

} // namespace

BOOST_AUTO_TEST_CASE(all_cases)
{
  test_with_levels_on_all_backends<Reasons_of_fixture>();
  test_doubled();
  test_scenes();
}

BOOST_AUTO_TEST_SUITE_END()
