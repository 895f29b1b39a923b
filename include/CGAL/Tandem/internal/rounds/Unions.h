// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

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

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_UNIONS_H
