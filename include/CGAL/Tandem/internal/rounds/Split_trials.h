// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What two planes in place of one gain, see score/Score.h, and where such planes are sought. Changes nothing. See the
// manual, "Splits".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_TRIALS_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_TRIALS_H

#include <CGAL/Tandem/internal/rounds/Shape_samples.h>
#include <CGAL/Tandem/internal/score/Score.h>
#include <CGAL/Tandem/internal/shapes/Stage_parameters.h>
#include <CGAL/Tandem/internal/shapes/Shape.h>

namespace CGAL::Tandem::internal {

// The planes of both parts; the same one twice where none have been found.
struct Split {
  Plane first, second;

  CGAL_TANDEM_HD bool is_any() const { return !(first == second); }
};

// The nearer plane of a split, the first one of equally near ones.
struct Nearer_plane {
  bool is_second;
  std::int64_t distance;

  CGAL_TANDEM_HD Nearer_plane(const Split& split, const Grid_point& p)
  {
    const std::int64_t a = signed_distance(split.first, p), b = signed_distance(split.second, p);
    const std::int64_t of_first = a < 0 ? -a : a, of_second = b < 0 ? -b : b;
    is_second = of_second < of_first;
    distance = is_second ? of_second : of_first;
  }

  // What a point is worth there at most: also if its normal does not fit.
  CGAL_TANDEM_HD std::int64_t most(std::int64_t tolerance) const
  {
    const double d = double(distance) / double(tolerance), square = d * d;
    return Score::unit - std::int64_t(double(Score::unit) * (square < 1 ? square : 1));
  }
};

// What a split changes: the sum of the weights of points, and the links that it cuts. second: points of the second part.
struct Split_account {
  std::int64_t fit = 0, second = 0, links = 0;
};

// The sampled points of a shape.
struct Point_sample {
  const Sampled_point* point;
  std::uint32_t size;

  CGAL_TANDEM_HD const Grid_point& operator[](std::uint32_t i) const { return point[i].point; }
  CGAL_TANDEM_HD std::uint8_t level(std::uint32_t i) const { return std::uint8_t(point[i].level); }
};

// A trial fits planes to two halves of a sample of the points; in half of the trials, points then go to the nearer
// plane, in turn. That finds steps far from the middle, where noise is low; where it is high, it leads away from them.
// By a group of lanes, which share the points of the sample.
class Split_trials {
public:
  static constexpr int starts = 8; // bits of a byte
  static constexpr int halves_of_starts = 6;
  static constexpr std::int64_t sample_size = tuning::moves::split_sample;

  explicit Split_trials(const Stage_parameters& options)
    : score_(options.score), tolerance_(options.growth.tolerance),
      per_square_(double(Score::unit) / (options.maximum_distance_steps * options.maximum_distance_steps))
  {}

  // Whether a shape would be worth its price if it took all squared distances away.
  CGAL_TANDEM_HD bool may_split(const Shape& s) const
  {
    return per_square_ / s.scatter.squared_tolerance * s.fit.smallest > -double(score_.price());
  }

  // What a split gains. The bonus of sizes does not count: parts that are worth it unite again.
  CGAL_TANDEM_HD std::int64_t gain(const Split_account& a) const
  {
    return a.fit + score_.price() + score_.links(a.links);
  }

  CGAL_TANDEM_HD Split operator()(const Shape& s, const Point_sample& sample, int start) const
  {
    const Eigen_system axes = eigen_system(s.scatter.matrix);
    const Plane whole = rounded(s.local);
    const Moments all = sum_of<Moments>(sample, [&](std::uint32_t i, Moments& sum) { sum.add(sample[i]); });
    Halves halves(sample, all,
                  [&](const Grid_point& p) { return is_in_second_half(s, axes, p, start % halves_of_starts); });
    Split split = {whole, whole};
    for(int step = 0; step < (start < 4 ? 1 : tuning::moves::split_steps); ++step) {
      if(halves.first.count < 3 || halves.second.count < 3)
        return {whole, whole};
      split = {plane_of(halves.first), plane_of(halves.second)};
      halves = Halves(sample, all, [&](const Grid_point& p) { return Nearer_plane(split, p).is_second; });
    }
    return may_gain(s, sample, whole, split) ? split : Split{whole, whole};
  }

private:
  // The sum of what f(i, sum) adds for the points of a sample.
  template <class Sum, class F>
  CGAL_TANDEM_HD static Sum sum_of(const Point_sample& sample, F f)
  {
    Sum sum = Sum();
    for(std::uint32_t i = Lane_group::rank(); i < sample.size; i += Lane_group::size())
      f(i, sum);
    return Lane_group::sum(sum);
  }

  // Sums over a sample.
  struct Sample_sums {
    std::int64_t second = 0, fit = 0, continuity = 0;

    CGAL_TANDEM_HD void operator+=(const Sample_sums& s)
    {
      second += s.second;
      fit += s.fit;
      continuity += s.continuity;
    }
  };

  // Whether it gains by the sample if it cuts no links, and the bonus of sizes counts by the mean continuity: planes
  // through noise are near each other everywhere. So noise is rarely tried by all points.
  CGAL_TANDEM_HD bool may_gain(const Shape& s, const Point_sample& sample, const Plane& whole, const Split& split) const
  {
    const auto sums = sum_of<Sample_sums>(sample, [&](std::uint32_t i, Sample_sums& sum) {
      const Grid_point& p = sample[i];
      const Tolerance own = tolerance_.at(sample.level(i));
      const Nearer_plane nearer(split, p);
      sum.second += nearer.is_second;
      sum.fit += nearer.most(own.distance) - (fits(whole, p, own) ? Score::weight(own, signed_distance(whole, p)) : 0);
      sum.continuity += continuity_at(split.first, split.second, p, own);
    });
    const double points = double(s.moments.count) / double(sample.size); // of the shape for one of the sample
    const auto fit = std::int64_t(points * double(sums.fit)), second = std::int64_t(points * double(sums.second));
    const std::int64_t bonus =
      score_.size_bonus(s.moments.count - second) + score_.size_bonus(second) - score_.size_bonus(s.moments.count);
    constexpr std::int64_t one = 256; // no overflow of products with sizes
    return fit + score_.price() + sums.continuity / sample.size / (Score::unit / one) * bonus / one > 0;
  }

  // The moments of those points of a sample that are in the second half, and of the others.
  struct Halves {
    template <class Predicate>
    CGAL_TANDEM_HD Halves(const Point_sample& sample, const Moments& all, Predicate is_second) : first(all)
    {
      second = sum_of<Moments>(sample, [&](std::uint32_t i, Moments& sum) {
        if(is_second(sample[i]))
          sum.add(sample[i]);
      });
      first -= second;
    }

    Moments first, second;
  };

  CGAL_TANDEM_HD static Plane plane_of(const Moments& m)
  {
    const Scatter s = make_scatter(m);
    return rounded(plane_through(fit_plane(s).normal, s.centroid));
  }

  // Halves along both axes and both diagonals, of the distance, middle and ends.
  CGAL_TANDEM_HD static bool is_in_second_half(const Shape& s, const Eigen_system& axes, const Grid_point& p, int start)
  {
    const Vector from_center = Vector{double(p.x), double(p.y), double(p.z)} - s.scatter.centroid;
    const double along = dot(from_center, axes.vector[2]), across = dot(from_center, axes.vector[1]);
    // Both have widths of one standard deviation. No difference, which a compiler might contract.
    const double wide = along * along * axes.value[1], high = across * across * axes.value[2];
    switch(start) {
    case 0:
      return along > 0;
    case 1:
      return across > 0;
    case 2:
      return along > 0 ? across > 0 || wide > high : across > 0 && wide < high;
    case 3:
      return along > 0 ? across < 0 || wide > high : across < 0 && wide < high;
    case 4:
      return dot(from_center, axes.vector[0]) > 0;
    default:
      return along * along * s.scatter.count > axes.value[2];
    }
  }

  Score score_;
  Tolerance tolerance_;
  double per_square_; // units of the score for a squared grid step
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_TRIALS_H
