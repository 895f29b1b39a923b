// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Orthogonality between groups of parallel shapes (section 4.2 of the paper). Stars are found greedily: the heaviest
// group is a master, groups nearly orthogonal to it are its followers. A star is made orthogonal to at most two
// directions of earlier stars. Its followers are fitted in the plane orthogonal to the master. Two of them that are
// nearly orthogonal to each other are fitted as a frame. Only Direction_group::direction is written. Right angles are
// exact up to the last bit: see the manual, "Orthogonality: Stars and Frames".

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_FRAMES_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_FRAMES_H

#include <CGAL/Tandem/internal/regularity/Fixed_directions.h>
#include <CGAL/Tandem/internal/regularity/Great_circle_index.h>

#include <numeric>
#include <utility>

namespace CGAL::Tandem::internal {

// --- Stars of groups of parallel shapes (section 4.2 of the paper): a master and its followers, which are nearly
// orthogonal to it. Found greedily, by the weight of the groups. Nothing is changed.

// A group that takes part. Two of them can be in one star only if their dot product is below both sines, and not above
// both reaches.
struct Star_candidate {
  Vector rounded; // its fit, on the grid of the Gauss map
  double sine;    // of the largest angle to a right angle
  double reach;   // the same, as far as its cost is at most its price; at most the sine
  int group;
};

struct Star {
  int master;
  std::vector<int> followers; // by falling weight
};

// The candidates that may follow a master.
class Follower_region {
public:
  explicit Follower_region(const Star_candidate& master)
    : circle(great_circle(master.rounded)), squared_sine(widened(master.sine)), squared_reach(widened(master.reach))
  {}

  // largest: reach of the candidates of the cell.
  bool meets(const Direction_cell& cell, double largest) const
  {
    return circle.least_squared_dot(cell) <= (std::min)(squared_sine, (std::max)(squared_reach, widened(largest)));
  }

private:
  // Squared, and widened since normals on the grid are not quite of unit length.
  static double widened(double dot) { return dot * dot * (1 + tuning::exactness::rounded_dot_margin); }

  Great_circle circle;
  double squared_sine, squared_reach;
};

// Each candidate is in one star. They are sorted by falling weight: the first one left is the next master, and takes
// all that is_follower(master, candidate) accepts. Each is compared with those near its great circle.
template <class Is_follower>
std::vector<Star> find_stars(const std::vector<Star_candidate>& candidates, Is_follower is_follower)
{
  Great_circle_index rest;
  for(const Star_candidate& c : candidates)
    rest.add(c.rounded, c.reach);
  std::vector<char> is_taken(candidates.size(), 0);
  std::vector<Star> stars;
  for(std::size_t m = 0; m < candidates.size(); ++m) {
    if(is_taken[m])
      continue;
    const Star_candidate& master = candidates[m];
    rest.remove(int(m));
    std::vector<int> followers;
    if(master.sine > 0) // otherwise it has none
      rest.remove_if(Follower_region(master), [&](int k) {
        is_taken[k] = is_follower(master, candidates[k]);
        if(is_taken[k])
          followers.push_back(k);
        return is_taken[k] != 0;
      });
    std::sort(followers.begin(), followers.end());
    for(int& k : followers)
      k = candidates[k].group;
    stars.push_back({master.group, std::move(followers)});
  }
  return stars;
}

// Followers in the plane orthogonal to n, sorted by angle. The angle is replaced by a monotone function in [0, 2).
// Opposite directions have the same value, and a right angle is 1. It needs no trigonometric function.
class Follower_circle {
public:
  Follower_circle(const Vector& n, const std::vector<Vector>& follower) : basis(n)
  {
    for(std::size_t k = 0; k < follower.size(); ++k)
      sorted.push_back({place(follower[k]), k});
    std::sort(sorted.begin(), sorted.end());
  }

  // Calls f for followers by growing distance from the right angle to v, to each side until it returns true. So a
  // search usually ends after few followers.
  template <class Function>
  void near_right_angle(const Vector& v, Function f) const
  {
    const double t = place(v), right = t < 1 ? t + 1 : t - 1;
    const std::size_t n = sorted.size();
    const std::size_t at =
      std::lower_bound(sorted.begin(), sorted.end(), std::make_pair(right, std::size_t(0))) - sorted.begin();
    for(std::size_t k = 0; k < n && !f(sorted[(at + k) % n].second); ++k)
      ;
    for(std::size_t k = 0; k < n && !f(sorted[(at + 2 * n - 1 - k) % n].second); ++k)
      ;
  }

private:
  // The function of the angle: 0 along u of the basis, 1 along v.
  double place(const Vector& v) const
  {
    double c = dot(v, basis.u), s = dot(v, basis.v);
    if(s < 0 || (s == 0 && c < 0)) {
      c = -c;
      s = -s;
    }
    return c >= 0 ? s / (c + s) : 1 - c / (s - c);
  }

  Plane_basis basis;
  std::vector<std::pair<double, std::size_t>> sorted;
};

// Decisions follow the order of the groups by weight, so they do not depend on threads.
class Frames {
public:
  // A right angle may cost the points of a group as much as the degree of freedom is worth that it saves.
  Frames(std::vector<Direction_group>& groups, const Regularity_parameters& options)
    : groups(groups), options(options), fixed(options)
  {}

  // Sets the directions of all groups. Given ones stay, and are the first masters.
  void make_orthogonal()
  {
    const double all = std::accumulate(groups.begin(), groups.end(), 1.,
                                       [](double sum, const Direction_group& g) { return sum + g.weight; });
    std::vector<Star_candidate> pool;
    for(int g : by_weight(groups))
      if(groups[g].is_given) {
        fixed.add(groups[g], all);
        pool.push_back({groups[g].rounded, groups[g].sine, 0, g});
      } else {
        pool.push_back({groups[g].rounded, groups[g].sine, reach(groups[g]), g});
      }
    const auto can_follow = [&](const Star_candidate& m, const Star_candidate& j) { return is_follower(m, j); };
    for(const Star& star : find_stars(pool, can_follow))
      place(star);
  }

private:
  // A bound on the dot product with what a group can be made orthogonal to.
  double reach(const Direction_group& g) const
  {
    return (std::min)(g.sine, g.admissible_sine(options.price(g.largest)));
  }

  bool is_cheap(const Direction_group& g, const Vector& n) const { return g.cost(n) <= options.price(g.largest); }

  // Whether a group is nearly orthogonal to the master, and the right angle costs at most the price for at least one of them.
  bool is_follower(const Star_candidate& master, const Star_candidate& follower) const
  {
    if(!(std::fabs(rounded_dot(master.rounded, follower.rounded)) < (std::min)(master.sine, follower.sine)))
      return false;
    const Direction_group &m = groups[master.group], &j = groups[follower.group];
    if(m.is_given || j.is_given)
      return !j.is_given && cost_of_right_angle(j.eigen, m.fitted) <= options.price(j.largest);
    return cost_of_right_angle(j.eigen, m.fitted) <= options.price(j.largest) ||
           cost_of_right_angle(m.eigen, j.fitted) <= options.price(j.largest);
  }

  // The direction of a star: the master and its followers, turned by 90 degrees onto it, fitted as one (equation 1 of
  // the paper). If that costs the master too much, it is its own fit.
  Vector joint_direction(const Star& star) const
  {
    const Direction_group& master = groups[star.master];
    if(star.followers.empty())
      return fixed.chained(master);
    Direction_group joint = {};
    joint.sine = master.sine;
    joint.matrix = master.matrix;
    joint.weight = master.weight;
    joint.largest = master.largest;
    for(int l : star.followers) {
      joint.matrix = joint.matrix + turned(groups[l].matrix, groups[l].fitted, master.fitted);
      joint.weight += groups[l].weight;
      joint.largest = (std::max)(joint.largest, groups[l].largest);
    }
    joint.fit();
    const Vector n = fixed.chained(joint);
    return is_cheap(master, n) ? n : fixed.chained(master);
  }

  // Fixes the directions of a star: master, followers orthogonal to it, pairs of followers. Followers that are chained
  // to an earlier star are determined already: is_fixed. One that the right angle costs too much stays as it is.
  void place(const Star& star)
  {
    fixed.begin_star();
    const Vector n = groups[star.master].is_given ? groups[star.master].direction
                                                  : fixed.fix(groups[star.master], joint_direction(star), {0, 0, 0});
    std::vector<Vector> follower(star.followers.size());
    std::vector<char> is_fixed(star.followers.size());
    for(std::size_t k = 0; k < follower.size(); ++k) {
      const Direction_group& group = groups[star.followers[k]];
      is_fixed[k] = fixed.chain(group, n, group.rounded, follower[k]);
      if(!is_fixed[k])
        follower[k] = fit_orthogonal(group.matrix, n, group.fitted);
    }
    pair_followers(star, n, follower, is_fixed);
    for(std::size_t k = 0; k < follower.size(); ++k)
      fix_follower(groups[star.followers[k]], follower[k], n);
  }

  void fix_follower(Direction_group& group, const Vector& direction, const Vector& master)
  {
    if(is_cheap(group, direction))
      fixed.fix(group, direction, master);
    else
      fixed.fix(group, group.fitted, {0, 0, 0});
  }

  // Each follower takes the free follower closest to a right angle as partner, in the order of weight. Both must be
  // within the angle of each other, and not both fixed.
  void pair_followers(const Star& star, const Vector& n, std::vector<Vector>& follower,
                      std::vector<char>& is_fixed) const
  {
    const Follower_circle circle(n, follower);
    std::vector<char> is_taken(follower.size(), 0);
    for(std::size_t k = 0; k < follower.size(); ++k) {
      if(is_taken[k])
        continue;
      const Direction_group& a = groups[star.followers[k]];
      std::pair<double, std::size_t> best(2.0, k);
      circle.near_right_angle(follower[k], [&](std::size_t j) {
        const double d = std::fabs(dot(follower[k], follower[j]));
        if(!(d < a.sine))
          return true;
        const bool is_free =
          j != k && !is_taken[j] && !(is_fixed[j] && is_fixed[k]) && d < groups[star.followers[j]].sine;
        if(is_free)
          best = (std::min)(best, {d, j});
        return is_free;
      });
      if(best.second != k && tie_pair(star, n, {k, best.second}, follower, is_fixed))
        is_taken[k] = is_taken[best.second] = 1;
    }
  }

  // Makes two followers orthogonal to each other if neither exceeds its bound. Free ones are fitted together; beside a
  // fixed one, the other is determined. Returns whether it did.
  bool tie_pair(const Star& star, const Vector& n, std::pair<std::size_t, std::size_t> pair,
                std::vector<Vector>& follower, const std::vector<char>& is_fixed) const
  {
    const std::size_t i = is_fixed[pair.second] ? pair.second : pair.first;
    const std::size_t j = pair.first + pair.second - i;
    const Direction_group &a = groups[star.followers[i]], &b = groups[star.followers[j]];
    const Vector va = is_fixed[i] ? follower[i] : fit_frame(a.matrix, b.matrix, n, follower[i]);
    const Vector vb = orthogonal_to_both(n, va);
    const double price = options.price((std::min)(a.largest, b.largest));
    const bool are_cheap = a.cost(va) <= price && b.cost(vb) <= price;
    if(are_cheap) {
      follower[i] = va;
      follower[j] = vb;
    }
    return are_cheap;
  }

  std::vector<Direction_group>& groups;
  const Regularity_parameters& options;
  Fixed_directions fixed;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_FRAMES_H
