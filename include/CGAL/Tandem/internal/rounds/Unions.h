// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Union-find over ids: which shapes become one. Shapes and points are not changed here.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_UNIONS_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_UNIONS_H

#include <CGAL/Tandem/internal/base/types.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// The caller chooses the root: the shape with most points, then the one with the smallest id. So results do not depend
// on the shape of the trees.
class Unions {
public:
  explicit Unions(std::size_t n = 0) { grow(n); }

  // New ids are roots.
  void grow(std::size_t n)
  {
    const std::size_t before = parent_.size();
    parent_.resize((std::max)(before, n));
    std::iota(parent_.begin() + std::ptrdiff_t(before), parent_.end(), std::uint32_t(before));
  }

  // Shortens the path. Writes only what changes: threads that find roots at the same time share cache lines. They must
  // be of different clusters.
  std::uint32_t root(std::uint32_t i)
  {
    while(parent_[i] != parent_[parent_[i]])
      i = parent_[i] = parent_[parent_[i]];
    return parent_[i];
  }

  // Without writing, so any number of threads may call it. With the larger of two as the root, no path is long.
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

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_UNIONS_H
