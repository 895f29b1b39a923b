// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The table of shapes, and the labels and states of the points.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_SHAPES_H
#define CGAL_TANDEM_INTERNAL_SHAPES_SHAPES_H

#include <CGAL/Tandem/internal/base/Box.h>
#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/planes.h>

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
constexpr std::uint32_t free_label = 0xffffffffu;
constexpr std::uint32_t locked_label = 0xfffffffeu; // free, but detached too often to be grown over again

// Bits of the state of a point.
constexpr std::uint8_t frontier_bit = 1;    // its neighbors are still to be visited
constexpr std::uint8_t failed_seed_bit = 2; // a shape that started here has failed
constexpr std::uint8_t detached_bit = 4;
constexpr std::uint8_t interior_bit = 8; // all of its neighbors have had its label

struct Labels_view {
  std::uint32_t* label;
  std::uint8_t* state;

  CGAL_TANDEM_HD bool is_untried(std::uint32_t i) const
  {
    return label[i] == free_label && !(state[i] & failed_seed_bit);
  }
};

// What the points of a shape said when they were asked last: the share of them that
// fits the local plane, but not the candidate.
struct Misfit_record {
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
  Misfit_record last_misfits;
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

#endif // CGAL_TANDEM_INTERNAL_SHAPES_SHAPES_H
