// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What it costs that cells are inside. Most rays that leave a covered facet say which of its two cells is inside: it
// costs the covered area if that one is not, or the other one is. A boundary that nothing covers costs a part of its
// area, and all of it where the box of the points ends: the ground of a scan is not a block.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_INSIDE_COST_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_INSIDE_COST_H

#include <CGAL/Shape_regularization_tandem/internal/surface/Covered_facets.h>
#include <CGAL/Shape_regularization_tandem/internal/surface/Ray_votes.h>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

class Inside_cost {
public:
  Inside_cost(const Cells& cells, const std::vector<Plane_coverage>& planes, const Vector& up)
    : covered_(cells, planes), inside_(cells.cells.size(), 0), outside_(cells.cells.size(), 0)
  {
    Ray_votes rays(up);
    rays.add_obstacles(planes);
    std::vector<double> votes(cells.facets.size());
    outlines::for_each_in_parallel(votes.size(), [&](std::size_t f) { votes[f] = vote(cells, planes, f, rays); });
    for(std::size_t f = 0; f < cells.facets.size(); ++f) {
      const Facet& facet = cells.facets[f];
      const double free = covered_[f].area - covered_[f].scanned.area - covered_[f].assumed.area;
      boundary_.push_back((facet.plane == none ? 1 : worth_of_free) * (std::max)(0., free));
      if(facet.front == none)
        continue;
      const bool is_behind = votes[f] > 0;
      outside_[std::size_t(is_behind ? facet.behind : facet.front)] += std::fabs(votes[f]);
      inside_[std::size_t(is_behind ? facet.front : facet.behind)] += std::fabs(votes[f]);
    }
  }

  // Of a cell that is inside, or is not; of a facet between one that is and one that is not.
  double inside(int cell) const { return inside_[std::size_t(cell)]; }
  double outside(int cell) const { return outside_[std::size_t(cell)]; }
  double boundary(int facet) const { return boundary_[std::size_t(facet)]; }

  std::size_t number_of_points(int facet) const { return covered_[std::size_t(facet)].number_of_points; }

private:
  static constexpr double worth_of_free = .1; // of a unit of area without points

  // The area by which the cell behind a facet is inside and the one in front of it outside; negative if it is the other
  // way round.
  double vote(const Cells& cells, const std::vector<Plane_coverage>& planes, std::size_t f, const Ray_votes& rays) const
  {
    const Facet& facet = cells.facets[f];
    if(facet.plane == none)
      return 0;
    const std::vector<Point> corners = cells.corners(facet);
    Vector to_front = CGAL::NULL_VECTOR;
    for(std::size_t i = 2; i < corners.size(); ++i)
      to_front = to_front + CGAL::cross_product(corners[i - 1] - corners[0], corners[i] - corners[0]);
    const auto of = [&](const Covered_part& part) {
      const double share = rays.share(part.places, to_front, planes[std::size_t(facet.plane)]);
      return share < 0 ? -part.area : share > 0 ? part.area : 0;
    };
    return of(covered_[f].scanned) + worth_of_free * of(covered_[f].assumed);
  }

  Covered_facets covered_;
  std::vector<double> boundary_;         // of each facet
  std::vector<double> inside_, outside_; // of each cell
};

} // namespace surface
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_INSIDE_COST_H
