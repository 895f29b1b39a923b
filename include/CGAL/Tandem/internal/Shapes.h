// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The table of shapes, and the labels and states of the points.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_H
#define CGAL_TANDEM_INTERNAL_SHAPES_H

#include <CGAL/Tandem/internal/relations.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// A label below first_mark is the shape of the point. The other values mean that
// the point is free, now or for good.
constexpr std::uint32_t first_mark = 0x80000000u;
constexpr std::uint32_t is_free = 0xffffffffu;
constexpr std::uint32_t is_locked = 0xfffffffeu; // free, but detached too often to be grown over again

// Bits of the state of a point.
constexpr std::uint8_t on_frontier = 1; // its neighbors are still to be visited
constexpr std::uint8_t no_seed = 2;     // a shape that started here has failed
constexpr std::uint8_t detached_once = 4;
constexpr std::uint8_t is_interior = 8; // all of its neighbors have had its label

struct Labels_view {
  std::uint32_t* label;
  std::uint8_t* state;

  CGAL_TANDEM_HD bool is_untried(std::uint32_t i) const { return label[i] == is_free && !(state[i] & no_seed); }
};

// Integer bounds of a set of points; grows only.
struct Box {
  std::int32_t low[3] = {(std::numeric_limits<std::int32_t>::max)(), (std::numeric_limits<std::int32_t>::max)(),
                         (std::numeric_limits<std::int32_t>::max)()};
  std::int32_t high[3] = {(std::numeric_limits<std::int32_t>::min)(), (std::numeric_limits<std::int32_t>::min)(),
                          (std::numeric_limits<std::int32_t>::min)()};

  CGAL_TANDEM_HD void add(const Grid_point& p)
  {
    const std::int32_t c[3] = {p.x, p.y, p.z};
    for(int a = 0; a < 3; ++a) {
      low[a] = c[a] < low[a] ? c[a] : low[a];
      high[a] = c[a] > high[a] ? c[a] : high[a];
    }
  }

  CGAL_TANDEM_HD void add(const Box& b)
  {
    for(int a = 0; a < 3; ++a) {
      low[a] = b.low[a] < low[a] ? b.low[a] : low[a];
      high[a] = b.high[a] > high[a] ? b.high[a] : high[a];
    }
  }
};

inline Plane rounded(const Regular_plane& p) { return make_plane(p.normal, p.offset * p.normal); }

// An upper bound, for all points of the box, on the change of the distance to the
// plane when it moves from a to b.
inline double bound_motion(const Box& box, const Regular_plane& a, const Regular_plane& b)
{
  const double sign = dot(a.normal, b.normal) < 0 ? -1 : 1;
  const Vector v = add_scaled(a.normal, -sign, b.normal);
  const double d = std::fma(sign, b.offset, -a.offset);
  const double low =
    std::fma(v.x, v.x > 0 ? box.low[0] : box.high[0],
             std::fma(v.y, v.y > 0 ? box.low[1] : box.high[1], v.z * (v.z > 0 ? box.low[2] : box.high[2])));
  const double high =
    std::fma(v.x, v.x > 0 ? box.high[0] : box.low[0],
             std::fma(v.y, v.y > 0 ? box.high[1] : box.low[1], v.z * (v.z > 0 ? box.high[2] : box.low[2])));
  return (std::max)(std::fabs(low + d), std::fabs(high + d));
}

// What the points of a shape said when they were asked last: the share of them that
// fits the local plane, but not the candidate.
struct Answer {
  Regular_plane local = {}, candidate = {};
  std::int64_t points = 0;
  double misfit_share = 0;
};

// Points, with the plane that fits them best.
struct Fitted_moments {
  Moments moments;
  Scatter scatter;          // of moments, with ...
  Fit fit;                  // ... its local plane
  Regular_plane local = {}; // the local plane again
};

struct Shape : Fitted_moments {
  Box box;
  Regular_plane plane = {};     // local or regular
  Regular_plane checked = {};   // the plane when the points were last checked against it
  Regular_plane restarted = {}; // the plane when the whole shape was last put on the frontier
  int age = 0;                  // passes of growth since it began
  int rollbacks = 0;
  int retry_round = 0;            // not regularized before this round ...
  std::int64_t retry_count = 0;   // ... or before it has this many points
  std::int64_t layered_count = 0; // points when it was last examined for layers
  std::int64_t regular_count = 0; // points when its relations were found; 0 if it has none yet
  int entry = 0;                  // its place in the relations, if it has some
  Answer answer;
  bool is_active = false; // it has gained points in the last pass
  bool is_changed = true; // its points or its plane have changed since its links were collected
  bool is_dirty = true;   // its points have changed since it was fitted
};

// A merge of shapes, by union-find over their ids. Who unites chooses the root: the
// shape with most points, then the one with the smallest id.
class Unions {
public:
  explicit Unions(std::size_t n = 0) { grow(n); }

  void grow(std::size_t n)
  {
    const std::size_t before = parent_.size();
    parent_.resize((std::max)(before, n));
    std::iota(parent_.begin() + std::ptrdiff_t(before), parent_.end(), std::uint32_t(before));
  }

  // Writes only what becomes shorter: threads that ask for roots side by side have the same lines in their caches.
  std::uint32_t root(std::uint32_t i)
  {
    while(parent_[i] != parent_[parent_[i]])
      i = parent_[i] = parent_[parent_[i]];
    return parent_[i];
  }

  // Without making anything shorter: with the larger of two as the root no way is long.
  std::uint32_t find_root(std::uint32_t i) const
  {
    while(parent_[i] != i)
      i = parent_[i];
    return i;
  }

  void set_parent(std::uint32_t child, std::uint32_t parent) { parent_[child] = parent; }

private:
  std::vector<std::uint32_t> parent_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_H
