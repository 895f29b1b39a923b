// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Orthogonality between groups of parallel shapes (section 4.2 of the paper).
// Greedy stars: the heaviest group is a master, the groups nearly orthogonal to it
// are its leaves. A star is turned onto at most two directions of earlier stars,
// its leaves are fitted in the plane orthogonal to the master, in pairs where they
// are nearly orthogonal to each other. So nothing is ever over-constrained, and
// what is tied is tied up to the last bit.

#ifndef CGAL_TANDEM_INTERNAL_FRAMES_H
#define CGAL_TANDEM_INTERNAL_FRAMES_H

#include <CGAL/Tandem/internal/constrained_fit.h>
#include <CGAL/Tandem/internal/directions.h>

#include <map>
#include <numeric>

namespace CGAL {
namespace Tandem {
namespace internal {

// Shapes that share one direction. They are tied to others only within the angle
// whose sine is given, which is smaller for shapes that were refused before.
struct Direction_group {
  std::vector<int> members;
  double sine;
  Symmetric_matrix matrix; // sum of the members' scatter
  double weight;           // points
  Eigen_system eigen;      // of the matrix
  Vector fitted;           // least squares, unconstrained
  Vector rounded;          // the same on the grid of the Gauss map
  double least;            // sum of squared distances of the fit
  Vector direction;        // the result
  bool is_frozen;          // keeps its direction, others may be tied to it

  // Sum of squared distances that a direction adds to the best one.
  double cost(const Vector& n) const { return quadratic_form(matrix, n) - least; }
};

// The least cost of turning the normal of a scatter orthogonal to x, to first order.
inline double cost_of_right_angle(const Eigen_system& e, const Vector& x)
{
  const double gap1 = (std::max)(e.value[1] - e.value[0], 1e-300);
  const double gap2 = (std::max)(e.value[2] - e.value[0], 1e-300);
  const double d0 = dot(e.vector[0], x), d1 = dot(e.vector[1], x), d2 = dot(e.vector[2], x);
  const double ease = d1 * d1 / gap1 + d2 * d2 / gap2;
  return ease > 0 ? d0 * d0 / ease : (d0 == 0 ? 0 : 1e300);
}

class Frames {
public:
  // squared_rms: what a tie may add to the mean squared distance of the points.
  Frames(std::vector<Direction_group>& groups, double squared_rms) : groups(groups), squared_rms(squared_rms) {}

  void tie()
  {
    for(int g : by_weight())
      if(groups[g].is_frozen)
        add_placed(groups[g].direction, groups[g].sine);
    for(const Star& star : make_stars())
      place(star);
  }

private:
  struct Star {
    int master;
    std::vector<int> leaves; // by falling weight
    Symmetric_matrix matrix; // of the master and of its leaves turned onto it (equation 1)
    double weight;
  };

  struct Placed {
    Vector direction, rounded;
    double sine;

    Placed(const Vector& direction, double sine) : direction(direction), rounded(rounded_normal(direction)), sine(sine) {}

    bool is_near_right_angle(const Vector& rounded_fit, double fit_sine) const
    {
      return std::fabs(rounded_dot(rounded, rounded_fit)) < (std::min)(sine, fit_sine);
    }
  };

  // Chaining spends a quarter of what is allowed: the star has been fitted already.
  double chain_bound(double weight) const { return 0.25 * squared_rms * weight; }

  std::vector<int> by_weight() const
  {
    std::vector<int> order(groups.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      if(groups[a].weight != groups[b].weight)
        return groups[a].weight > groups[b].weight;
      return groups[a].members.front() < groups[b].members.front();
    });
    return order;
  }

  // A right angle that costs both sides too much would only be refused later.
  bool is_leaf(const Direction_group& m, const Direction_group& j) const
  {
    if(!(std::fabs(rounded_dot(m.rounded, j.rounded)) < (std::min)(m.sine, j.sine)))
      return false;
    return cost_of_right_angle(j.eigen, m.fitted) <= squared_rms * j.weight ||
           cost_of_right_angle(m.eigen, j.fitted) <= squared_rms * m.weight;
  }

  std::vector<Star> make_stars() const
  {
    std::vector<Star> stars;
    std::vector<int> pool = by_weight(), rest;
    pool.erase(std::remove_if(pool.begin(), pool.end(), [&](int g) { return groups[g].is_frozen; }), pool.end());
    for(; !pool.empty(); pool.swap(rest)) {
      const Direction_group& m = groups[pool.front()];
      Star star = {pool.front(), {}, m.matrix, m.weight};
      rest.clear();
      for(std::size_t k = 1; k < pool.size(); ++k)
        (is_leaf(m, groups[pool[k]]) ? star.leaves : rest).push_back(pool[k]);
      for(int l : star.leaves) {
        star.matrix = star.matrix + turned(groups[l].matrix, groups[l].fitted, m.fitted);
        star.weight += groups[l].weight;
      }
      stars.push_back(star);
    }
    return stars;
  }

  void place(const Star& star)
  {
    const std::size_t known = placed.size(); // directions of earlier stars
    const Vector n = settle(star.master, chained_master(star, known), {0, 0, 0});
    std::vector<Vector> leaf(star.leaves.size());
    std::vector<char> is_fixed(star.leaves.size());
    for(std::size_t k = 0; k < leaf.size(); ++k)
      is_fixed[k] = chain_leaf(groups[star.leaves[k]], n, known, leaf[k]);
    pair_leaves(star, n, leaf, is_fixed);
    for(std::size_t k = 0; k < leaf.size(); ++k)
      settle(star.leaves[k], leaf[k], n);
  }

  // The master's direction, orthogonal to one or two placed ones if that is cheap.
  Vector chained_master(const Star& star, std::size_t known) const
  {
    const Direction_group& m = groups[star.master];
    const bool is_alone = star.leaves.empty();
    const Eigen_system e = is_alone ? m.eigen : eigen_system(star.matrix);
    const Vector best = is_alone ? m.fitted : e.vector[0];
    const double bound = std::fma(0.25 * squared_rms, star.weight, quadratic_form(star.matrix, best));
    const Vector rounded = rounded_normal(best);
    double least = chain_bound(star.weight);
    std::size_t p = known;
    for(std::size_t i = 0; i < known; ++i) {
      if(!placed[i].is_near_right_angle(rounded, m.sine))
        continue;
      const double c = cost_of_right_angle(e, placed[i].direction);
      if(c < least) {
        least = c;
        p = i;
      }
    }
    if(p == known)
      return best;
    const Vector n = fit_orthogonal(star.matrix, placed[p].direction, best);
    if(quadratic_form(star.matrix, n) > bound)
      return best;
    const std::size_t q = second_constraint(star, placed[p].direction, n, bound);
    return q < known ? orthogonal_to_both(placed[p].direction, placed[q].direction) : n;
  }

  std::size_t second_constraint(const Star& star, const Vector& p, const Vector& n, double bound) const
  {
    const Vector rounded = rounded_normal(n);
    std::size_t q = placed.size();
    for(std::size_t i = 0; i < placed.size(); ++i) {
      if(!placed[i].is_near_right_angle(rounded, groups[star.master].sine))
        continue;
      const Vector c = cross(p, placed[i].direction);
      if(!(dot(c, c) > 0.04))
        continue;
      const double f = quadratic_form(star.matrix, unit(c));
      if(f <= bound && (q == placed.size() || f < bound)) {
        bound = f;
        q = i;
      }
    }
    return q;
  }

  // A leaf orthogonal to an earlier direction too, or else only to the master n.
  bool chain_leaf(const Direction_group& leaf, const Vector& n, std::size_t known, Vector& result) const
  {
    double least = chain_bound(leaf.weight);
    std::size_t p = known;
    for(std::size_t i = 0; i < known; ++i) {
      if(!placed[i].is_near_right_angle(leaf.rounded, leaf.sine))
        continue;
      const Vector c = cross(n, placed[i].direction);
      if(!(dot(c, c) > 0.04))
        continue;
      const double f = leaf.cost(unit(c));
      if(f < least) {
        least = f;
        p = i;
      }
    }
    result = p < known ? orthogonal_to_both(n, placed[p].direction) : fit_orthogonal(leaf.matrix, n, leaf.fitted);
    return p < known;
  }

  // Leaves in the plane orthogonal to n, ordered by a monotone function of their
  // angle in [0, 2) under which a right angle is 1.
  class Circle {
  public:
    Circle(const Vector& n, const std::vector<Vector>& leaf) : basis(n)
    {
      for(std::size_t k = 0; k < leaf.size(); ++k)
        sorted.push_back({place(leaf[k]), k});
      std::sort(sorted.begin(), sorted.end());
    }

    // Calls f for leaves by growing distance from the right angle to v, to each
    // side until it returns true.
    template <class Function>
    void near_right_angle(const Vector& v, Function f) const
    {
      const double t = place(v), right = t < 1 ? t + 1 : t - 1;
      const std::size_t n = sorted.size();
      const std::size_t at = std::lower_bound(sorted.begin(), sorted.end(), std::make_pair(right, std::size_t(0))) -
                             sorted.begin();
      for(std::size_t k = 0; k < n && !f(sorted[(at + k) % n].second); ++k)
        ;
      for(std::size_t k = 0; k < n && !f(sorted[(at + 2 * n - 1 - k) % n].second); ++k)
        ;
    }

  private:
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

  // Each leaf takes the free leaf closest to a right angle to it as partner.
  void pair_leaves(const Star& star, const Vector& n, std::vector<Vector>& leaf, std::vector<char>& is_fixed) const
  {
    const Circle circle(n, leaf);
    std::vector<char> is_taken(leaf.size(), 0);
    for(std::size_t k = 0; k < leaf.size(); ++k) {
      if(is_taken[k])
        continue;
      const Direction_group& a = groups[star.leaves[k]];
      std::pair<double, std::size_t> best(2.0, k);
      circle.near_right_angle(leaf[k], [&](std::size_t j) {
        const double d = std::fabs(dot(leaf[k], leaf[j]));
        if(!(d < a.sine))
          return true;
        const bool is_free = j != k && !is_taken[j] && !(is_fixed[j] && is_fixed[k]) && d < groups[star.leaves[j]].sine;
        if(is_free)
          best = (std::min)(best, {d, j});
        return is_free;
      });
      if(best.second != k && tie_pair(star, n, {k, best.second}, leaf, is_fixed))
        is_taken[k] = is_taken[best.second] = 1;
    }
  }

  // One frame for two leaves, if both can afford it.
  bool tie_pair(const Star& star, const Vector& n, std::pair<std::size_t, std::size_t> pair, std::vector<Vector>& leaf,
                const std::vector<char>& is_fixed) const
  {
    const std::size_t i = is_fixed[pair.second] ? pair.second : pair.first;
    const std::size_t j = pair.first + pair.second - i;
    const Direction_group &a = groups[star.leaves[i]], &b = groups[star.leaves[j]];
    const Vector va = is_fixed[i] ? leaf[i] : fit_frame(a.matrix, b.matrix, n, leaf[i]);
    const Vector vb = orthogonal_to_both(n, va);
    const bool is_cheap = a.cost(va) <= squared_rms * a.weight && b.cost(vb) <= squared_rms * b.weight;
    if(is_cheap) {
      leaf[i] = va;
      leaf[j] = vb;
    }
    return is_cheap;
  }

  // Gives a group its direction; one that equals a placed direction up to rounding
  // becomes the same bits, if it stays orthogonal to its master.
  Vector settle(int group, const Vector& n, const Vector& master)
  {
    const Vector direction = canonical(n);
    const double reach = 1e-9;
    Vector& result = groups[group].direction;
    for(double x : {direction.x, -direction.x}) // the sign is arbitrary on the equator
      for(auto i = placed_at.lower_bound(x - reach); i != placed_at.end() && i->first <= x + reach; ++i) {
        const Vector& d = placed[i->second].direction;
        if(Direction_index::squared_distance(d, direction) < reach * reach && std::fabs(dot(d, master)) <= 5e-16)
          return result = d;
      }
    add_placed(direction, groups[group].sine);
    return result = direction;
  }

  void add_placed(const Vector& direction, double sine)
  {
    placed_at.insert({direction.x, placed.size()});
    placed.push_back(Placed(direction, sine));
  }

  std::vector<Direction_group>& groups;
  double squared_rms;
  std::vector<Placed> placed;
  std::multimap<double, std::size_t> placed_at; // by x
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FRAMES_H
