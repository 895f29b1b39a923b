// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What two planes in place of one gain, see score/Score.h, by a sample of the points of the shape. Changes nothing. See
// the manual, "Splits".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_GAIN_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_GAIN_H

#include <CGAL/Tandem/internal/rounds/Shape_sample.h>
#include <CGAL/Tandem/internal/score/Score.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/Shape.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Whether the point is nearer to the first plane.
CGAL_TANDEM_HD inline bool is_nearer(const Plane& a, const Plane& b, const Grid_point& p)
{
  const std::int64_t da = signed_distance(a, p), db = signed_distance(b, p);
  return (da < 0 ? -da : da) < (db < 0 ? -db : db);
}

// The planes of both parts; the first one has more points of the sample.
struct Split {
  Plane first, second;
  std::int64_t gain = 0; // in units of the score; 0: none
};

// The sampled points of a shape.
struct Point_sample {
  const Sampled_point* point;
  std::uint32_t size;

  CGAL_TANDEM_HD const Grid_point& operator[](std::uint32_t i) const { return point[i].point; }
  CGAL_TANDEM_HD std::uint8_t level(std::uint32_t i) const { return std::uint8_t(point[i].level); }
};

// A trial begins with the sides of the points of the sample. Then both sides are fitted, and points go to the nearer
// plane, in turn. By a group of lanes, which share the points of the sample.
class Split_gain {
public:
  static constexpr int starts = 7;
  static constexpr std::int64_t sample_size = tuning::moves::split_sample;

  explicit Split_gain(const Options& options)
    : score_(options.score), tolerance_(options.growth.tolerance), minimum_size_(options.minimum_region_size),
      per_square_(double(Score::unit) / (options.maximum_distance * options.maximum_distance)),
      far_(options.maximum_distance / 2)
  {}

  // Whether a shape would be worth its price if it took all squared distances away.
  CGAL_TANDEM_HD bool may_split(const Shape& s) const
  {
    return s.moments.count >= minimum_size_ &&
           per_square_ / s.scatter.squared_tolerance * s.fit.smallest > -double(score_.price());
  }

  CGAL_TANDEM_HD Split trial(const Shape& s, const Point_sample& sample, int start) const
  {
    if(!may_gain(s, sample))
      return Split();
    const Eigen_system axes = eigen_system(s.scatter.matrix);
    const Moments all = sum_of<Moments>(sample, [&](std::uint32_t i, Moments& sum) { sum.add(sample[i]); });
    Halves halves(sample, all, [&](const Grid_point& p) { return is_on_second_side(s, axes, p, start); });
    Split split;
    for(int step = 0; step < tuning::moves::split_steps; ++step) {
      if(halves.first.count < 3 || halves.second.count < 3)
        return Split();
      split.first = plane_of(halves.first);
      split.second = plane_of(halves.second);
      const Halves next(sample, all, [&](const Grid_point& p) { return is_nearer(split.second, split.first, p); });
      const bool is_settled = next.second.is_equal(halves.second);
      halves = next;
      if(is_settled)
        break; // planes would be the same
    }
    if(halves.first.count < halves.second.count) {
      const Plane swapped = split.first;
      split.first = split.second;
      split.second = swapped;
    }
    split.gain = gain(s, sample, split);
    return split;
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

  // The moments of those points of a sample that are on the second side, and of the others.
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

  // Whether a split would gain if all points of the sample were on its planes.
  CGAL_TANDEM_HD bool may_gain(const Shape& s, const Point_sample& sample) const
  {
    const Plane before = rounded(s.local);
    const auto sum = sum_of<std::int64_t>(
      sample, [&](std::uint32_t i, std::int64_t& part) { part += Score::unit - weight(before, sample, i); });
    return double(s.moments.count) / double(sample.size) * double(sum) > -double(score_.price());
  }

  CGAL_TANDEM_HD static Plane plane_of(const Moments& m)
  {
    Fitted_moments f;
    f.moments = m;
    refit(f);
    return rounded(f.local);
  }

  // Halves along both axes, of the distance, of the normal along both axes; middle and ends; near and far.
  CGAL_TANDEM_HD bool is_on_second_side(const Shape& s, const Eigen_system& axes, const Grid_point& p, int start) const
  {
    const Vector from_center = Vector{double(p.x), double(p.y), double(p.z)} - s.scatter.centroid;
    const double along = dot(from_center, axes.vector[2]), across = dot(from_center, axes.vector[1]);
    const double distance = dot(from_center, axes.vector[0]);
    if(start == 0)
      return along > 0;
    if(start == 1)
      return across > 0;
    if(start == 2)
      return distance > 0;
    if(start == 3 || start == 4) {
      const Int_vector m = decode_normal(p.normal);
      const Vector n = {double(m.x), double(m.y), double(m.z)};
      const double side = dot(n, axes.vector[0]) < 0 ? -1 : 1;
      return side * dot(n, axes.vector[start == 3 ? 2 : 1]) > 0;
    }
    if(start == 5)
      return along * along * s.scatter.count > axes.value[2];
    const double far = far_ * std::sqrt(s.scatter.squared_tolerance);
    return distance > far || distance < -far;
  }

  CGAL_TANDEM_HD std::int64_t weight(const Plane& plane, const Point_sample& sample, std::uint32_t i) const
  {
    const Tolerance own = tolerance_.at(sample.level(i));
    return fits(plane, sample[i], own) ? Score::weight({1, own.distance}, signed_distance(plane, sample[i])) : 0;
  }

  // Of the split; 0 where it is not certain, or a part is too small.
  CGAL_TANDEM_HD std::int64_t gain(const Shape& s, const Point_sample& sample, const Split& split) const
  {
    const Plane before = rounded(s.local);
    std::int64_t sum = 0, squares = 0, count[2] = {0, 0};
    for(std::uint32_t i = Lane_group::rank(); i < sample.size; i += Lane_group::size()) {
      const bool second = is_nearer(split.second, split.first, sample[i]);
      const std::int64_t w = weight(second ? split.second : split.first, sample, i);
      const std::int64_t change = w - weight(before, sample, i);
      count[second] += w > 0;
      sum += change;
      squares += change * change;
    }
    for(std::int64_t* own : {&sum, &squares, &count[0], &count[1]})
      *own = Lane_group::sum(*own);
    const std::int64_t n = s.moments.count, size = std::int64_t(sample.size);
    const std::int64_t first = n * count[0] / size, second = n * count[1] / size;
    if(2 * first < minimum_size_ || 2 * second < minimum_size_)
      return 0;
    const double scale = double(n) / double(size);
    const double size_change = double(score_.size_bonus(first) + score_.size_bonus(second) - score_.size_bonus(n));
    const double result = std::fma(scale, double(sum), size_change + double(score_.price()));
    const double variance = size < n ? scale * scale * double(squares) : 0;
    return result > 0 && result * result > variance ? std::int64_t(result) : 0;
  }

  Score score_;
  Tolerance tolerance_;
  std::int64_t minimum_size_;
  double per_square_; // units of the score for a squared grid step
  double far_;        // in grid steps
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_GAIN_H
