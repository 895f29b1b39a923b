// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a result is worth, in points: one measure for all decisions, and for all detectors. Moves weigh the bonus of
// sizes by how continuous the surface is: see continuity_at().
//
//   S = sum over the points of shapes of 1 - d^2 / epsilon^2           d: distance to the plane, epsilon: tolerance of
//                                                                     the point; free points count 0
//     - 1 / k (beta * links between two shapes + gamma * links between a shape and a free point)
//     + mu * sum over shapes of N log2(N / m)                          N points, m: minimum size of a shape
//     - c m * (number of shapes)
//     - rho * sum over degrees of freedom of m + N / 10         N: points of the largest shape that it belongs to
//
// A link is an entry of the neighbor graph, k a point. All sums are integers, in units of a 4096th of a point, so they
// do not depend on the order of the points. mu and rho are the parameters simplicity and regularity; tuning::score has
// the constants.

#ifndef CGAL_TANDEM_INTERNAL_SCORE_SCORE_H
#define CGAL_TANDEM_INTERNAL_SCORE_SCORE_H

#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/internal/base/tuning/score.h>
#include <CGAL/Tandem/internal/base/types.h>

#include <cmath>
#include <vector>

namespace CGAL::Tandem::internal {

constexpr int log2_bits = 16;

// The logarithm in units of 2^-16, for n > 0, to within 6e-5: a table with linear interpolation.
CGAL_TANDEM_HD inline std::int64_t fixed_log2(std::uint64_t n)
{
  constexpr std::uint32_t table[65] = {0,     1466,  2909,  4331,  5732,  7112,  8473,  9814,  11136, 12440, 13727,
                                       14996, 16248, 17484, 18704, 19909, 21098, 22272, 23433, 24579, 25711, 26830,
                                       27936, 29029, 30109, 31178, 32234, 33279, 34312, 35334, 36346, 37346, 38336,
                                       39316, 40286, 41246, 42196, 43137, 44068, 44990, 45904, 46809, 47705, 48593,
                                       49472, 50344, 51207, 52063, 52911, 53751, 54584, 55410, 56229, 57040, 57845,
                                       58643, 59434, 60219, 60997, 61769, 62534, 63294, 64047, 64794, 65536};
  int exponent = 0;
  for(int step = 32; step > 0; step /= 2)
    if(n >> exponent >> step != 0)
      exponent += step;
  // The bits after the leading one: 6 choose the entry, 26 interpolate.
  const std::uint64_t mantissa = exponent > 32 ? n >> (exponent - 32) : n << (32 - exponent);
  const std::uint32_t entry = std::uint32_t(mantissa >> 26) & 63, rest = std::uint32_t(mantissa) & ((1u << 26) - 1);
  const std::uint64_t between = std::uint64_t(table[entry + 1] - table[entry]) * rest;
  return (std::int64_t(exponent) << log2_bits) + table[entry] + std::int64_t((between + (1u << 25)) >> 26);
}

// What is counted of labels: the rest of the score follows from the sizes of shapes and from their relations.
struct Score_counts {
  std::int64_t fit = 0;                   // sum of the weights of points
  std::int64_t links = 0, free_links = 0; // between two shapes; between a shape and a free point
};

// In units of tuning::score::unit.
struct Score_terms {
  std::int64_t fit = 0, links = 0, size = 0, price = 0, freedom = 0;

  CGAL_TANDEM_HD std::int64_t total() const { return fit + links + size + price + freedom; }
};

// What a degree of freedom is worth, in points: so much, and more for each point of the largest shape that has it.
struct Freedom_worth {
  double least = 0, per_point = 0;

  double of(double points) const { return fused(per_point, points, least); }
};

inline Freedom_worth make_freedom_worth(double regularity, double minimum_size)
{
  return {regularity * minimum_size, regularity / double(tuning::score::points_per_freedom)};
}

// Made on the host; functors have it by value.
class Score {
public:
  static constexpr std::int64_t unit = tuning::score::unit;
  static constexpr std::uint64_t tolerance_units = std::uint64_t(1) << 15;

  explicit Score(const Parameters& p) : Score(p.minimum_region_size, int(p.k_neighbors), p.simplicity, p.regularity) {}

  // A minimum size beyond all numbers of points counts as the largest of them.
  Score(std::uint64_t minimum_size, int k, double simplicity = Parameters().simplicity,
        double regularity = Parameters().regularity)
    : minimum_size_(std::int64_t(minimum_size < most_points ? minimum_size : most_points)),
      log2_of_minimum_(fixed_log2(std::uint64_t(minimum_size_))), k_(k), link_(tuning::score::link.of(unit)),
      bonus_(llrint(simplicity * double(unit * bonus_unit))), price_(tuning::score::price.of(minimum_size_ * unit)),
      freedom_(make_freedom_worth(regularity, double(minimum_size_)))
  {}

  // A distance in units of a 2^15th of the tolerance, rounded. What is farther than the tolerance counts as that.
  CGAL_TANDEM_HD static std::uint64_t fraction_of(const Tolerance& t, std::int64_t distance)
  {
    const std::int64_t size = distance < 0 ? -distance : distance;
    if(size >= t.distance)
      return tolerance_units; // also where the product would overflow
    return (std::uint64_t(size) * tolerance_units + std::uint64_t(t.distance) / 2) / std::uint64_t(t.distance);
  }

  // Of a point at a distance in these units, and of one with this tolerance.
  CGAL_TANDEM_HD static std::int64_t weight_at(std::uint64_t fraction)
  {
    constexpr std::uint64_t divisor = tolerance_units * tolerance_units / std::uint64_t(unit);
    return unit - std::int64_t((fraction * fraction + divisor / 2) / divisor);
  }
  CGAL_TANDEM_HD static std::int64_t weight(const Tolerance& t, std::int64_t distance)
  {
    return weight_at(fraction_of(t, distance));
  }

  // Of so many links between two shapes, and between a shape and free points.
  CGAL_TANDEM_HD std::int64_t links(std::int64_t between_shapes, std::int64_t to_free = 0) const
  {
    constexpr tuning::Ratio free_link = tuning::score::free_link;
    return -(between_shapes * link_ + free_link.of(to_free * unit)) / k_;
  }

  // B(N) = mu N log2(N / m); no overflow for up to 2^37 points.
  CGAL_TANDEM_HD std::int64_t size_bonus(std::int64_t points) const
  {
    return points > 0 ? points * bonus(fixed_log2(std::uint64_t(points)) - log2_of_minimum_) / bonus_unit : 0;
  }

  // Its derivative, for one point more or less.
  CGAL_TANDEM_HD std::int64_t point_bonus(std::int64_t points) const
  {
    constexpr std::int64_t log2_of_e = 94548; // in units of 2^-16
    return bonus(fixed_log2(std::uint64_t(points)) - log2_of_minimum_ + log2_of_e) / bonus_unit;
  }

  // Of a shape.
  CGAL_TANDEM_HD std::int64_t price() const { return -price_; }

  // Of a degree of freedom of a direction, or of a plane, by the points of the largest of its shapes. If two become
  // one, that of the smaller is saved.
  std::int64_t freedom(std::int64_t points) const
  {
    return -std::int64_t(llrint(freedom_.of(double(points)) * double(unit)));
  }

private:
  static constexpr std::int64_t bonus_unit = 256;
  static constexpr std::uint64_t most_points = std::uint64_t(1) << 40;

  // mu log2(..) of a point, in 1 / bonus_unit of a unit, rounded down.
  CGAL_TANDEM_HD std::int64_t bonus(std::int64_t log2) const { return (bonus_ * log2) >> log2_bits; }

  std::int64_t minimum_size_, log2_of_minimum_, k_, link_, bonus_, price_;
  Freedom_worth freedom_;
};

// All terms but that of relations. size: of the shapes.
inline Score_terms score_terms(const Score& score, const Score_counts& counts, const std::vector<std::size_t>& size)
{
  Score_terms terms;
  terms.fit = counts.fit;
  terms.links = score.links(counts.links, counts.free_links);
  for(const std::size_t points : size)
    terms.size += score.size_bonus(std::int64_t(points));
  terms.price = std::int64_t(size.size()) * score.price();
  return terms;
}

// 1 for parallel planes, 0 where they turn by alpha or more: 1 - sin^2(angle) / sin^2(alpha).
CGAL_TANDEM_HD inline std::int64_t alignment(std::int64_t normal_product, const Tolerance& t)
{
  constexpr std::int64_t one = std::int64_t(1) << 28;
  const std::int64_t size = (normal_product < 0 ? -normal_product : normal_product) >> 28;
  const std::int64_t cosine = size < one ? size : one;
  const std::int64_t square = (one * one - cosine * cosine) >> 24, most = (std::int64_t(1) << 32) - t.squared_cosine;
  return square < most ? Score::unit - Score::unit * square / most : 0;
}

// How continuous the surface of two planes is at a point, in units: 1 where they meet and do not turn, 0 where the step
// between them is epsilon, or the angle alpha, or more. For the step it is the product of the weights that two points
// there have, each on the plane of the other. In unions and assignments the bonus of sizes counts as far as the surface
// is continuous: so the parts of a slight bend unite, and size is no reason to join layers.
CGAL_TANDEM_HD inline std::int64_t continuity_at(const Plane& a, const Plane& b, const Grid_point& p,
                                                 const Tolerance& t)
{
  const std::int64_t product = normal_product(a, {b.nx, b.ny, b.nz}), sign = product < 0 ? -1 : 1;
  const std::int64_t w = Score::weight(t, signed_distance(a, p) - sign * signed_distance(b, p));
  return w * w / Score::unit * alignment(product, t) / Score::unit;
}

// The contact of two shapes: its links, and the sum of the positions of their surfels.
struct Contact {
  std::uint64_t links = 0;
  std::int64_t position[3] = {0, 0, 0}; // in grid steps

  CGAL_TANDEM_HD void add(std::uint64_t more, const Grid_point& p)
  {
    links += more;
    position[0] += std::int64_t(more) * p.x;
    position[1] += std::int64_t(more) * p.y;
    position[2] += std::int64_t(more) * p.z;
  }
  CGAL_TANDEM_HD void operator+=(const Contact& c)
  {
    links += c.links;
    for(int i = 0; i < 3; ++i)
      position[i] += c.position[i];
  }
  // The mean position, rounded towards 0. There is at least one link; 64 bits suffice for 2^35 of them.
  CGAL_TANDEM_HD Grid_point center() const
  {
    const std::int64_t n = std::int64_t(links);
    return {std::int32_t(position[0] / n), std::int32_t(position[1] / n), std::int32_t(position[2] / n), no_normal};
  }
};

// Adds to a contact that several functors fill at the same time.
template <class Backend>
CGAL_TANDEM_HD void atomic_add(Contact& target, const Contact& contact)
{
  Backend::atomic_add(target.links, contact.links);
  for(int i = 0; i < 3; ++i)
    Backend::atomic_add(target.position[i], contact.position[i]);
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_SCORE_SCORE_H
