// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ground that a closed surface stands on, where it is known: a level base, below which nothing is inside, and a footprint,
// outside of which nothing is.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SITE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SITE_H

#include <CGAL/Shape_regularization_tandem/models/surface/Plane_coverage.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace CGAL::Tandem::internal::surface {

// A polygon with holes, seen from above: its outer boundary first.
using Rings = std::vector<Flat_polygon>;

inline bool is_in(const Rings& rings, const Kernel::Point_2& p)
{
  const auto is_inside = [&](const Flat_polygon& ring) {
    return CGAL::do_overlap(CGAL::bbox_2(ring.begin(), ring.end()), p.bbox()) &&
           CGAL::bounded_side_2(ring.begin(), ring.end(), p) != CGAL::ON_UNBOUNDED_SIDE;
  };
  return is_inside(rings[0]) && std::none_of(rings.begin() + 1, rings.end(), is_inside);
}

struct Site {
  Vector up;                  // of length 1; z if there is a footprint
  std::optional<double> base; // its height; there is one if there is a footprint
  Rings footprint;            // none: everywhere

  Coefficients base_plane() const { return {up.x(), up.y(), up.z(), -*base}; }

  // Seen from above.
  CGAL::Bbox_2 box() const { return CGAL::bbox_2(footprint[0].begin(), footprint[0].end()); }
  bool contains(const Point& p) const
  {
    return (!base || height(base_plane(), p) >= 0) && (footprint.empty() || is_in(footprint, {p.x(), p.y()}));
  }

  // Whether an edge of the footprint is that near, seen from above.
  bool has_edge_near(const Point& p, double distance) const
  {
    const Kernel::Point_2 q(p.x(), p.y());
    for(const Flat_polygon& ring : footprint)
      for(std::size_t i = 0; i < ring.size(); ++i)
        if(CGAL::squared_distance(Kernel::Segment_2(ring[i], ring[(i + 1) % ring.size()]), q) < distance * distance)
          return true;
    return false;
  }

  // f(wall) for the walls on the edges of the footprint, from the base up to a height.
  template <class Function>
  void for_each_wall(double top, Function f) const
  {
    for(const Flat_polygon& ring : footprint)
      for(std::size_t i = 0; i < ring.size(); ++i) {
        const Kernel::Point_2 &p = ring[i], &q = ring[(i + 1) % ring.size()];
        f({{p.x(), p.y(), top}, {q.x(), q.y(), top}, {q.x(), q.y(), *base}, {p.x(), p.y(), *base}});
      }
  }
};

} // namespace CGAL::Tandem::internal::surface

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SITE_H
