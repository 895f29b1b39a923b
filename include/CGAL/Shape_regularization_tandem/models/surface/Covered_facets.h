// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much of each facet points cover, or walls without points are assumed to, with places there.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_COVERED_FACETS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_COVERED_FACETS_H

#include <CGAL/Shape_regularization_tandem/models/for_each_in_parallel.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Plane_coverage.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

struct Covered_part {
  double area = 0;
  std::vector<Point> places;
};

struct Covered_facet {
  double area; // of all of the facet
  Covered_part scanned, assumed;
};

class Covered_facets {
public:
  Covered_facets(const Cells& cells, const std::vector<Plane_coverage>& planes)
    : cells_(cells), planes_(planes), facets_(cells.facets.size())
  {
    std::vector<std::vector<std::size_t>> of_plane(planes.size());
    for(std::size_t f = 0; f < facets_.size(); ++f) {
      facets_[f].area = area_of(cells.corners(cells.facets[f]));
      if(cells.facets[f].plane != none)
        of_plane[std::size_t(cells.facets[f].plane)].push_back(f);
    }
    for_each_in_parallel(planes.size(), [&](std::size_t p) { cover(planes_[p], of_plane[p]); });
  }

  const Covered_facet& operator[](std::size_t facet) const { return facets_[facet]; }

private:
  static constexpr std::size_t places_of_assumed = 256; // about so many are tried in a facet

  void cover(const Plane_coverage& plane, const std::vector<std::size_t>& facets)
  {
    std::vector<std::vector<Kernel::Point_2>> flat;
    std::vector<CGAL::Bbox_2> boxes;
    for(std::size_t f : facets) {
      flat.emplace_back();
      for(const Point& corner : cells_.corners(cells_.facets[f]))
        flat.back().push_back(plane.flat(corner));
      boxes.push_back(CGAL::bbox_2(flat.back().begin(), flat.back().end()));
    }
    for(std::size_t n = 0; n < plane.points().size(); ++n) {
      const Point& point = plane.points()[n];
      const Kernel::Point_2 p = plane.flat(point);
      for(std::size_t i = 0; i < facets.size(); ++i)
        if(CGAL::do_overlap(boxes[i], p.bbox()) &&
           CGAL::bounded_side_2(flat[i].begin(), flat[i].end(), p) != CGAL::ON_UNBOUNDED_SIDE) {
          Covered_facet& facet = facets_[facets[i]];
          facet.scanned.area += plane.area_of_point(n);
          facet.scanned.places.push_back(point);
          break;
        }
    }
    for(std::size_t f : facets) {
      Covered_facet& facet = facets_[f];
      facet.scanned.area = (std::min)(facet.scanned.area, facet.area);
      if(plane.has_assumed_part())
        add_assumed(plane, f);
    }
  }

  // Of places that are spread evenly over the facet.
  void add_assumed(const Plane_coverage& plane, std::size_t f)
  {
    Covered_facet& facet = facets_[f];
    const std::vector<Point> corners = cells_.corners(cells_.facets[f]);
    std::vector<double> areas(2, 0.); // of the triangles that end at each corner
    for(std::size_t i = 2; i < corners.size(); ++i)
      areas.push_back(area_of({corners[0], corners[i - 1], corners[i]}));
    const double sum = std::accumulate(areas.begin(), areas.end(), 0.);
    if(!(sum > 0))
      return;
    std::size_t tried = 0;
    double left = 0; // of a place, from the triangles before
    for(std::size_t i = 2; i < corners.size(); ++i) {
      const Vector u = corners[i - 1] - corners[0], v = corners[i] - corners[0];
      for(left += areas[i] / sum * double(places_of_assumed); left >= 1; --left, ++tried) {
        double a = double(tried) * .7548776662466927, b = double(tried) * .5698402909980532; // a sequence of no pattern
        a -= std::floor(a);
        b -= std::floor(b);
        const Point p = a + b > 1 ? corners[0] + (1 - a) * u + (1 - b) * v : corners[0] + a * u + b * v;
        if(plane.is_assumed(p))
          facet.assumed.places.push_back(p);
      }
    }
    if(tried > 0)
      facet.assumed.area =
        (std::min)(facet.area - facet.scanned.area, double(facet.assumed.places.size()) / double(tried) * facet.area);
  }

  const Cells& cells_;
  const std::vector<Plane_coverage>& planes_;
  std::vector<Covered_facet> facets_;
};

} // namespace surface
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_COVERED_FACETS_H
