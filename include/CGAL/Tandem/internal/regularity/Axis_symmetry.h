// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Groups of parallel shapes that make nearly the same angle with an axis, such as the two sides of a gable roof, get
// exactly the same one. Right angles stay: a group that would no longer have one keeps its direction. Only
// Direction_group::direction is written. See the manual, "Given Directions and Symmetry".

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_AXIS_SYMMETRY_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_AXIS_SYMMETRY_H

#include <CGAL/Tandem/internal/base/angles.h>
#include <CGAL/Tandem/internal/regularity/Direction_group.h>
#include <CGAL/Tandem/internal/regularity/Great_circle_index.h>
#include <CGAL/Tandem/internal/regularity/relations.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL::Tandem::internal {

// The angle between a direction and an axis, in [0, 90] degrees, as a unit vector.
struct Axis_angle {
  double cosine, sine;

  Axis_angle(const Vector& direction, const Vector& axis)
    : cosine(std::fabs(dot(direction, axis))), sine(length(cross(direction, axis)))
  {}
};

// Greedy: the heaviest group that is left takes all those within the angle.
class Axis_symmetry {
public:
  // axis: a unit vector. A group may be turned at the price of a degree of freedom.
  Axis_symmetry(std::vector<Direction_group>& groups, const Vector& axis, const Regularity_parameters& options)
    : groups(groups), axis(axis), options(options), largest_sine(sine_deg(options.angle_tolerance_deg))
  {
    for(const Direction_group& g : groups)
      circles.add(g.direction, 0);
  }

  void make_symmetric()
  {
    std::vector<int> pool = candidates();
    while(!pool.empty()) {
      const int master = pool.front();
      const auto end = std::stable_partition(pool.begin(), pool.end(), [&](int g) { return !is_near(master, g); });
      if(pool.end() - end > 1)
        turn(std::vector<int>(end, pool.end()));
      pool.erase(end, pool.end());
    }
  }

private:
  // What turns a group about the axis: the direction of the axis and one orthogonal to it span the plane of its
  // normals.
  struct Turnable {
    int group;
    Vector across;  // orthogonal to the axis
    Vector partner; // orthogonal to the group and to the axis, or null
  };

  // Groups that may turn, by falling weight.
  std::vector<int> candidates() const
  {
    std::vector<int> result;
    for(int g : by_weight(groups))
      if(!groups[g].is_given && largest_sine > 0 && !are_exactly_orthogonal(groups[g].direction, axis) &&
         Axis_angle(groups[g].direction, axis).sine > largest_sine)
        result.push_back(g);
    return result;
  }

  // Whether two groups make the same angle with the axis, within the tolerance. True for a == b.
  bool is_near(int a, int b) const
  {
    const Axis_angle m(groups[a].direction, axis), j(groups[b].direction, axis);
    return a == b || std::fabs(fused(m.cosine, j.sine, -(m.sine * j.cosine))) < largest_sine;
  }

  // The groups of a class get the mean of their angles, weighted by points. Those that it costs too much leave it.
  void turn(const std::vector<int>& members)
  {
    std::vector<Turnable> turnable;
    for(int g : members) {
      Turnable t = {g, {}, {0, 0, 0}};
      if(find_across(t))
        turnable.push_back(t);
    }
    std::vector<Vector> turned;
    for(std::size_t before = turnable.size() + 1; turnable.size() < before;) {
      before = turnable.size();
      if(before < 2)
        return;
      turned = turned_directions(turnable);
      std::vector<Turnable> kept;
      for(std::size_t k = 0; k < before; ++k)
        if(groups[turnable[k].group].cost(turned[k]) <= options.price(groups[turnable[k].group].largest))
          kept.push_back(turnable[k]);
      turnable.swap(kept);
    }
    for(std::size_t k = 0; k < turnable.size(); ++k)
      groups[turnable[k].group].direction = canonical(turned[k]);
  }

  std::vector<Vector> turned_directions(const std::vector<Turnable>& turnable) const
  {
    double cosine = 0, sine = 0;
    for(const Turnable& t : turnable) {
      const Axis_angle angle(groups[t.group].direction, axis);
      cosine = fused(groups[t.group].weight, angle.cosine, cosine);
      sine = fused(groups[t.group].weight, angle.sine, sine);
    }
    const double norm = std::sqrt(fused(cosine, cosine, sine * sine));
    std::vector<Vector> result;
    result.reserve(turnable.size());
    for(const Turnable& t : turnable)
      result.push_back(direction_at(t, cosine / norm, sine / norm));
    return result;
  }

  // Whether the group may turn and keep its right angles: each of its partners has to be orthogonal to the axis, and
  // all of them are parallel then.
  bool find_across(Turnable& t) const
  {
    const Vector n = groups[t.group].direction;
    bool is_free = true;
    circles.search(Great_circle(n), [&](int h) {
      const Vector& d = groups[h].direction;
      if(!are_exactly_orthogonal(n, d))
        return;
      is_free = is_free && are_exactly_orthogonal(d, axis);
      t.partner = d;
    });
    const Vector across =
      dot(t.partner, t.partner) > 0 ? orthogonal_to_both(axis, t.partner) : made_orthogonal(n, axis);
    t.across = dot(across, n) < 0 ? -across : across;
    return is_free;
  }

  // The direction of the group at an angle to the axis, of the sign that it has.
  Vector direction_at(const Turnable& t, double cosine, double sine) const
  {
    const double sign = dot(groups[t.group].direction, axis) < 0 ? -1 : 1;
    const Vector n = unit(add_scaled((sign * cosine) * axis, sine, t.across));
    return dot(t.partner, t.partner) > 0 ? made_orthogonal(n, t.partner) : n;
  }

  std::vector<Direction_group>& groups;
  Vector axis;
  const Regularity_parameters& options;
  double largest_sine;        // of the tolerance
  Great_circle_index circles; // of the directions of all groups, before any turns
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_AXIS_SYMMETRY_H
