// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An assignment of points as its definition says, by tables of all candidates of a point. Each pass looks at all points.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SLOW_ASSIGNMENT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SLOW_ASSIGNMENT_H

#include "body_fixture.h"

#include <CGAL/Tandem/internal/rounds/assign.h>

#include <limits>
#include <map>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

using Labels = std::vector<std::uint32_t>;

struct Counts { // of points, by what they do
  std::size_t moves = 0, joins = 0, leaves = 0, waits = 0, stays_in_plane = 0;
};

class Slow_assignment {
public:
  Slow_assignment(const Fixture& f, const std::vector<Shape>& shape, const std::vector<Plane>& plane,
                  const Options& options, std::uint32_t first)
    : f_(f), shape_(shape), plane_(plane), score_(options.score), tolerance_(options.growth.tolerance), first_(first)
  {}

  // Points that do not fit their shape have none.
  Labels leave(Labels label)
  {
    for(std::uint32_t i = 0; i < label.size(); ++i)
      if(label[i] < first_mark && !fits(label[i], i)) {
        label[i] = free_label;
        ++counts.leaves;
      }
    return label;
  }

  // Of labels that fit.
  Labels choose(const Labels& label, std::uint32_t pass)
  {
    Labels chosen;
    for(std::uint32_t i = 0; i < label.size(); ++i)
      chosen.push_back(choose(label, i, pass));
    return chosen;
  }

  // After all passes.
  Labels assign(const Labels& label)
  {
    Labels result = leave(label);
    for(std::uint32_t pass = 0; pass < tuning::moves::assignment_passes; ++pass)
      result = choose(result, pass);
    return result;
  }

  Counts counts;

private:
  Tolerance tolerance_of(std::uint32_t i) const { return f_.level.empty() ? tolerance_ : tolerance_.at(f_.level[i]); }
  bool fits(std::uint32_t s, std::uint32_t i) const { return internal::fits(plane_[s], f_.point[i], tolerance_of(i)); }

  // The weight of the point, half a point for all of its links, and the bonus for one point more than at the beginning.
  std::int64_t worth(const Labels& label, std::uint32_t i, std::uint32_t s) const
  {
    std::int64_t links = 0;
    f_.for_each_neighbor(i, [&](std::uint32_t j) { links += label[j] == s; });
    const std::int64_t distance = signed_distance(plane_[s], f_.point[i]), points = shape_[s].moments.count;
    return Score::weight({1, tolerance_of(i).distance}, distance) + links * (Score::unit / 2) / f_.cloud.k +
           (points > 0 ? score_.point_bonus(points) : 0);
  }

  std::uint32_t choose(const Labels& label, std::uint32_t i, std::uint32_t pass)
  {
    const std::uint32_t own = label[i];
    const bool has_shape = own < first_mark;
    const bool is_odd = (std::uint64_t(first_ + i) * 0x9e3779b97f4a7c15u) >= std::uint64_t(1) << 63;
    if(has_shape && is_odd != (pass % 2 == 1)) {
      ++counts.waits;
      return own;
    }
    std::map<std::uint32_t, std::int64_t> candidate;
    f_.for_each_neighbor(i, [&](std::uint32_t j) {
      const std::uint32_t t = label[j];
      if(t >= first_mark || t == own || !fits(t, i))
        return;
      const bool is_same =
        has_shape && shape_[own].plane_number >= 0 && shape_[own].plane_number == shape_[t].plane_number;
      counts.stays_in_plane += is_same;
      if(!is_same)
        candidate[t] = worth(label, i, t);
    });
    if(has_shape)
      candidate[own] = worth(label, i, own);
    std::uint32_t best = own;
    std::int64_t most = std::numeric_limits<std::int64_t>::min();
    for(const auto& c : candidate) // by rising id
      if(c.second > most) {
        best = c.first;
        most = c.second;
      }
    counts.moves += has_shape && best != own;
    counts.joins += !has_shape && best < first_mark;
    return best;
  }

  const Fixture& f_;
  std::vector<Shape> shape_;
  std::vector<Plane> plane_;
  Score score_;
  Tolerance tolerance_;
  std::uint32_t first_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SLOW_ASSIGNMENT_H
