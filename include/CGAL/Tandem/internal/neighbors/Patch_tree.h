// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nearest patches of any position, by a k-d tree. It does not depend on the order of the patches but for those at one
// position.

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_PATCH_TREE_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_PATCH_TREE_H

#include <CGAL/Tandem/internal/neighbors/Cloud_measure.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// A balanced tree in the order of the table: the node of [first, last) is its middle.
class Patch_tree {
public:
  static constexpr int maximum_found = 16;

  // The nearest ones, ascending by squared distance, then by place in the table.
  struct Found {
    std::array<std::pair<double, std::uint32_t>, std::size_t(maximum_found)> item;
    int count = 0, wanted;

    explicit Found(int k) : item(), wanted(k) {}

    double limit() const { return count < wanted ? HUGE_VAL : item[std::size_t(count - 1)].first; }

    void add(const std::pair<double, std::uint32_t>& candidate)
    {
      if(count == wanted && !(candidate < item[std::size_t(count - 1)]))
        return;
      int i = count < wanted ? count++ : count - 1;
      for(; i > 0 && candidate < item[std::size_t(i - 1)]; --i)
        item[std::size_t(i)] = item[std::size_t(i - 1)];
      item[std::size_t(i)] = candidate;
    }
  };

  explicit Patch_tree(std::vector<Patch_noise> patch) : patch_(std::move(patch)), axis_(patch_.size())
  {
    build(0, patch_.size());
  }

  const std::vector<Patch_noise>& patches() const { return patch_; }

  // The k nearest patches, or all of fewer.
  Found nearest(const Vector& p, int k) const
  {
    Found found((std::min)(k, maximum_found));
    search(p, 0, patch_.size(), found);
    return found;
  }

private:
  static double component(const Vector& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

  void build(std::size_t first, std::size_t last)
  {
    if(last - first < 2)
      return;
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for(std::size_t i = first; i < last; ++i)
      for(int c = 0; c < 3; ++c) {
        low[c] = (std::min)(low[c], component(patch_[i].position, c));
        high[c] = (std::max)(high[c], component(patch_[i].position, c));
      }
    int axis = 0;
    for(int c = 1; c < 3; ++c)
      if(high[c] - low[c] > high[axis] - low[axis])
        axis = c;
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [&](std::size_t i) { return patch_.begin() + std::ptrdiff_t(i); };
    std::nth_element(at(first), at(middle), at(last), [&](const Patch_noise& a, const Patch_noise& b) {
      const double u = component(a.position, axis), v = component(b.position, axis);
      return u < v || (u == v && key(a) < key(b));
    });
    axis_[middle] = std::uint8_t(axis);
    build(first, middle);
    build(middle + 1, last);
  }

  static std::array<double, 4> key(const Patch_noise& p) { return {p.position.x, p.position.y, p.position.z, p.noise}; }

  void search(const Vector& p, std::size_t first, std::size_t last, Found& found) const
  {
    if(first == last)
      return;
    const std::size_t middle = first + (last - first) / 2;
    const Vector d = p - patch_[middle].position;
    found.add({dot(d, d), std::uint32_t(middle)});
    const double side = component(d, axis_[middle]);
    const bool is_low = side < 0;
    search(p, is_low ? first : middle + 1, is_low ? middle : last, found);
    if(side * side <= found.limit())
      search(p, is_low ? middle + 1 : first, is_low ? last : middle, found);
  }

  std::vector<Patch_noise> patch_;
  std::vector<std::uint8_t> axis_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_PATCH_TREE_H
