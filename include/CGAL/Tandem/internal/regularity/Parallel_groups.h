// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Decides which shapes are parallel: a shape joins the direction of a larger one where the two degrees of freedom that
// this saves are worth more than what its points lose. Shapes are only read. See the manual, "Relations by Price".

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_PARALLEL_GROUPS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_PARALLEL_GROUPS_H

#include <CGAL/Tandem/internal/base/angles.h>
#include <CGAL/Tandem/internal/regularity/Fixed_directions.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// The groups are united in steps. In each, groups are visited by falling number of points. A group joins the one before
// it at which it gains most, unless that has joined another one itself. Then groups are fitted again, until none joins.
class Parallel_groups {
public:
  Parallel_groups(const Shape_fits& shapes, const Regularity_options& options)
    : shapes_(shapes), options_(options), sine_(sine_deg(options.angle_tolerance_deg))
  {}

  // Groups of these shapes, also of one shape, all fitted; those of given directions come first and may be empty.
  std::vector<Direction_group> operator()(const std::vector<int>& active) const
  {
    std::vector<Direction_group> groups;
    for(const Vector& d : options_.fixed_directions)
      groups.push_back(given_direction_group(d, sine_));
    for(int i : active)
      groups.push_back(direction_group({i}, sine_));
    for(Direction_group& g : groups)
      g.fit(shapes_);
    while(options_.parallelism && sine_ > tuning::directions::minimum_sine && unite(groups))
      ;
    return groups;
  }

private:
  bool unite(std::vector<Direction_group>& groups) const
  {
    Great_circle_index index; // of the groups that others may join
    std::vector<int> leader;  // by number in the index
    std::vector<int> target(groups.size(), -1);
    for(int g : by_weight(groups)) {
      if(!groups[std::size_t(g)].is_given)
        target[std::size_t(g)] = best_leader(groups, std::size_t(g), index, leader);
      if(target[std::size_t(g)] >= 0)
        continue;
      index.add(groups[std::size_t(g)].fitted, 0);
      leader.push_back(g);
    }
    for(std::size_t g = 0; g < groups.size(); ++g)
      if(target[g] >= 0) {
        std::vector<int>& members = groups[std::size_t(target[g])].members;
        members.insert(members.end(), groups[g].members.begin(), groups[g].members.end());
        groups[g].members.clear();
        groups[std::size_t(target[g])].has_changed = true;
      }
    const std::size_t before = groups.size();
    drop_empty(groups);
    for(Direction_group& g : groups)
      if(g.has_changed) {
        std::sort(g.members.begin(), g.members.end());
        g.fit(shapes_);
      }
    return groups.size() < before;
  }

  // The leader at which a group gains most; the heaviest of equal ones. -1 if it gains nowhere.
  int best_leader(const std::vector<Direction_group>& groups, std::size_t g, const Great_circle_index& index,
                  const std::vector<int>& leader) const
  {
    const double largest = groups[g].largest, most = options_.direction_price(largest);
    const double reach = (std::min)(sine_ + tuning::exactness::dot_margin, groups[g].bearable_sine(most));
    std::pair<double, int> best(0, 1); // the gain, then -number in the index
    index.search(Near_direction_region(groups[g].fitted, reach), [&](int k) {
      const Direction_group& other = groups[std::size_t(leader[std::size_t(k)])];
      if(squared_sine(other.fitted, groups[g].fitted) <= sine_ * sine_)
        best = (std::max)(best, {saved(largest, other) - groups[g].cost(other.fitted), -k});
    });
    return best.second > 0 ? -1 : leader[std::size_t(-best.second)];
  }

  // What it is worth to have the direction of another group. That of a given one is there anyway.
  double saved(double largest, const Direction_group& other) const
  {
    return options_.direction_price(other.is_given ? largest : (std::min)(largest, other.largest));
  }

  const Shape_fits& shapes_;
  const Regularity_options& options_;
  double sine_; // of the angle within which shapes may be parallel
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_PARALLEL_GROUPS_H
