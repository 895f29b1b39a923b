// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What it costs that cells are inside. A ray that leaves upwards crosses the area that points cover an odd number of
// times from inside, an even one from outside. So the side of covered area with more odd rays ought to be inside, and
// the other one not: normals need no orientation, and neither floors nor the ground below a building need points. A
// boundary without points costs a part of its area, and all of it where the box of the points ends: the ground of a
// scan is not a block.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_INSIDE_COST_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_INSIDE_COST_H

#include <CGAL/Shape_regularization_tandem/internal/outlines/for_each_in_parallel.h>
#include <CGAL/Shape_regularization_tandem/internal/surface/Plane_coverage.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

class Inside_cost {
public:
  Inside_cost(const Cells& cells, const std::vector<Plane_coverage>& planes, const Vector& up)
    : cells_(cells), planes_(planes), inside_(cells.cells.size(), 0), outside_(cells.cells.size(), 0)
  {
    find_covered_areas();
    const std::vector<int> odd = numbers_of_odd_rays(up);
    for(std::size_t f = 0; f < cells.facets.size(); ++f) {
      const Facet& facet = cells.facets[f];
      const double area = area_of(cells.corners(facet));
      const double share = facet.plane == none ? 1 : cost_of_boundary;
      covered_[f] = (std::min)(covered_[f], area);
      boundary_.push_back(share * (area - covered_[f]));
      if(facet.front == none)
        continue;
      int in = facet.behind, out = facet.front;
      if(odd[std::size_t(in)] == odd[std::size_t(out)])
        continue;
      if(odd[std::size_t(in)] < odd[std::size_t(out)])
        std::swap(in, out);
      outside_[std::size_t(in)] += covered_[f];
      inside_[std::size_t(out)] += covered_[f];
    }
  }

  // Of a cell that is inside, or is not; of a facet between one that is and one that is not.
  double inside(int cell) const { return inside_[std::size_t(cell)]; }
  double outside(int cell) const { return outside_[std::size_t(cell)]; }
  double boundary(int facet) const { return boundary_[std::size_t(facet)]; }

private:
  static constexpr double cost_of_boundary = .1; // of a unit of area without points
  static constexpr int number_of_rays = 256;

  // Each point has an equal share of the area of its plane.
  void find_covered_areas()
  {
    std::vector<std::vector<std::size_t>> facets(planes_.size());
    for(std::size_t f = 0; f < cells_.facets.size(); ++f)
      if(cells_.facets[f].plane != none)
        facets[std::size_t(cells_.facets[f].plane)].push_back(f);
    covered_.assign(cells_.facets.size(), 0);
    outlines::for_each_in_parallel(planes_.size(), [&](std::size_t p) { cover(planes_[p], facets[p]); });
  }

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
    if(plane.points().empty())
      return;
    const double share = plane.covered_area() / double(plane.points().size());
    for(const Point& point : plane.points()) {
      const Kernel::Point_2 p = plane.flat(point);
      for(std::size_t i = 0; i < facets.size(); ++i)
        if(CGAL::do_overlap(boxes[i], p.bbox()) &&
           CGAL::bounded_side_2(flat[i].begin(), flat[i].end(), p) != CGAL::ON_UNBOUNDED_SIDE) {
          covered_[facets[i]] += share;
          break;
        }
    }
  }

  // Over the upper half of the sphere, evenly, on a spiral, and along no axis.
  static std::vector<Vector> directions_of_rays(const Vector& up)
  {
    const Vector axis = Kernel::Plane_3(CGAL::ORIGIN, up).base1();
    const Vector first = axis / std::sqrt(axis.squared_length()), second = CGAL::cross_product(up, first);
    std::vector<Vector> result;
    for(int i = 0; i < number_of_rays; ++i) {
      const double z = 1 - (i + .5) / number_of_rays, radius = std::sqrt(1 - z * z), angle = 2.399963 * i;
      result.push_back(radius * std::cos(angle) * first + radius * std::sin(angle) * second + z * up);
    }
    return result;
  }

  // From the middle of each cell.
  std::vector<int> numbers_of_odd_rays(const Vector& up) const
  {
    const std::vector<Vector> directions = directions_of_rays(up);
    std::vector<int> result(cells_.cells.size(), 0);
    outlines::for_each_in_parallel(result.size(), [&](std::size_t c) {
      Vector sum = CGAL::NULL_VECTOR;
      int count = 0;
      for(int f : cells_.facets_of(int(c)))
        for(const Point& corner : cells_.corners(cells_.facet(f))) {
          sum = sum + (corner - CGAL::ORIGIN);
          ++count;
        }
      const Point middle = CGAL::ORIGIN + sum / count;
      for(const Vector& d : directions)
        result[c] += std::count_if(planes_.begin(), planes_.end(),
                                   [&](const Plane_coverage& p) { return p.is_crossed_where_covered(middle, d); }) %
                     2;
    });
    return result;
  }

  const Cells& cells_;
  const std::vector<Plane_coverage>& planes_;
  std::vector<double> covered_, boundary_; // of each facet
  std::vector<double> inside_, outside_;   // of each cell
};

} // namespace surface
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_INSIDE_COST_H
