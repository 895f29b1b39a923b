// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Decides which shapes are parallel, and the direction of each group. Groups are clusters of the Gauss map, made
// orthogonal by frames, and verified: bounds are in Verified_planes.h. Rejected shapes are clustered again within
// smaller angles, level by level. The result is a list of groups; shapes are only read. See the manual, "Gauss Map
// Clustering" and "Verification and Rollback".

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTION_FITTER_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTION_FITTER_H

#include <CGAL/Tandem/internal/regularity/Verified_planes.h>
#include <CGAL/Tandem/internal/base/angles.h>
#include <CGAL/Tandem/internal/regularity/Axis_symmetry.h>
#include <CGAL/Tandem/internal/regularity/Frames.h>
#include <CGAL/Tandem/internal/regularity/cluster_directions.h>
#include <CGAL/Tandem/internal/regularity/Direction_joiner.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// A shape is in one group at most.
template <class Verify>
class Direction_fitter {
public:
  Direction_fitter(const Shape_fits& shapes, const Regularity_options& options, Verified_planes<Verify>& verified)
    : shapes(shapes), options(options), verified(verified)
  {}

  // Groups the shapes `pending`. Those that were rejected at every level are in no group, unless leftovers are joined.
  void fit(std::vector<int> pending)
  {
    was_rejected.assign(shapes.size(), 0);
    rejected_cost.assign(shapes.size(), 0);
    join_given(pending);
    for(int level = 0; level < tuning::directions::levels && options.try_again(pending.size(), shapes.size(), level);
        ++level) {
      const double parallel_sine = sine_deg(options.angle_tolerance_deg * tuning::directions::parallel_share[level]);
      const double right_sine = sine_deg(options.angle_tolerance_deg * tuning::directions::right_share[level]);
      freeze(right_sine);
      if(options.parallelism && level > 0)
        rejoin(pending, parallel_sine);
      add_groups(pending, parallel_sine, right_sine);
      pending = fit_and_tie();
      for(int i : verify()) {
        pending.push_back(i);
        was_rejected[i] = 1;
      }
      std::sort(pending.begin(), pending.end());
    }
    if(options.parallelism && options.is_last)
      join_leftovers(pending);
    drop([](const Direction_group& g) { return g.members.empty(); });
  }

  // The groups; all have directions, also those of one shape.
  const std::vector<Direction_group>& result() const { return groups; }

  // By shape: whether its points rejected a plane and it keeps its local fit now.
  std::vector<char> rolled_back() const
  {
    std::vector<char> result = was_rejected;
    for(const Direction_group& g : groups)
      for(int i : g.members)
        if(g.members.size() > 1 || !(g.direction == canonical(shapes[i].fit.normal)))
          result[i] = 0;
    return result;
  }

private:
  // A group for each given direction, with the shapes within the angle that can bear it. A shape joins the nearest one.
  void join_given(std::vector<int>& pending)
  {
    const double right_sine = sine_deg(options.angle_tolerance_deg * tuning::directions::right_share[0]);
    for(const Vector& d : options.fixed_directions)
      groups.push_back(given_direction_group(d, right_sine));
    const double sine = sine_deg(options.angle_tolerance_deg * tuning::directions::parallel_share[0]);
    if(groups.empty() || !options.parallelism || !(sine > tuning::directions::minimum_sine))
      return;
    const Direction_index index(options.fixed_directions, sine);
    std::vector<int> rest;
    for(int i : pending) {
      std::pair<double, std::size_t> nearest(2., groups.size());
      index.near(shapes[i].fit.normal, [&](std::size_t g, double q) { nearest = (std::min)(nearest, {q, g}); });
      const bool is_joined =
        nearest.second < groups.size() && !verified.is_too_far(i, groups[nearest.second].direction);
      (is_joined ? groups[nearest.second].members : rest).push_back(i);
    }
    pending.swap(rest);
  }

  // Prepares a level: groups that have lost members are fitted again, and get the smaller angle for right angles. At
  // the last level, without right angles, the other groups keep their directions.
  void freeze(double right_sine)
  {
    for(Direction_group& g : groups) {
      g.is_frozen = right_sine == 0 && !g.has_changed;
      if(g.has_changed && !g.is_given)
        g.sine = right_sine;
    }
    refit();
  }

  // A rejected shape joins the cheapest group that has come much closer without the other rejected shapes. Equal costs:
  // the first group. All decisions use the fits of before, so the order of shapes does not matter.
  void rejoin(std::vector<int>& pending, double sine)
  {
    std::vector<Vector> fitted;
    for(const Direction_group& g : groups)
      fitted.push_back(g.fitted);
    const Direction_index index(fitted, sine);
    std::vector<int> rest;
    for(int i : pending) {
      std::pair<double, std::size_t> best(tuning::directions::rejoin_cost_share * rejected_cost[i], groups.size());
      index.near(shapes[i].fit.normal, [&](std::size_t g, double) {
        if(!groups[g].is_frozen)
          best = (std::min)(best, {verified.added(i, fitted[g]), g});
      });
      if(best.second == groups.size() || verified.is_too_far(i, fitted[best.second])) {
        rest.push_back(i);
      } else {
        std::vector<int>& m = groups[best.second].members;
        m.insert(std::lower_bound(m.begin(), m.end(), i), i);
        groups[best.second].has_changed = true;
      }
    }
    pending.swap(rest);
  }

  // Clusters `pending`; each cluster becomes a group, also of one shape.
  void add_groups(const std::vector<int>& pending, double parallel_sine, double right_sine)
  {
    std::vector<std::vector<int>> clusters;
    if(options.parallelism && parallel_sine > tuning::directions::minimum_sine) {
      std::vector<Vector> normal;
      std::vector<double> weight;
      for(int i : pending) {
        normal.push_back(shapes[i].fit.normal);
        weight.push_back(shapes[i].scatter.count);
      }
      clusters = cluster_directions(normal, weight, parallel_sine, verified);
    } else {
      for(std::size_t k = 0; k < pending.size(); ++k)
        clusters.push_back({int(k)});
    }
    for(std::vector<int>& cluster : clusters) {
      for(int& k : cluster)
        k = pending[k];
      groups.push_back(direction_group(std::move(cluster), right_sine));
    }
  }

  // Fits the groups and makes them orthogonal. Members whose moments reject the direction are taken out, before and
  // after that step. Before it, the rest is fitted again without them. Returns the rejected shapes.
  std::vector<int> fit_and_tie()
  {
    std::vector<int> rejected;
    for(int step = 0; step < tuning::directions::fits; ++step) {
      refit();
      const std::size_t before = rejected.size();
      remove_rejected([&](int i, const Direction_group& g) { return verified.is_too_far(i, g.fitted); }, rejected);
      if(rejected.size() == before)
        break;
    }
    refit();
    tie();
    remove_rejected([&](int i, const Direction_group& g) { return verified.is_too_far(i, g.direction); }, rejected);
    return rejected;
  }

  // Last step of a run: small groups join larger directions. Shapes rejected at every level take part as groups of one.
  void join_leftovers(const std::vector<int>& pending)
  {
    for(int i : pending) {
      groups.push_back(direction_group({i}, 0));
      groups.back().direction = canonical(shapes[i].fit.normal);
      groups.back().is_frozen = true;
      groups.back().fit(shapes);
    }
    Direction_joiner<Verified_planes<Verify>>(shapes, options.maximum_distance, sine_deg(options.angle_tolerance_deg),
                                              verified, groups)
      .join();
  }

  // Fits the groups whose members have changed.
  void refit()
  {
    for(Direction_group& g : groups)
      if(g.has_changed)
        g.fit(shapes);
  }

  // Sets the directions of all groups, with right angles where they are enabled.
  void tie()
  {
    if(options.orthogonality) {
      const double rms = tuning::verification::rms_share * options.maximum_distance;
      Frames(groups, rms * rms).tie(verified);
    } else {
      for(Direction_group& g : groups)
        if(!g.is_frozen)
          g.direction = g.fitted;
    }
    for(const Vector& axis : options.symmetry_axis)
      Axis_symmetry(groups, axis, options.maximum_distance).tie();
  }

  // The members of all groups, group by group.
  struct Members {
    std::vector<int> shape;
    std::vector<std::size_t> group;
  };

  Members all_members() const
  {
    Members m;
    m.shape.reserve(shapes.size());
    m.group.reserve(shapes.size());
    for(std::size_t g = 0; g < groups.size(); ++g) {
      m.shape.insert(m.shape.end(), groups[g].members.begin(), groups[g].members.end());
      m.group.resize(m.shape.size(), g);
    }
    return m;
  }

  // Counts misfits of all members in one call. Rejected members are taken out and returned.
  std::vector<int> verify()
  {
    const Members m = all_members();
    Regular_planes planes(m.shape.size());
    for(std::size_t k = 0; k < planes.size(); ++k)
      planes[k] = through_centroid(shapes[m.shape[k]], groups[m.group[k]].direction);
    std::vector<int> rejected;
    remove_members(verified.test(m.shape, planes), rejected);
    return rejected;
  }

  // Takes out members with is_rejected(shape, group).
  template <class Predicate>
  void remove_rejected(Predicate is_rejected, std::vector<int>& rejected)
  {
    const Members m = all_members();
    std::vector<char> is_out(m.shape.size());
    for(std::size_t k = 0; k < is_out.size(); ++k)
      is_out[k] = is_rejected(m.shape[k], groups[m.group[k]]);
    remove_members(is_out, rejected);
  }

  // Takes out members; is_out has one entry a member, group by group. Notes what each cost, for rejoin().
  void remove_members(const std::vector<char>& is_out, std::vector<int>& rejected)
  {
    auto out = is_out.begin();
    for(std::size_t g = 0; g < groups.size(); ++g) {
      std::vector<int>& members = groups[g].members;
      const auto end = out + std::ptrdiff_t(members.size());
      if(std::find(out, end, char(1)) == end) {
        out = end;
        continue;
      }
      std::vector<int> kept;
      for(int i : members) {
        (*out ? rejected : kept).push_back(i);
        if(*out++)
          rejected_cost[i] = verified.added(i, groups[g].fitted);
      }
      members.swap(kept);
      groups[g].has_changed = true;
    }
    drop([](const Direction_group& g) { return g.members.empty() && !g.is_given; });
  }

  template <class Predicate>
  void drop(Predicate is_dropped)
  {
    groups.erase(std::remove_if(groups.begin(), groups.end(), is_dropped), groups.end());
  }

  const Shape_fits& shapes;
  const Regularity_options& options;
  Verified_planes<Verify>& verified;
  std::vector<Direction_group> groups;
  std::vector<char> was_rejected;    // per shape: by its points, at any level
  std::vector<double> rejected_cost; // per shape: what the fit of the rejected group added (steps^2)
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTION_FITTER_H
