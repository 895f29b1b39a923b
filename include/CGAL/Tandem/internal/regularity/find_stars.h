// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Stars of groups of parallel shapes (section 4.2 of the paper): a master and its followers, which are nearly
// orthogonal to it. Found greedily, by the weight of the groups. Nothing is changed.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_FIND_STARS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_FIND_STARS_H

#include <CGAL/Tandem/internal/regularity/Great_circle_index.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// A group that takes part. Two of them can be in one star only if their dot product is below both sines, and not above
// both reaches.
struct Star_candidate {
  Vector rounded; // its fit, on the grid of the Gauss map
  double sine;    // of the largest angle to a right angle
  double reach;   // the same, as far as the group can bear it; at most the sine
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

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_FIND_STARS_H
