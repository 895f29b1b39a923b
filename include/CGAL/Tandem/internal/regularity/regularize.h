// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The regularity step: shapes become parallel, orthogonal and coplanar where that is worth more than what it costs
// their points (section 4 of the paper). Directions are fixed first (Greedy_directions), then offsets
// (Coplanar_groups). Input are moments, so no point is read; the result is Relations. Neither labels nor shapes change
// here; rounds/regularize_shapes.h applies the result.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_REGULARIZE_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_REGULARIZE_H

#include <CGAL/Tandem/internal/base/angles.h>
#include <CGAL/Tandem/internal/regularity/Axis_symmetry.h>
#include <CGAL/Tandem/internal/regularity/Greedy_directions.h>
#include <CGAL/Tandem/internal/regularity/relations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- Decides which parallel shapes share a plane (section 4.3 of the paper): those where the degree of freedom that
// this saves is worth more than the loss of their points. Directions stay. See the manual, "Relations by Price".

class Coplanar_groups {
public:
  // direction: by shape, the number of the direction that it shares; -1 if none.
  Coplanar_groups(const Shape_fits& shapes, const std::vector<int>& direction, const Regularity_parameters& options)
    : shapes_(shapes), direction_(direction), parameters_(options)
  {}

  // plane: by shape, that through its centroid; it gets the offset of its group. group_of: by shape; set for members of
  // groups of two or more.
  void fit(Regular_planes& plane, std::vector<int>& group_of) const
  {
    std::vector<std::tuple<int, double, int>> order; // the shapes by direction, then by offset
    for(std::size_t i = 0; i < direction_.size(); ++i)
      if(direction_[i] >= 0)
        order.push_back({direction_[i], plane[i].offset, int(i)});
    std::sort(order.begin(), order.end());
    std::vector<Group> groups;
    groups.reserve(order.size());
    for(const auto& [direction, offset, i] : order) {
      const Scatter& s = shapes_[std::size_t(i)].scatter;
      groups.push_back({groups.size(), groups.size() + 1, direction, offset, s.weight(), s.count});
    }
    while(unite(groups))
      ;
    for(std::size_t g = 0; g < groups.size(); ++g) {
      std::vector<int> members;
      for(std::size_t k = groups[g].first; k < groups[g].last && groups[g].last - groups[g].first > 1; ++k)
        if(can_move(std::get<2>(order[k]), groups[g].offset - std::get<1>(order[k])))
          members.push_back(std::get<2>(order[k]));
      if(members.size() > 1)
        for(int i : members) {
          group_of[std::size_t(i)] = int(g);
          plane[std::size_t(i)].offset = groups[g].offset;
        }
    }
  }

private:
  // Shapes that follow each other in the order.
  struct Group {
    std::size_t first, last;
    int direction;
    double offset, weight, largest; // the mean offset of the members, their weight, and the points of the largest one
  };

  // Unions of unions may move a shape by more than sigma, or at more than its plane is worth. It leaves its group then.
  bool can_move(int shape, double distance) const
  {
    const Scatter& s = shapes_[std::size_t(shape)].scatter;
    return std::fabs(distance) <= parameters_.maximum_offset_steps &&
           s.weight() * (distance * distance) <= parameters_.price(s.count);
  }

  // What two neighbors gain as one: negative beyond sigma, 0 for equal planes where a degree of freedom is worth
  // nothing.
  double gain(const Group& a, const Group& b) const
  {
    const double d = b.offset - a.offset;
    if(a.direction != b.direction || !(d <= parameters_.maximum_offset_steps))
      return -1;
    const double weight = a.weight * b.weight / (a.weight + b.weight);
    return fused(-weight, d * d, parameters_.price((std::min)(a.largest, b.largest)));
  }

  // Unites the neighbors that gain more as one than either does with its other neighbor; of equal ones the first.
  bool unite(std::vector<Group>& groups) const
  {
    std::size_t size = 0;
    double before = -1, own = -1; // the gains with the one before, of the one before and of this one
    for(std::size_t g = 0; g < groups.size(); ++g) {
      const Group b = groups[g];
      const double next = g + 1 < groups.size() ? gain(b, groups[g + 1]) : -1;
      if(own >= 0 && own > before && own >= next) {
        Group& a = groups[size - 1];
        a.offset = fused(b.offset - a.offset, b.weight / (a.weight + b.weight), a.offset);
        a.weight += b.weight;
        a.largest = (std::max)(a.largest, b.largest);
        a.last = b.last;
      } else
        groups[size++] = b;
      before = own;
      own = next;
    }
    const bool is_any = size < groups.size();
    groups.erase(groups.begin() + std::ptrdiff_t(size), groups.end());
    return is_any;
  }

  const Shape_fits& shapes_;
  const std::vector<int>& direction_;
  const Regularity_parameters& parameters_;
};

// By shape, the number of its direction; -1 for shapes without a group. Groups whose directions have the same bits get
// the same number, since joint fits can make them equal.
inline std::vector<int> shared_directions(const std::vector<Direction_group>& groups, std::size_t n)
{
  std::map<std::array<double, 3>, int> number;
  std::vector<int> direction_of(n, -1);
  for(const Direction_group& g : groups) {
    const std::array<double, 3> bits = {g.direction.x, g.direction.y, g.direction.z};
    for(int i : g.members) // given directions may have none: numbers are below n
      direction_of[i] = number.emplace(bits, int(number.size())).first->second;
  }
  return direction_of;
}

// Fills r with directions and planes in the order of the first shape of each. plane[i] is the plane of shape i.
// direction[i] and coplanar[i] are the numbers of what it shares, or -1: then it gets entries of its own.
inline void number_relations(const Regular_planes& plane, const std::vector<int>& direction,
                             const std::vector<int>& coplanar, Relations& r)
{
  const std::size_t n = plane.size();
  std::vector<int> direction_number(n, -1), plane_number(n, -1);
  const auto enter = [](const auto& item, int shared, std::vector<int>& number, auto& table) {
    int own = -1;
    int& entry = shared < 0 ? own : number[std::size_t(shared)];
    if(entry < 0) {
      entry = int(table.size());
      table.push_back(item);
    }
    return entry;
  };
  for(std::size_t i = 0; i < n; ++i) {
    r.direction_of.push_back(enter(plane[i].normal, direction[i], direction_number, r.directions));
    r.plane_of.push_back(enter(plane[i], coplanar[i], plane_number, r.planes));
  }
}

// Shapes that their group turns by more than the tolerance, or at more than a direction is worth, get groups of their
// own, of their own fits. Unions of unions may turn a shape so far, and right angles of their direction.
inline void release_shapes(const Shape_fits& shapes, const Regularity_parameters& options,
                           std::vector<Direction_group>& groups)
{
  const double sine = sine_deg(options.angle_tolerance_deg);
  std::vector<Direction_group> released;
  for(Direction_group& g : groups) {
    const auto is_given = [&](int p) { return p >= 0 && groups[std::size_t(p)].is_given; };
    const bool takes_given = g.is_given || is_given(g.partners[0]) || is_given(g.partners[1]);
    const auto is_kept = [&](int i) {
      const Scatter& s = shapes[std::size_t(i)].scatter;
      const Vector own = canonical(shapes[std::size_t(i)].fit.normal);
      const double cost = quadratic_form(s.matrix, g.direction) - quadratic_form(s.matrix, own);
      return g.direction == own ||
             (squared_sine(g.direction, own) <= sine * sine && cost <= options.direction_price(s.count, takes_given));
    };
    const auto end = std::stable_partition(g.members.begin(), g.members.end(), is_kept);
    for(auto i = end; i != g.members.end(); ++i) {
      released.push_back(single_group(*i));
      released.back().fit(shapes);
      released.back().direction = released.back().fitted;
    }
    g.members.erase(end, g.members.end());
  }
  const auto is_empty = [](const Direction_group& g) { return g.members.empty() && !g.is_given; };
  groups.erase(std::remove_if(groups.begin(), groups.end(), is_empty), groups.end());
  groups.insert(groups.end(), released.begin(), released.end());
}

// A search that ends when something is found.
template <class Region>
struct Until {
  Region region;
  const char& is_found;

  bool meets(const Direction_cell& cell, double largest) const { return !is_found && region.meets(cell, largest); }
};

// By shape: whether it keeps its own direction although another one is within the angle.
inline std::vector<char> find_rejected(const Shape_fits& shapes, const std::vector<Direction_group>& groups,
                                       const Regularity_parameters& options)
{
  std::vector<char> is_rejected(shapes.size(), 0);
  const double sine = sine_deg(options.angle_tolerance_deg);
  if(!options.parallelism || !(sine > tuning::relations::same_direction))
    return is_rejected;
  Great_circle_index index;
  for(const Direction_group& g : groups)
    index.add(g.direction, 0);
  for(const Direction_group& g : groups) {
    if(g.members.size() != 1 || !(g.direction == g.fitted))
      continue;
    char& is_found = is_rejected[std::size_t(g.members.front())];
    index.search(Until<Near_direction_region>{{g.direction, sine}, is_found}, [&](int other) {
      const Vector& d = groups[std::size_t(other)].direction;
      is_found = is_found || (!(d == g.direction) && squared_sine(d, g.direction) <= sine * sine);
    });
  }
  return is_rejected;
}

// is_excluded: by shape; those keep their local fits and get no relations. The same holds for shapes without points or
// without a normal. finds_rejected: whether Relations::is_rolled_back is asked for.
inline Relations regularize(const Shape_fits& shapes, const std::vector<char>& is_excluded,
                            const Regularity_parameters& options, bool finds_rejected = true)
{
  // Normals are unit or null; 0.5 separates them whatever the rounding.
  std::vector<int> active;
  for(std::size_t i = 0; i < shapes.size(); ++i)
    if(!is_excluded[i] && shapes[i].scatter.count > 0 && dot(shapes[i].fit.normal, shapes[i].fit.normal) > 0.5)
      active.push_back(int(i));
  std::vector<Direction_group> groups = Greedy_directions(shapes, options)(active);
  for(const Vector& axis : options.symmetry_axis)
    Axis_symmetry(groups, axis, options).make_symmetric();
  release_shapes(shapes, options, groups);
  Regular_planes plane;
  for(const Shape_fit& s : shapes)
    plane.push_back(plane_through(canonical(s.fit.normal), s.scatter.centroid));
  for(const Direction_group& g : groups)
    for(int i : g.members)
      plane[i] = plane_through(g.direction, shapes[i].scatter.centroid);
  const std::vector<int> direction = shared_directions(groups, shapes.size());
  std::vector<int> coplanar(shapes.size(), -1);
  if(options.coplanarity && options.maximum_offset_steps > 0)
    Coplanar_groups(shapes, direction, options).fit(plane, coplanar);
  Relations r;
  number_relations(plane, direction, coplanar, r);
  if(finds_rejected)
    r.is_rolled_back = find_rejected(shapes, groups, options);
  return r;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_REGULARIZE_H
