// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Decides which parallel shapes share a plane (section 4.3 of the paper): those where the degree of freedom that this
// saves is worth more than what their points lose. Directions stay. See the manual, "Relations by Price".

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_COPLANAR_GROUPS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_COPLANAR_GROUPS_H

#include <CGAL/Tandem/internal/regularity/relations.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

class Coplanar_groups {
public:
  // direction: by shape, the number of the direction that it shares; -1 if none.
  Coplanar_groups(const Shape_fits& shapes, const std::vector<int>& direction, const Regularity_options& options)
    : shapes_(shapes), direction_(direction), options_(options)
  {}

  // plane: by shape, that through its centroid; it gets the offset of its group. group_of: by shape; set for members of
  // groups of two or more.
  void fit(Regular_planes& plane, std::vector<int>& group_of) const
  {
    std::vector<Group> groups = single_shapes(plane);
    while(unite(groups))
      ;
    for(std::size_t g = 0; g < groups.size(); ++g) {
      std::vector<int> members = groups[g].members;
      const auto is_far = [&](int i) { return !can_move(i, groups[g].offset - plane[std::size_t(i)].offset); };
      members.erase(std::remove_if(members.begin(), members.end(), is_far), members.end());
      if(members.size() > 1)
        for(int i : members) {
          group_of[std::size_t(i)] = int(g);
          plane[std::size_t(i)].offset = groups[g].offset;
        }
    }
  }

private:
  struct Group {
    std::vector<int> members;
    int direction;
    double offset, weight, largest; // the mean offset of the members, their weight, and the points of the largest one
  };

  // Groups of one shape each, by direction, then by offset.
  std::vector<Group> single_shapes(const Regular_planes& plane) const
  {
    std::vector<std::tuple<int, double, int>> order;
    for(std::size_t i = 0; i < direction_.size(); ++i)
      if(direction_[i] >= 0)
        order.push_back({direction_[i], plane[i].offset, int(i)});
    std::sort(order.begin(), order.end());
    std::vector<Group> groups;
    groups.reserve(order.size());
    for(const auto& [direction, offset, i] : order)
      groups.push_back(
        {{i}, direction, offset, shapes_[std::size_t(i)].scatter.weight(), shapes_[std::size_t(i)].scatter.count});
    return groups;
  }

  // Unions of unions may move a shape by more than sigma, or at more than its plane is worth. It leaves its group then.
  bool can_move(int shape, double distance) const
  {
    const Scatter& s = shapes_[std::size_t(shape)].scatter;
    return std::fabs(distance) <= options_.maximum_offset &&
           s.weight() * (distance * distance) <= options_.price(s.count);
  }

  // What two neighbors gain as one: negative beyond sigma, 0 for equal planes where a degree of freedom is worth nothing.
  double gain(const Group& a, const Group& b) const
  {
    const double d = b.offset - a.offset;
    if(a.direction != b.direction || !(d <= options_.maximum_offset))
      return -1;
    const double weight = a.weight * b.weight / (a.weight + b.weight);
    return std::fma(-weight, d * d, options_.price((std::min)(a.largest, b.largest)));
  }

  // Unites the neighbors that gain more as one than either does with its other neighbor; of equal ones the first.
  bool unite(std::vector<Group>& groups) const
  {
    std::vector<double> gains(groups.size() + 1, -1); // of each group with the one before
    for(std::size_t g = 1; g < groups.size(); ++g)
      gains[g] = gain(groups[g - 1], groups[g]);
    std::vector<Group> united;
    for(std::size_t g = 0; g < groups.size(); ++g) {
      const bool is_best = gains[g] >= 0 && gains[g] > gains[g - 1] && gains[g] >= gains[g + 1];
      if(!is_best) {
        united.push_back(std::move(groups[g]));
        continue;
      }
      Group& a = united.back();
      a.offset = std::fma(groups[g].offset - a.offset, groups[g].weight / (a.weight + groups[g].weight), a.offset);
      a.weight += groups[g].weight;
      a.largest = (std::max)(a.largest, groups[g].largest);
      a.members.insert(a.members.end(), groups[g].members.begin(), groups[g].members.end());
    }
    const bool is_any = united.size() < groups.size();
    groups.swap(united);
    return is_any;
  }

  const Shape_fits& shapes_;
  const std::vector<int>& direction_;
  const Regularity_options& options_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_COPLANAR_GROUPS_H
