// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mean shift with a Gaussian kernel, for directions and for offsets (section 4.1 of the paper). It computes modes and
// changes nothing. An index type supplies the geometry:
//   Index(positions, radius)
//   near(position, f)          calls f(i, squared distance) for all positions within the radius, in a fixed order
//   near(position, reach, f)   the same within reach_of(distance), for a smaller distance; some may be a little farther
//   weigh(position, kernel, f) calls f(i, kernel(squared distance)) for those within the radius, in this order
//   Index::Mean                a weighted mean, with add() and value()
// Loops run on executor.for_each(n, f, few): f(i) for i in [0, n), on one thread if n < few.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_MEAN_SHIFT_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_MEAN_SHIFT_H

#include <CGAL/Tandem/internal/base/tuning/regularity.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// exp(-t) as a fixed polynomial, the power 2^n of 1 - t / 2^n, cut off where the kernel ends.
inline double gaussian(double t)
{
  using namespace tuning::clustering;
  double e = t <= kernel_deviations * kernel_deviations / 2 ? 1 - t / (1 << kernel_power_bits) : 0;
  for(int k = 0; k < kernel_power_bits; ++k)
    e *= e;
  return e;
}

// The executor that runs loops on the calling thread.
struct In_order {
  template <class F>
  void for_each(std::size_t n, F f, std::size_t = 0) const
  {
    for(std::size_t i = 0; i < n; ++i)
      f(i);
  }
};

// Finds the modes of a weighted set. The standard deviation of the kernel is half the radius. Of two modes within the
// radius of each other only the denser one counts. A sum is computed by one thread, in the order of the index, so
// threads cannot change a bit. The arguments must outlive the search.
template <class Index>
class Mean_shift {
public:
  using Position = typename Index::Position;

  Mean_shift(const std::vector<Position>& positions, const std::vector<double>& weights, double radius)
    : position(positions), weight(weights), radius(radius),
      index(positions, tuning::clustering::kernel_deviations * tuning::clustering::sigma * radius)
  {}

  // By falling density; ties are broken by position in the input.
  template <class Executor>
  std::vector<Position> modes(const Executor& executor) const
  {
    const std::vector<std::size_t> start = starts(executor);
    std::vector<Mode> found(start.size());
    executor.for_each(
      start.size(), [&](std::size_t s) { found[s] = climb(start[s]); }, few_climbs);
    std::sort(found.begin(), found.end(), [](const Mode& a, const Mode& b) {
      return a.density != b.density ? a.density > b.density : a.start < b.start;
    });
    return without_weaker(found);
  }

  // The sum of the weights within reach, by the kernel.
  double density(const Position& x) const
  {
    double sum = 0;
    weigh(x, [&](std::size_t i, double k) { sum = std::fma(weight[i], k, sum); });
    return sum;
  }

private:
  // Loops over fewer items run on one thread.
  static constexpr std::size_t few_densities = 128, few_climbs = 24;

  struct Mode {
    Position position;
    double density;
    std::size_t start;
  };

  // Calls f(i, kernel) for what is within reach. The exponent q / (2 sigma^2) of a squared distance q is
  // 2 q / radius^2.
  template <class F>
  void weigh(const Position& x, F f) const
  {
    constexpr double sigma = tuning::clustering::sigma;
    const double twice_variance = 2 * sigma * sigma * (radius * radius);
    index.weigh(
      x, [twice_variance](double q) { return gaussian(q / twice_variance); }, f);
  }

  // Local maxima of the density among the positions within sigma, as every mode is reached from one of them. Of equal
  // densities the first position counts. There are far fewer than positions, so few ascents are needed.
  template <class Executor>
  std::vector<std::size_t> starts(const Executor& executor) const
  {
    const std::size_t n = position.size();
    std::vector<double> d(n);
    executor.for_each(
      n, [&](std::size_t i) { d[i] = density(position[i]); }, few_densities);
    std::vector<char> is_maximum(n, 1);
    const double sigma = tuning::clustering::sigma * radius;
    const double squared_sigma = sigma * sigma, reach = Index::reach_of(sigma);
    executor.for_each(
      n,
      [&](std::size_t i) {
        index.near(position[i], reach, [&](std::size_t j, double q) {
          if(q <= squared_sigma && (d[j] > d[i] || (d[j] == d[i] && j < i)))
            is_maximum[i] = 0;
        });
      },
      few_densities);
    std::vector<std::size_t> result;
    for(std::size_t i = 0; i < n; ++i)
      if(is_maximum[i])
        result.push_back(i);
    return result;
  }

  // The ascent: the mean of what the kernel weighs, again and again, until it rests.
  Mode climb(std::size_t start) const
  {
    Position x = position[start];
    const double small = tuning::clustering::squared_rest * radius * radius;
    for(int step = 0; step < tuning::clustering::maximum_steps; ++step) {
      typename Index::Mean mean(x);
      weigh(x, [&](std::size_t i, double k) { mean.add(position[i], weight[i] * k); });
      const Position next = mean.value();
      const double moved = Index::squared_distance(x, next);
      x = next;
      if(moved <= small)
        break;
    }
    return {x, density(x), start};
  }

  // The modes, by falling density, without those within the radius of a kept one.
  std::vector<Position> without_weaker(const std::vector<Mode>& sorted) const
  {
    std::vector<Position> all, kept;
    all.reserve(sorted.size());
    kept.reserve(sorted.size());
    for(const Mode& m : sorted)
      all.push_back(m.position);
    const Index modes(all, radius);
    std::vector<char> is_dropped(all.size(), 0);
    for(std::size_t i = 0; i < all.size(); ++i) {
      if(is_dropped[i])
        continue;
      kept.push_back(all[i]);
      modes.near(all[i], [&](std::size_t j, double) { is_dropped[j] = 1; });
    }
    return kept;
  }

  const std::vector<Position>& position;
  const std::vector<double>& weight;
  double radius;
  Index index;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_MEAN_SHIFT_H
