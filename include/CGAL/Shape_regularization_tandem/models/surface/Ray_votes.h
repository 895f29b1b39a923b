// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which side of an area is inside. A ray that leaves the area upwards crosses what points cover an odd number of times
// if it leaves to the inside, an even number of times if to the outside. So normals need no orientation, and neither
// floors nor the ground below a building need points. A ray that crosses a wall without points says nothing.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_RAY_VOTES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_RAY_VOTES_H

#include <CGAL/Shape_regularization_tandem/models/surface/Plane_coverage.h>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

class Ray_votes {
public:
  explicit Ray_votes(const Vector& up)
  {
    const Vector axis = Kernel::Plane_3(CGAL::ORIGIN, up).base1();
    const Vector first = axis / std::sqrt(axis.squared_length()), second = CGAL::cross_product(up, first);
    constexpr double golden_angle = 2.399963; // neighbors on the spiral are far apart
    for(int i = 0; i < number_of_rays; ++i) { // evenly over the upper half of the sphere, on a spiral, along no axis
      const double z = 1 - (i + .5) / number_of_rays, radius = std::sqrt(1 - z * z), angle = golden_angle * i;
      directions_.push_back(radius * std::cos(angle) * first + radius * std::sin(angle) * second + z * up);
    }
  }

  // Rays that leave one of them do not cross it.
  void add_obstacles(const std::vector<Plane_coverage>& planes)
  {
    for(const Plane_coverage& plane : planes)
      planes_.push_back(&plane);
  }

  // Of rays from these places of one of the planes, the share that says that the front is outside and what is behind
  // inside, less the share that says the opposite.
  double share(const std::vector<Point>& places, const Vector& to_front, const Plane_coverage& plane) const
  {
    constexpr std::size_t step = 97; // odd, so that all directions occur, and in no order
    if(places.empty())
      return 0;
    int sum = 0;
    for(std::size_t r = 0; r < directions_.size(); ++r) {
      const Vector& direction = directions_[r * step % directions_.size()];
      const int inside = side(places[r * places.size() / directions_.size()], direction, plane);
      sum += direction * to_front > 0 ? -inside : inside;
    }
    return sum / double(directions_.size());
  }

private:
  static constexpr int number_of_rays = 256;

  // Where a ray leaves to: 1 is inside, -1 outside, 0 unknown.
  int side(const Point& start, const Vector& direction, const Plane_coverage& own) const
  {
    int result = -1;
    for(const Plane_coverage* plane : planes_) {
      if(plane == &own)
        continue;
      const Plane_coverage::Crossing crossing = plane->crossing(start, direction);
      if(crossing == Plane_coverage::Crossing::assumed)
        return 0;
      if(crossing == Plane_coverage::Crossing::covered)
        result = -result;
    }
    return result;
  }

  std::vector<const Plane_coverage*> planes_;
  std::vector<Vector> directions_;
};

} // namespace surface
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_RAY_VOTES_H
