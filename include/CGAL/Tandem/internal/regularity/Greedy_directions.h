// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which shapes are parallel or orthogonal: one greedy loop. By falling number of points, each shape takes the direction
// of one before it, or a right angle to one or two directions, or else its own. Then all directions are fitted
// together. Right angles are exact up to the last bit. See the manual, "Directions".

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_GREEDY_DIRECTIONS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_GREEDY_DIRECTIONS_H

#include <CGAL/Tandem/internal/base/angles.h>
#include <CGAL/Tandem/internal/regularity/Direction_group.h>

#include <utility>

namespace CGAL::Tandem::internal {

// The first placed directions to which a right angle may be worth its cost. The index has larger values for those that
// were placed earlier.
class Partner_region {
public:
  Partner_region(const Direction_group& group, double sine, double price)
    : right_angles_(group.fitted), cheap_(group.eigen.vector[0]), squared_sine_(sine * sine),
      cheap_squared_sine_(price / (group.eigen.value[1] - group.eigen.value[0]))
  {}

  static double value_of(int placed) { return 1 / (1 + double(placed)); }

  bool meets(const Direction_cell& cell, double largest) const
  {
    return largest > least_value_ && right_angles_.may_be_below(squared_sine_, cell) &&
           cheap_.may_be_below(cheap_squared_sine_, cell);
  }

  void add(int placed)
  {
    first_.insert(std::upper_bound(first_.begin(), first_.end(), placed), placed);
    if(first_.size() > tuning::directions::partners)
      first_.pop_back();
    if(first_.size() == tuning::directions::partners)
      least_value_ = value_of(first_.back());
  }

  const std::vector<int>& first() const { return first_; }

private:
  Great_circle right_angles_, cheap_;
  double squared_sine_, cheap_squared_sine_; // bounds of squared dot products
  double least_value_ = 0;                   // of those that may still be among the first
  std::vector<int> first_;                   // ascending
};

class Greedy_directions {
public:
  Greedy_directions(const Shape_fits& shapes, const Regularity_parameters& options)
    : shapes_(shapes), options_(options), sine_(sine_deg(options.angle_tolerance_deg))
  {
    const bool has_tolerance = sine_ > tuning::relations::same_direction;
    unites_ = options.parallelism && has_tolerance;
    relates_ = options.orthogonality && has_tolerance;
    has_given_ = !options.fixed_directions.empty();
  }

  // Groups of these shapes with their directions. Those of given directions may be empty.
  std::vector<Direction_group> operator()(const std::vector<int>& active)
  {
    groups_.reserve(options_.fixed_directions.size() + active.size());
    for(const Vector& d : options_.fixed_directions)
      groups_.push_back(given_direction_group(d));
    for(int i : active)
      groups_.push_back(single_group(i));
    place_all(); // single shapes
    place_all(); // the groups that they have become
    fit_groups();
    choose_all_again(); // more right angles to lighter groups
    choose_all_again();
    fit_together();
    return std::move(groups_);
  }

private:
  Direction_group& group(int g) { return groups_[std::size_t(g)]; }
  const Direction_group& group(int g) const { return groups_[std::size_t(g)]; }
  int size() const { return int(groups_.size()); }

  void fit_groups()
  {
    for(Direction_group& g : groups_)
      g.fit(shapes_);
  }

  // Directions that are placed stay as they are until all are.
  void place_all()
  {
    fit_groups();
    std::vector<Direction_group> waiting;
    waiting.swap(groups_);
    groups_.reserve(waiting.size());
    index_ = Great_circle_index();
    dependent_.clear();
    is_dependent_.assign(waiting.size(), 0);
    for(int g : by_weight(waiting))
      place(std::move(waiting[std::size_t(g)]));
  }

  void place(Direction_group g)
  {
    if(const int leader = best_leader(g); leader >= 0) {
      std::vector<int>& members = group(leader).members;
      members.insert(members.end(), g.members.begin(), g.members.end());
      return;
    }
    g.partners = {-1, -1};
    g.followers.clear();
    groups_.push_back(std::move(g));
    choose_partners(size() - 1, 0);
    index_.add(groups_.back().direction, Partner_region::value_of(size() - 1));
  }

  // Returns the candidates.
  std::vector<int> choose_partners(int g, int chosen)
  {
    if(group(g).is_given)
      return {};
    std::vector<int> candidates = find_candidates(group(g), chosen);
    set_partners(g, best_partners(group(g), candidates));
    group(g).direction = constrained(group(g), group(g).matrix);
    return candidates;
  }

  void set_partners(int g, const Partners& partners)
  {
    for(int p : group(g).partners)
      if(p >= 0)
        group(p).followers.erase(std::find(group(p).followers.begin(), group(p).followers.end(), g));
    group(g).partners = partners;
    for(int p : partners)
      if(p >= 0)
        group(p).followers.push_back(g);
  }

  // In turn, each group chooses its partners among all, also lighter ones, but for those that depend on it. Then it is
  // in the index a second time.
  void choose_all_again()
  {
    index_ = Great_circle_index();
    for(int g = 0; g < size(); ++g)
      index_.add(group(g).direction, Partner_region::value_of(g));
    for(int g = 0; g < size(); ++g) {
      find_dependent(g);
      const std::vector<int> candidates = choose_partners(g, g);
      if(group(g).partners[1] >= 0)
        take_third(g, candidates);
      index_.add(group(g).direction, Partner_region::value_of(g));
    }
  }

  // A group with two partners can have a third one if one of the two has none itself: that becomes its follower.
  void take_third(int g, const std::vector<int>& candidates)
  {
    const Partners two = group(g).partners;
    for(int third : candidates)
      for(int i : {1, 0}) {
        Direction_group& turned = group(two[i]);
        const int kept = two[1 - i];
        const Vector n = unit(cross(group(kept).direction, group(third).direction));
        if(third == kept || turned.is_given || turned.partners[0] >= 0 ||
           !(cost_of_two(group(g), kept, third) + Stiffness(turned.eigen).cost(n) <
             group(g).cost(group(g).direction) + worth(group(g), third)))
          continue;
        find_dependent(two[i]);
        if(is_dependent_[std::size_t(third)] || is_dependent_[std::size_t(kept)])
          continue;
        set_partners(g, {kept, third});
        set_partners(two[i], {g, -1});
        group(g).direction = constrained(group(g), group(g).matrix);
        return;
      }
  }

  // The groups that depend on one, and that one, cannot be its partners.
  void find_dependent(int g)
  {
    for(int d : dependent_)
      is_dependent_[std::size_t(d)] = 0;
    dependent_ = {g};
    is_dependent_[std::size_t(g)] = 1;
    for(std::size_t k = 0; k < dependent_.size(); ++k)
      for(int f : group(dependent_[k]).followers)
        if(!is_dependent_[std::size_t(f)]) {
          is_dependent_[std::size_t(f)] = 1;
          dependent_.push_back(f);
        }
  }

  // The placed group of which the direction saves most; the first of equal ones. -1 if none saves anything.
  int best_leader(const Direction_group& g) const
  {
    if(g.is_given || !unites_)
      return -1;
    const double most = options_.direction_price(g.largest, has_given_);
    const double reach = (std::min)(sine_ + tuning::exactness::dot_margin, g.admissible_sine(most));
    std::pair<double, int> best(0, 1); // the gain, then -number
    index_.search(Near_direction_region(g.fitted, reach), [&](int k) {
      if(squared_sine(group(k).direction, g.fitted) <= sine_ * sine_)
        best = (std::max)(best, {2 * worth(g, k) - g.cost(group(k).direction), -k});
    });
    return best.second > 0 ? -1 : -best.second;
  }

  // What a degree of freedom is worth that a group shares with a placed one. Those of given directions are there
  // anyway.
  double worth(const Direction_group& g, int placed) const
  {
    const Direction_group& other = group(placed);
    return options_.price(other.is_given ? g.largest : (std::min)(g.largest, other.largest), other.is_given);
  }

  // Groups that may be partners. chosen: so many groups have chosen again.
  std::vector<int> find_candidates(const Direction_group& g, int chosen) const
  {
    if(!relates_)
      return {};
    const Stiffness stiffness(g.eigen);
    Partner_region region(g, sine_, options_.direction_price(g.largest, has_given_));
    index_.search(region, [&](int number) {
      const int k = number % size();
      const Vector& d = group(k).direction;
      if(number >= chosen && !is_dependent_[std::size_t(k)] && std::fabs(dot(d, g.fitted)) < sine_ &&
         stiffness.cost(d) < options_.direction_price(g.largest, group(k).is_given))
        region.add(k);
    });
    return region.first();
  }

  // One or two partners of which the right angles are worth most, or none.
  Partners best_partners(const Direction_group& g, const std::vector<int>& candidates) const
  {
    const Stiffness stiffness(g.eigen);
    Partners best = {-1, -1};
    double most = 0;
    const auto consider = [&](const Partners& partners, double gain) {
      if(gain > most) {
        most = gain;
        best = partners;
      }
    };
    for(int p : candidates)
      consider({p, -1}, worth(g, p) - stiffness.cost(group(p).direction));
    for(int p : candidates)
      for(int q : candidates)
        if(p < q)
          consider({p, q}, worth(g, p) + worth(g, q) - cost_of_two(g, p, q));
    return best;
  }

  // Of right angles to two groups. Two that are nearly parallel determine no third direction.
  double cost_of_two(const Direction_group& g, int p, int q) const
  {
    const Vector c = cross(group(p).direction, group(q).direction), n = unit(c);
    return dot(c, c) > tuning::directions::minimum_squared_sine && squared_sine(n, g.fitted) <= sine_ * sine_
             ? g.cost(n)
             : std::numeric_limits<double>::infinity();
  }

  // The best direction for a scatter that is orthogonal to the partners of a group.
  Vector constrained(const Direction_group& g, const Symmetric_matrix& scatter) const
  {
    const auto [p, q] = g.partners;
    if(p < 0)
      return g.fitted;
    return canonical(q < 0 ? fit_orthogonal(scatter, group(p).direction, g.fitted)
                           : orthogonal_to_both(group(p).direction, group(q).direction));
  }

  // Groups after their partners.
  std::vector<int> partners_first() const
  {
    std::vector<int> order, missing;
    for(int g = 0; g < size(); ++g) {
      missing.push_back((group(g).partners[0] >= 0) + (group(g).partners[1] >= 0));
      if(missing.back() == 0)
        order.push_back(g);
    }
    for(std::size_t k = 0; k < order.size(); ++k)
      for(int f : group(order[k]).followers)
        if(--missing[std::size_t(f)] == 0)
          order.push_back(f);
    return order;
  }

  // Followers pull at their partners: from the last group to the first, each adds to the scatter of its partners what a
  // turn of these costs it. Then, from the first to the last, directions are fitted to these scatters.
  void fit_together()
  {
    const std::vector<int> order = partners_first();
    std::vector<Symmetric_matrix> joint;
    for(const Direction_group& g : groups_)
      joint.push_back(g.matrix);
    for(auto g = order.rbegin(); g != order.rend(); ++g) {
      const auto [p, q] = group(*g).partners;
      if(p < 0)
        continue;
      const Stiffness stiffness(eigen_system(joint[std::size_t(*g)]));
      const auto pull = [&](int at, double factor) {
        joint[std::size_t(at)] = add_square(joint[std::size_t(at)], factor, stiffness.normal);
      };
      pull(p, q < 0 ? stiffness(group(p).direction) : stiffness(group(p).direction, group(q).direction));
      if(q >= 0)
        pull(q, stiffness(group(q).direction, group(p).direction));
    }
    index_ = Great_circle_index();
    for(std::size_t k = 0; k < order.size(); ++k) {
      Direction_group& g = group(order[k]);
      if(!g.is_given) {
        fit_to_partners(g, joint[std::size_t(order[k])]);
        take_same_bits(g, order);
      }
      index_.add(g.direction, 0);
    }
  }

  // Partners that cost a group more than they are worth are left out, the last one first.
  void fit_to_partners(Direction_group& g, const Symmetric_matrix& joint) const
  {
    const auto is_taken = [&](const Vector& n, double price) {
      const bool result = g.cost(n) <= price && squared_sine(n, g.fitted) <= sine_ * sine_;
      if(result)
        g.direction = n;
      return result;
    };
    auto& [p, q] = g.partners;
    if(q >= 0 && is_taken(constrained(g, joint), worth(g, p) + worth(g, q)))
      return;
    q = -1;
    if(p >= 0 && (is_taken(constrained(g, joint), worth(g, p)) || is_taken(constrained(g, g.matrix), worth(g, p))))
      return;
    p = -1;
    if(g.followers.empty() || !is_taken(canonical(eigen_system(joint).vector[0]), options_.price(g.largest)))
      g.direction = g.fitted;
  }

  // The bits of the first direction that equals this one up to rounding, if that has the right angles of the group.
  // Groups of equal bits are parallel in the result.
  void take_same_bits(Direction_group& g, const std::vector<int>& order) const
  {
    constexpr double reach = tuning::relations::same_direction;
    const auto is_orthogonal = [&](const Vector& d, int p) { return p < 0 || are_orthogonal(d, group(p).direction); };
    int first = size();
    index_.search(Near_direction_region(g.direction, reach), [&](int k) {
      const Vector& d = group(order[std::size_t(k)]).direction;
      if(squared_sine(d, g.direction) < reach * reach && is_orthogonal(d, g.partners[0]) &&
         is_orthogonal(d, g.partners[1]))
        first = (std::min)(first, k);
    });
    if(first < size())
      g.direction = group(order[std::size_t(first)]).direction;
  }

  const Shape_fits& shapes_;
  const Regularity_parameters& options_;
  double sine_; // of the angle within which directions may be parallel or orthogonal
  bool unites_, relates_, has_given_;
  std::vector<Direction_group> groups_; // those that are placed
  Great_circle_index index_;            // of their directions
  std::vector<int> dependent_;          // on the group that chooses
  std::vector<char> is_dependent_;      // the same, by group
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_GREEDY_DIRECTIONS_H
