// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Coplanarity: parallel shapes of nearly equal offsets share a plane, if verification accepts it (section 4.3 of the
// paper). Rejected members are clustered again with half the radius. Neighboring classes that remain are joined if no
// member rejects the common plane. Directions stay; only offsets and class numbers are written. See the manual,
// "Coplanar Classes".

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_COPLANAR_CLASSES_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_COPLANAR_CLASSES_H

#include <CGAL/Tandem/internal/regularity/cluster_offsets.h>
#include <CGAL/Tandem/internal/regularity/relations.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

class Coplanar_classes {
public:
  // direction: by shape, the number of the direction that it shares; -1 if none.
  Coplanar_classes(const Shape_fits& shapes, const std::vector<int>& direction, const Regularity_options& options)
    : shapes(shapes), direction(direction), options(options)
  {}

  // plane: by shape, that through its centroid; it gets the offset of its class. class_of: by shape; set for members of
  // classes of two or more.
  template <class Verified>
  void fit(Verified& verified, Regular_planes& plane, std::vector<int>& class_of)
  {
    std::vector<int> pending = by_direction();
    double radius = options.maximum_offset;
    for(int round = 0; round < tuning::coplanarity::rounds && options.try_again(pending.size(), shapes.size(), round);
        ++round) {
      add_classes(verified, pending, plane, radius);
      pending = verify(verified, plane);
      radius *= tuning::coplanarity::radius_share;
    }
    // Halved radii have split what may still share a plane, so neighbors are tried in pairs at last.
    add_singles(plane);
    const int steps = options.is_last ? tuning::coplanarity::final_joining_steps : tuning::coplanarity::joining_steps;
    for(int step = 0; step < steps; ++step)
      join_neighbors(verified, plane);
    for(std::size_t c = 0; c < classes.size(); ++c)
      for(int i : classes[c].members)
        if(classes[c].members.size() > 1) {
          class_of[i] = int(c);
          plane[i].offset = classes[c].offset;
        }
  }

private:
  // Loops over fewer directions run on one thread: more would cost more time than they save.
  static constexpr std::size_t few_directions = 16;

  // Shapes of one direction that share a plane. A shape is in one class at most.
  struct Class {
    std::vector<int> members; // shapes, by rising offset when they were clustered
    int direction;
    double offset; // of the plane: the mean of the members
    // The first members of the next and the previous class if joining with it was rejected, or -1. Pairs that have not
    // changed are not tested again.
    int rejected_next = -1, rejected_previous = -1;
  };

  // The shapes that share a direction, one direction after the other, by a counting sort.
  std::vector<int> by_direction() const
  {
    const int directions = direction.empty() ? 0 : *std::max_element(direction.begin(), direction.end()) + 1;
    std::vector<std::size_t> place(std::size_t(directions) + 1, 0);
    for(int d : direction)
      if(d >= 0)
        ++place[std::size_t(d) + 1];
    std::partial_sum(place.begin(), place.end(), place.begin());
    std::vector<int> sorted(place.back());
    for(std::size_t i = 0; i < direction.size(); ++i)
      if(direction[i] >= 0)
        sorted[place[std::size_t(direction[i])]++] = int(i);
    return sorted;
  }

  // Adds the clusters of `pending`, which is sorted by direction. Directions are independent, so they are clustered in
  // parallel; classes are added in order. Offsets of all classes are computed again, since some have lost members.
  template <class Verified>
  void add_classes(const Verified& verified, const std::vector<int>& pending, const Regular_planes& plane,
                   double radius)
  {
    std::vector<std::size_t> first; // of each direction, and the end
    for(std::size_t k = 0; k < pending.size(); ++k)
      if(k == 0 || direction[pending[k]] != direction[pending[k - 1]])
        first.push_back(k);
    first.push_back(pending.size());
    std::vector<std::vector<std::vector<int>>> clusters(first.size() - 1);
    verified.for_each(
      clusters.size(),
      [&](std::size_t d) {
        std::vector<double> offset, weight;
        for(std::size_t k = first[d]; k < first[d + 1]; ++k) {
          offset.push_back(plane[pending[k]].offset);
          weight.push_back(shapes[pending[k]].scatter.count);
        }
        if(offset.size() > 1)
          clusters[d] = cluster_offsets(offset, weight, radius);
      },
      few_directions);
    for(std::size_t d = 0; d < clusters.size(); ++d)
      for(std::vector<int>& c : clusters[d]) {
        for(int& k : c)
          k = pending[first[d] + std::size_t(k)];
        if(c.size() > 1)
          classes.push_back({c, direction[c.front()], 0});
      }
    for(Class& c : classes)
      c.offset = mean_offset(c, plane);
  }

  // Weighted by points, in the order of the members.
  double mean_offset(const Class& c, const Regular_planes& plane) const
  {
    Offset_index::Mean mean(plane[c.members.front()].offset);
    for(int i : c.members)
      mean.add(plane[i].offset, shapes[i].scatter.count);
    return mean.value();
  }

  // Shapes without a class become classes of one, which can be joined with others.
  void add_singles(const Regular_planes& plane)
  {
    std::vector<char> has_class(shapes.size(), 0);
    for(const Class& c : classes)
      for(int i : c.members)
        has_class[i] = 1;
    for(std::size_t i = 0; i < shapes.size(); ++i)
      if(direction[i] >= 0 && !has_class[i])
        classes.push_back({{int(i)}, direction[i], plane[i].offset});
  }

  // Classes that have lost members, and shapes without a class, may lie close to each other. Pairs within sigma become
  // one if no member rejects the mean plane. A class is in one pair of a step at most, so that pairs are independent.
  template <class Verified>
  void join_neighbors(Verified& verified, const Regular_planes& plane)
  {
    // A total order: classes of one direction are consecutive, and members are in one class only.
    auto is_before = [](const Class& a, const Class& b) {
      if(a.direction != b.direction)
        return a.direction < b.direction;
      return a.offset != b.offset ? a.offset < b.offset : a.members.front() < b.members.front();
    };
    if(!std::is_sorted(classes.begin(), classes.end(), is_before)) // a joint mostly stays where its parts were
      std::sort(classes.begin(), classes.end(), is_before);
    std::vector<std::size_t> pairs; // the first class of each
    for(std::size_t c = 0; c + 1 < classes.size(); ++c) {
      const Class &a = classes[c], &b = classes[c + 1];
      if(a.direction != b.direction || b.offset - a.offset > options.maximum_offset)
        continue;
      if(a.rejected_next == b.members.front() && b.rejected_previous == a.members.front())
        continue; // in an earlier step
      pairs.push_back(c++);
    }
    if(pairs.empty())
      return;
    // Classes change only after all pairs are verified, in one call.
    std::vector<Class> joints;
    for(std::size_t p : pairs) {
      const Class &a = classes[p], &b = classes[p + 1];
      joints.push_back({a.members, a.direction, 0});
      joints.back().members.insert(joints.back().members.end(), b.members.begin(), b.members.end());
      joints.back().offset = mean_offset(joints.back(), plane);
    }
    const std::vector<char> is_rejected = test(verified, joints, plane);
    auto rejected_member = is_rejected.begin();
    for(std::size_t p = 0; p < pairs.size(); ++p) {
      const auto end = rejected_member + std::ptrdiff_t(joints[p].members.size());
      Class &a = classes[pairs[p]], &b = classes[pairs[p] + 1];
      if(std::find(rejected_member, end, char(1)) == end) {
        a = std::move(joints[p]);
        b.members.clear();
      } else {
        a.rejected_next = b.members.front();
        b.rejected_previous = a.members.front();
      }
      rejected_member = end;
    }
    classes.erase(std::remove_if(classes.begin(), classes.end(), [](const Class& c) { return c.members.empty(); }),
                  classes.end());
  }

  // Verifies all members against the planes of their classes, in one call. The result has one entry a member, class by
  // class.
  template <class Verified>
  static std::vector<char> test(Verified& verified, const std::vector<Class>& candidates_of,
                                const Regular_planes& plane)
  {
    std::vector<int> candidates;
    Regular_planes planes;
    for(const Class& c : candidates_of)
      for(int i : c.members) {
        candidates.push_back(i);
        planes.push_back({plane[std::size_t(i)].normal, c.offset});
      }
    return verified.test(candidates, planes);
  }

  // Takes rejected members out. Returns them and the last members of classes that have shrunk to one, by direction.
  template <class Verified>
  std::vector<int> verify(Verified& verified, const Regular_planes& plane)
  {
    const std::vector<char> is_rejected = test(verified, classes, plane);
    std::vector<int> rejected;
    auto rejected_member = is_rejected.begin();
    for(Class& c : classes) {
      const auto end = rejected_member + std::ptrdiff_t(c.members.size());
      if(std::find(rejected_member, end, char(1)) != end) {
        std::vector<int> kept;
        for(int i : c.members)
          (*rejected_member++ ? rejected : kept).push_back(i);
        c.members.swap(kept);
      }
      rejected_member = end;
    }
    for(const Class& c : classes) // a single member may be clustered again
      if(c.members.size() == 1)
        rejected.push_back(c.members.front());
    classes.erase(std::remove_if(classes.begin(), classes.end(), [](const Class& c) { return c.members.size() < 2; }),
                  classes.end());
    std::sort(rejected.begin(), rejected.end(),
              [&](int a, int b) { return std::make_pair(direction[a], a) < std::make_pair(direction[b], b); });
    return rejected;
  }

  const Shape_fits& shapes;
  const std::vector<int>& direction;
  const Regularity_options& options;
  std::vector<Class> classes;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_COPLANAR_CLASSES_H
