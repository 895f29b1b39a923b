// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a ray meets a model first. The same bits on every machine.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RAY_CASTER_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RAY_CASTER_H

#include "testing/scene_model.h"

#include <limits>

namespace CGAL {
namespace Tandem {
namespace scenes {

struct Hit {
  double distance = std::numeric_limits<double>::infinity(); // in units of the length of the direction
  std::int32_t label = -1;                                   // index of the face, -1 on curved patches

  bool exists() const { return distance < std::numeric_limits<double>::infinity(); }
};

class Ray_caster {
public:
  explicit Ray_caster(const Model& model) : model_(model) {}

  // Farther than `nearest`, since a ray that begins on a surface is not to meet it.
  Hit operator()(const Vec& origin, const Vec& direction, double nearest = 0.01) const
  {
    Hit hit;
    for(std::size_t f = 0; f < model_.faces.size(); ++f) {
      const Face& face = model_.faces[f];
      const double slope = dot(face.normal, direction);
      const double distance = slope == 0 ? -1 : -(dot(face.normal, origin) + face.offset) / slope;
      if(distance > nearest && distance < hit.distance && is_surface(face, add_scaled(origin, distance, direction)))
        hit = {distance, std::int32_t(f)};
    }
    for(const Curved& curved : model_.curved)
      meet(curved, origin, direction, nearest, hit);
    return hit;
  }

private:
  // A point of the plane of a face.
  bool is_surface(const Face& face, const Vec& p) const
  {
    const auto holds = [&](const std::array<Vec, 3>& t) {
      for(int i = 0; i < 3; ++i)
        if(dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), face.normal) < 0)
          return false;
      return true;
    };
    return std::any_of(face.triangles.begin(), face.triangles.end(), holds) && !model_.is_hidden(p, 1e-7);
  }

  // Both roots of the quadratic equation, the nearer one first.
  static void meet(const Curved& curved, const Vec& origin, const Vec& direction, double nearest, Hit& hit)
  {
    const Frame& f = curved.frame;
    const bool is_sphere = curved.height == 0;
    const auto local = [&](const Vec& v) { return Vec{dot(f.x, v), dot(f.y, v), dot(f.z, v)}; };
    const Vec o = local(origin - f.origin), d = local(direction);
    const Vec a = {o.x, o.y, is_sphere ? o.z : 0}, b = {d.x, d.y, is_sphere ? d.z : 0};
    const double square = dot(b, b), half = dot(a, b);
    const double root2 = half * half - square * (dot(a, a) - curved.radius * curved.radius);
    if(square == 0 || root2 < 0)
      return;
    for(const double root : {-std::sqrt(root2), std::sqrt(root2)}) {
      const double distance = (root - half) / square, z = o.z + distance * d.z;
      if(distance > nearest && distance < hit.distance && (is_sphere || (z >= 0 && z <= curved.height)))
        hit = {distance, -1};
    }
  }

  const Model& model_;
};

} // namespace scenes
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RAY_CASTER_H
