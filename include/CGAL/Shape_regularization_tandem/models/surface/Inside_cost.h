// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What it costs that cells are inside. Most rays that leave a covered facet say which of its two cells is inside: it
// costs the covered area if that one is not, or the other one is. A boundary that nothing covers costs a part of its
// area, and all of it where the box of the points ends: the ground of a scan is not a block.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_INSIDE_COST_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_INSIDE_COST_H

#include <CGAL/Shape_regularization_tandem/models/surface/Covered_facets.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Ray_votes.h>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

class Inside_cost {
public:
  Inside_cost(const Cells& cells, const std::vector<Plane_coverage>& planes, const Vector& up)
    : inside_(cells.cells.size(), 0), outside_(cells.cells.size(), 0)
  {
    const Covered_facets covered(cells, planes);
    Ray_votes rays(up);
    rays.add_obstacles(planes);
    std::vector<double> votes(cells.facets.size());
    for_each_in_parallel(votes.size(), [&](std::size_t f) {
      const Facet& facet = cells.facets[f];
      if(facet.plane != none)
        votes[f] = vote(covered[f], normal_of(cells.corners(facet)), planes[std::size_t(facet.plane)], rays);
    });
    for(std::size_t f = 0; f < cells.facets.size(); ++f) {
      const Facet& facet = cells.facets[f];
      const double free = covered[f].area - covered[f].scanned.area - covered[f].assumed.area;
      boundary_.push_back((facet.plane == none ? 1 : worth_of_free) * (std::max)(0., free));
      number_of_points_.push_back(covered[f].scanned.places.size());
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

  // That are on a facet.
  std::size_t number_of_points(int facet) const { return number_of_points_[std::size_t(facet)]; }

private:
  static constexpr double worth_of_free = .1; // of a unit of area without points

  // The area by which the cell behind a facet is inside and the one in front of it outside; negative if it is the other
  // way round.
  static double vote(const Covered_facet& covered, const Vector& to_front, const Plane_coverage& plane,
                     const Ray_votes& rays)
  {
    const auto of = [&](const Covered_part& part) {
      const double share = rays.share(part.places, to_front, plane);
      return share < 0 ? -part.area : share > 0 ? part.area : 0;
    };
    return of(covered.scanned) + worth_of_free * of(covered.assumed);
  }

  std::vector<double> boundary_;              // of each facet
  std::vector<std::size_t> number_of_points_; // of each facet
  std::vector<double> inside_, outside_;      // of each cell
};

} // namespace surface
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_INSIDE_COST_H
