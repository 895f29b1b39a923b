// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a union gains: where samples have all points, the difference of the score, which plain loops over the points give.
// Then layers, bends and one plane, by samples of large shapes.

#include "testing/random_shapes.h"
#include "testing/verdict_of.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_union_gain)

using namespace CGAL::Tandem::internal;

// Of points with one plane.
struct Value {
  double fit = 0;          // of the points that fit
  std::int64_t points = 0; // that fit
  double squares = 0;      // of distances, of all points
};

class Slow_gain {
public:
  explicit Slow_gain(const Options& options) : options_(options) {}

  Value value(const Grid_points& points, const Regular_plane& regular) const
  {
    Value v;
    const Plane plane = rounded(regular);
    for(const Grid_point& p : points) {
      const double d = double(signed_distance(plane, p)) / normal_scale;
      v.squares += d * d;
      if(fits(plane, p, options_.growth.tolerance)) {
        v.fit += Score::unit * (1 - d * d / (maximum_distance * maximum_distance));
        ++v.points;
      }
    }
    return v;
  }

  // With its price; without links.
  double score(const Value& v) const
  {
    return v.fit + double(options_.score.size_bonus(v.points) + options_.score.price());
  }

  // The first one is the larger one. Sets whether the result is near the limit of a decision.
  Verdict verdict(const Points& a, const Points& b, std::uint32_t links, bool& is_close) const
  {
    is_close = false;
    const double cosine = dot(a.fitted.fit.normal, b.fitted.fit.normal);
    if(std::acos((std::min)(std::fabs(cosine), 1.)) > 50 * 3.14159265358979 / 180)
      return {};
    if(4 * b.size() < a.size()) {
      const Verdict v = joined(a, b, a.fitted.local, links, true, is_close);
      if(v.is_accepted)
        return {true, true, v.gain};
    }
    Fitted_moments joint;
    joint.moments = a.fitted.moments;
    joint.moments += b.fitted.moments;
    refit(joint);
    return joined(a, b, joint.local, links, false, is_close);
  }

private:
  // is_taken: the plane is that of the larger one, which counts with all of its points.
  Verdict joined(const Points& a, const Points& b, const Regular_plane& plane, std::uint32_t links, bool is_taken,
                 bool& is_close) const
  {
    Value before_a = value(a.point, a.fitted.local), after_a = value(a.point, plane);
    if(is_taken)
      before_a.points = after_a.points = a.size();
    const Value before_b = value(b.point, b.fitted.local), after_b = value(b.point, plane);
    const Value both = {after_a.fit + after_b.fit, after_a.points + after_b.points, 0};
    const double links_of_pair = double(options_.score.links(links));
    Verdict v;
    v.gain = score(both) - score(before_a) - score(before_b) - links_of_pair;
    const double gain_of_larger = v.gain + score(before_b);
    // Without a look at points, by squares that count all of them, such a union is seen to lose more than a price.
    const double by_squares = v.gain - both.fit + before_a.fit + before_b.fit -
                              Score::unit / (maximum_distance * maximum_distance) *
                                (after_a.squares + after_b.squares - before_a.squares - before_b.squares);
    const bool may_be_skipped = by_squares < 0;
    v.is_accepted = v.gain > 0 && gain_of_larger > 0 && 10 * (b.size() - after_b.points) <= b.size() &&
                    10 * (a.size() - after_a.points) <= a.size();
    is_close = is_close || std::fabs(v.gain) < 2 || std::fabs(gain_of_larger) < 2 || before_b.points < b.size() ||
               (v.is_accepted && may_be_skipped);
    return v;
  }

  Options options_;
};

BOOST_AUTO_TEST_CASE(whole_samples)
{
  int accepted = 0, rejected = 0, taken = 0, close = 0, small_loses = 0;
  std::mt19937 random(11);
  for(int repetition = 0; repetition < 8000; ++repetition) {
    const Options options = union_options(int(random() % 4 == 0 ? 200 : 20));
    const Slow_gain slow(options);
    const Union_gain gain(options);
    int n = 3 + int(random() % 62), m = 3 + int(random() % 62);
    if(n < m)
      std::swap(n, m);
    Points a = random_shape(n, 0, random), b = random_shape(m, 1000, random);
    a.finish(0);
    b.finish(std::uint32_t(n));
    const std::uint32_t links = random() % 30;
    bool is_close = false;
    const Verdict expected = slow.verdict(a, b, links, is_close);
    const Verdict got = verdict_of(gain, {a.fitted, a.sample}, {b.fitted, b.sample}, links);
    close += is_close;
    if(is_close && got.is_accepted != expected.is_accepted)
      continue;
    const std::string where = "case " + std::to_string(repetition);
    check_equal(got.is_accepted, expected.is_accepted, where + ": is accepted");
    check_equal(got.is_taken, expected.is_taken, where + ": is taken");
    if(got.is_accepted && got.is_taken == expected.is_taken)
      CHECK_AT(std::fabs(got.gain - expected.gain) < 2,
               where + ": gains " + std::to_string(got.gain) + " and " + std::to_string(expected.gain));
    if(n == m) { // of equal shapes none is the larger one
      const Verdict other = verdict_of(gain, {b.fitted, b.sample}, {a.fitted, a.sample}, links);
      CHECK_AT(!other.is_accepted || !got.is_accepted || std::fabs(other.gain - got.gain) < 1e-3,
               where + ": gain of the pair in the other order");
    }
    accepted += expected.is_accepted && !expected.is_taken;
    taken += expected.is_taken;
    rejected += !expected.is_accepted;
    small_loses += !expected.is_accepted && expected.gain > 2;
  }
  for(int count : {accepted, rejected, taken, small_loses})
    CHECK_AT(count > 40, std::to_string(count) + " of a kind");
  CHECK_AT(close < 2000, std::to_string(close) + " are close");
}

// Points of one tolerance are as points of epsilon: the verdict is that of points which are larger by the same factor.
BOOST_AUTO_TEST_CASE(levels)
{
  int accepted = 0, rejected = 0, taken = 0;
  std::mt19937 random(12);
  for(int repetition = 0; repetition < 5000; ++repetition) {
    const Union_gain gain(union_options(int(random() % 4 == 0 ? 200 : 20)));
    const int octaves = int(random() % 3), n = 3 + int(random() % 62), m = 3 + int(random() % 62);
    Points small[2] = {random_shape((std::max)(n, m), 0, random), random_shape((std::min)(n, m), 1000, random)};
    Points large[2] = {small[0], small[1]};
    for(std::uint32_t side : {0u, 1u}) {
      const int factor = 1 << octaves;
      for(Grid_point& p : small[side].point)
        p = {p.x / factor, p.y / factor, p.z / factor, p.normal};
      for(std::size_t i = 0; i < small[side].point.size(); ++i) {
        const Grid_point& p = small[side].point[i];
        large[side].point[i] = {p.x * factor, p.y * factor, p.z * factor, p.normal};
      }
      large[side].finish(side * 64);
      small[side].finish(side * 64, std::uint8_t(8 * octaves));
    }
    const std::uint32_t links = random() % 30;
    const auto verdict = [&](const Points* p) {
      return verdict_of(gain, {p[0].fitted, p[0].sample}, {p[1].fitted, p[1].sample}, links);
    };
    const Verdict expected = verdict(large), got = verdict(small);
    const std::string where = std::to_string(octaves) + " octaves, case " + std::to_string(repetition);
    check_equal(got.is_accepted, expected.is_accepted, where + ": is accepted");
    check_equal(got.is_taken, expected.is_taken, where + ": is taken");
    CHECK_AT(std::fabs(got.gain - expected.gain) < 2, where + ": gain");
    accepted += octaves > 0 && expected.is_accepted;
    taken += octaves > 0 && expected.is_taken;
    rejected += octaves > 0 && !expected.is_accepted;
  }
  for(int count : {accepted, rejected, taken})
    CHECK_AT(count > 40, std::to_string(count) + " of a kind, with levels");
}

// Points of two areas side by side, at a distance in epsilons: f(x, y) of the second one. Noise is uniform, of so many
// epsilons to either side.
template <class F>
std::pair<Points, Points> areas(int n, double noise, F f, bool are_interleaved = false)
{
  std::mt19937 random{unsigned(n)};
  std::pair<Points, Points> result;
  for(int i = 0; i < 2 * n; ++i) {
    const bool is_second = i >= n;
    const int x = int(random() % 10000), y = int(random() % 10000);
    const double height = (is_second ? f(x, y) : 0) + noise * (double(random() % 2001) / 1000 - 1);
    (is_second ? result.second : result.first)
      .point.push_back({x + (is_second && !are_interleaved ? 10000 : 0), y, int(height * maximum_distance), upright});
  }
  result.first.finish(0);
  result.second.finish(std::uint32_t(n));
  return result;
}

bool is_accepted(const std::pair<Points, Points>& s)
{
  const auto verdict = [](const Points& a, const Points& b) {
    return verdict_of(criterion, {a.fitted, a.sample}, {b.fitted, b.sample}, 20).is_accepted;
  };
  const bool result = verdict(s.first, s.second);
  check_equal(verdict(s.second, s.first), result, "the other order");
  return result;
}

// 100 is the minimum size.
BOOST_AUTO_TEST_CASE(surfaces)
{
  for(int n : {50, 150, 1000, 3000}) {
    const std::string where = std::to_string(n) + " points";
    const auto same = [](int, int) { return 0.; };
    const auto bent = [](int x, int) { return .3 * x / 10000; };
    const auto very_bent = [](int x, int) { return 6. * x / 10000; };
    const auto layer = [](int, int) { return 1.1; };
    for(double noise : {0., .2, 1 / 3., .5})
      CHECK_AT(is_accepted(areas(n, noise, same)), where + ": one plane");
    for(double noise : {0., .2, 1 / 3.}) {
      CHECK_AT(n > 1000 || is_accepted(areas(n, noise, bent)), where + ": a slight bend");
      CHECK_AT(!is_accepted(areas(n, noise, very_bent)), where + ": a bend");
      CHECK_AT(n < 1000 || !is_accepted(areas(n, noise, layer, true)), where + ": two layers");
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
