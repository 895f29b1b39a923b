// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which of many directions are exactly orthogonal, without a look at all pairs.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_ORTHOGONAL_PAIRS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_ORTHOGONAL_PAIRS_H

#include <CGAL/Tandem/internal/base/tuning/exactness.h>
#include <CGAL/Tandem/internal/base/planes.h>
#include <CGAL/Tandem/internal/regularity/Great_circle_index.h>

#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// The directions that may be exactly orthogonal to one.
class Right_angle_region {
public:
  explicit Right_angle_region(const Vector& direction) : circle(great_circle(direction)) {}

  bool meets(const Direction_cell& cell, double) const { return circle.meets(cell); }
  int nearest_quarter(const Direction_cell&) const { return 0; }

private:
  Great_circle circle;
};

// The same as are_orthogonal(). Plain products decide nearly all pairs: without FMA in the processor, fma() is slow.
inline bool are_exactly_orthogonal(const Vector& a, const Vector& b)
{
  return std::fabs(a.x * b.x + a.y * b.y + a.z * b.z) <= tuning::exactness::dot_margin && are_orthogonal(a, b);
}

// All pairs (i, j), i < j, of exactly orthogonal unit directions, sorted; null vectors have none. A direction is
// compared with those near its great circle: for n directions in general position, about the square root of n. The list
// is not complete if there are more than `most`.
inline std::vector<std::pair<int, int>> orthogonal_pairs(const std::vector<Vector>& directions,
                                                         std::size_t most = (std::numeric_limits<std::size_t>::max)())
{
  std::vector<std::pair<int, int>> pairs;
  Great_circle_index index;
  std::vector<int> added; // by number in the index
  for(std::size_t j = 0; j < directions.size() && pairs.size() <= most; ++j) {
    if(!(dot(directions[j], directions[j]) > 0))
      continue;
    index.search(Right_angle_region(directions[j]), [&](int k) {
      if(are_exactly_orthogonal(directions[added[k]], directions[j]))
        pairs.push_back({added[k], int(j)});
    });
    index.add(directions[j], 0);
    added.push_back(int(j));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_ORTHOGONAL_PAIRS_H
