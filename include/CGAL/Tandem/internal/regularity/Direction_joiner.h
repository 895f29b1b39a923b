// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Leftover directions at the end of a run. Clusters of the Gauss map are found by density. So small groups remain
// beside large ones, although verification would accept the direction of the large one. Each of their shapes joins the
// group that costs it least. Groups are merged or removed here; no direction changes. See the manual, "Verification and
// Rollback".

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTION_JOINER_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTION_JOINER_H

#include <CGAL/Tandem/internal/regularity/Fixed_directions.h>
#include <CGAL/Tandem/internal/regularity/orthogonal_pairs.h>
#include <CGAL/Tandem/internal/regularity/relations.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Verified: Verified_planes. Bounds are those of tuning::leftovers.
template <class Verified>
class Direction_joiner {
public:
  // sine: of the largest angle by which a shape is turned.
  Direction_joiner(const Shape_fits& shapes, double maximum_distance, double sine, Verified& verified,
                   std::vector<Direction_group>& groups)
    : shapes(shapes),
      squared_rms(tuning::leftovers::rms_share * tuning::leftovers::rms_share * maximum_distance * maximum_distance),
      sine(sine), verified(verified), groups(groups)
  {}

  // Each step plans with the groups of before, verifies all plans in one call, and carries them out.
  void join()
  {
    for(int step = 0; step < tuning::leftovers::steps; ++step) {
      std::vector<Plan> plans = make_plans();
      verify(plans);
      carry_out(plans);
    }
  }

private:
  // Dissolves a group. Its members may go to different ones.
  struct Plan {
    std::size_t from;
    std::vector<std::size_t> to; // the new group of each member
  };

  // A total order of groups by number of points, then by the first member. Groups only join heavier ones, so there are
  // no cycles. Given directions are heavier than all others.
  bool is_lighter(std::size_t a, std::size_t b) const
  {
    if(groups[a].is_given || groups[b].is_given)
      return groups[b].is_given && (!groups[a].is_given || a < b);
    if(groups[a].weight != groups[b].weight)
      return groups[a].weight < groups[b].weight;
    return groups[a].members.front() < groups[b].members.front();
  }

  // Whether a group would lose a right angle. circles: of the directions of all groups.
  bool has_right_angle(const Direction_group& g, const Great_circle_index& circles) const
  {
    bool has_one = false;
    circles.search(Right_angle_region(g.direction),
                   [&](int h) { has_one = has_one || are_exactly_orthogonal(g.direction, groups[h].direction); });
    return has_one;
  }

  // The heavier group within the angle that costs a shape least, or groups.size() if all cost too much. The first one
  // of equal costs.
  std::size_t cheapest(const Direction_index& index, std::size_t from, int shape) const
  {
    std::pair<double, std::size_t> best(squared_rms * shapes[shape].scatter.count, groups.size());
    index.near(shapes[shape].fit.normal, [&](std::size_t g, double) {
      if(is_lighter(from, g))
        best = (std::min)(best, {verified.added(shape, groups[g].direction), g});
    });
    return best.second;
  }

  // Plans for the small groups that lose no right angle and of which every member has found another group, the lightest
  // first.
  std::vector<Plan> make_plans() const
  {
    std::vector<Vector> directions;
    Great_circle_index circles;
    for(const Direction_group& g : groups) {
      directions.push_back(g.direction);
      circles.add(g.direction, 0);
    }
    const Direction_index index(directions, sine);
    std::vector<Plan> plans;
    for(std::size_t g = 0; g < groups.size(); ++g) {
      if(groups[g].is_given || groups[g].members.size() > tuning::leftovers::maximum_members)
        continue;
      Plan plan = {g, {}};
      for(int i : groups[g].members)
        plan.to.push_back(cheapest(index, g, i));
      if(std::find(plan.to.begin(), plan.to.end(), groups.size()) == plan.to.end() &&
         !has_right_angle(groups[g], circles))
        plans.push_back(plan);
    }
    std::sort(plans.begin(), plans.end(), [&](const Plan& a, const Plan& b) { return is_lighter(a.from, b.from); });
    return plans;
  }

  // Removes the plans of which any member is rejected. The limit on misfits is larger than elsewhere. A shape that
  // joins does not change the direction, and takes no other shape with it.
  void verify(std::vector<Plan>& plans)
  {
    std::vector<int> candidates;
    Regular_planes planes;
    for(const Plan& plan : plans)
      for(std::size_t k = 0; k < plan.to.size(); ++k) {
        candidates.push_back(groups[plan.from].members[k]);
        planes.push_back(through_centroid(shapes[candidates.back()], groups[plan.to[k]].direction));
      }
    const std::vector<char> is_rejected = verified.test(
      candidates, planes, {tuning::leftovers::misfit_share, tuning::leftovers::price_of_direction * mean_size()});
    auto rejected_member = is_rejected.begin();
    plans.erase(std::remove_if(plans.begin(), plans.end(),
                               [&](const Plan& plan) {
                                 const auto first = rejected_member;
                                 rejected_member += std::ptrdiff_t(plan.to.size());
                                 return std::find(first, rejected_member, char(1)) != rejected_member;
                               }),
                plans.end());
  }

  // Mean number of points of a shape: the unit of the price of a direction.
  double mean_size() const
  {
    double points = 0, members = 0;
    for(const Direction_group& g : groups) {
      points += g.weight;
      members += double(g.members.size());
    }
    return points / (std::max)(members, 1.);
  }

  // In the order of the plans. A group that another one has joined stays, and no group joins a removed one. What is
  // skipped is planned again in the next step.
  void carry_out(const std::vector<Plan>& plans)
  {
    std::vector<char> stays(groups.size(), 0), is_gone(groups.size(), 0);
    for(const Plan& plan : plans) {
      if(stays[plan.from] ||
         std::any_of(plan.to.begin(), plan.to.end(), [&](std::size_t g) { return is_gone[g] != 0; }))
        continue;
      is_gone[plan.from] = 1;
      for(std::size_t k = 0; k < plan.to.size(); ++k) {
        stays[plan.to[k]] = 1;
        move(groups[plan.from].members[k], groups[plan.to[k]]);
      }
      groups[plan.from].members.clear();
    }
    groups.erase(std::remove_if(groups.begin(), groups.end(),
                                [](const Direction_group& g) { return g.members.empty() && !g.is_given; }),
                 groups.end());
  }

  // Members stay ascending. The matrix is not needed any more, as directions are final.
  void move(int shape, Direction_group& to) const
  {
    to.members.insert(std::lower_bound(to.members.begin(), to.members.end(), shape), shape);
    to.weight += shapes[shape].scatter.count;
  }

  const Shape_fits& shapes;
  double squared_rms, sine;
  Verified& verified;
  std::vector<Direction_group>& groups;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTION_JOINER_H
