// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Coplanarity: parallel shapes of nearly equal offsets share a plane, if their
// points agree. What they refuse is clustered once more with half the radius.

#ifndef CGAL_TANDEM_INTERNAL_COPLANAR_CLASSES_H
#define CGAL_TANDEM_INTERNAL_COPLANAR_CLASSES_H

#include <CGAL/Tandem/internal/offsets.h>
#include <CGAL/Tandem/internal/relations.h>

#include <algorithm>

namespace CGAL {
namespace Tandem {
namespace internal {

class Coplanar_classes {
public:
  // direction: what shapes share a direction, -1 if none.
  Coplanar_classes(const std::vector<Shape_fit>& shapes, const std::vector<int>& direction, double maximum_offset)
    : shapes(shapes), direction(direction), maximum_offset(maximum_offset)
  {}

  // plane: the planes through the centroids, which become those of the classes.
  template <class Verified>
  void fit(Verified& verified, std::vector<Regular_plane>& plane, std::vector<int>& class_of)
  {
    std::vector<int> pending;
    for(std::size_t i = 0; i < shapes.size(); ++i)
      if(direction[i] >= 0)
        pending.push_back(int(i));
    std::stable_sort(pending.begin(), pending.end(), [&](int a, int b) { return direction[a] < direction[b]; });
    double radius = maximum_offset;
    for(int round = 0; round < 2 && !pending.empty(); ++round, radius *= 0.5) {
      add_classes(pending, plane, radius);
      pending = ask_points(verified, plane);
    }
    for(std::size_t c = 0; c < classes.size(); ++c)
      for(int i : classes[c].members)
        if(classes[c].members.size() > 1) {
          class_of[i] = int(c);
          plane[i].offset = classes[c].offset;
        }
  }

private:
  struct Class {
    std::vector<int> members; // by rising offset
    double offset;
  };

  // pending is sorted by direction; single shapes need no class.
  void add_classes(const std::vector<int>& pending, const std::vector<Regular_plane>& plane, double radius)
  {
    for(std::size_t first = 0, last; first < pending.size(); first = last) {
      std::vector<double> offset, weight;
      for(last = first; last < pending.size() && direction[pending[last]] == direction[pending[first]]; ++last) {
        offset.push_back(plane[pending[last]].offset);
        weight.push_back(shapes[pending[last]].scatter.count);
      }
      if(offset.size() < 2)
        continue;
      for(std::vector<int>& c : cluster_offsets(offset, weight, radius)) {
        for(int& k : c)
          k = pending[first + k];
        if(c.size() > 1)
          classes.push_back({c, 0});
      }
    }
    for(Class& c : classes)
      c.offset = mean_offset(c, plane);
  }

  double mean_offset(const Class& c, const std::vector<Regular_plane>& plane) const
  {
    Offset_index::Mean mean(plane[c.members.front()].offset);
    for(int i : c.members)
      mean.add(plane[i].offset, shapes[i].scatter.count);
    return mean.value();
  }

  template <class Verified>
  std::vector<int> ask_points(Verified& verified, const std::vector<Regular_plane>& plane)
  {
    std::vector<int> candidates;
    std::vector<Regular_plane> planes;
    for(const Class& c : classes)
      for(int i : c.members) {
        candidates.push_back(i);
        planes.push_back({plane[i].normal, c.offset});
      }
    const std::vector<char> is_refused = verified.test(candidates, planes);
    std::vector<int> refused;
    std::size_t k = 0;
    for(Class& c : classes) {
      std::vector<int> kept;
      for(int i : c.members)
        (is_refused[k++] ? refused : kept).push_back(i);
      c.members.swap(kept);
    }
    classes.erase(std::remove_if(classes.begin(), classes.end(), [](const Class& c) { return c.members.size() < 2; }),
                  classes.end());
    std::sort(refused.begin(), refused.end(),
              [&](int a, int b) { return std::make_pair(direction[a], a) < std::make_pair(direction[b], b); });
    return refused;
  }

  const std::vector<Shape_fit>& shapes;
  const std::vector<int>& direction;
  double maximum_offset;
  std::vector<Class> classes;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_COPLANAR_CLASSES_H
