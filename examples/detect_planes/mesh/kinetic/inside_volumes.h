// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which volumes are inside, by a minimum cut. A ray to infinity crosses the covered area of the planes an odd number of
// times from inside, an even one from outside. So the side of covered area with more odd rays votes to be inside, and
// the other one not to be: normals need no orientation, and what has no points, such as the floor of a building,
// misleads rays on both sides alike. A boundary without points costs its area.

#ifndef DETECT_PLANES_INSIDE_VOLUMES_H
#define DETECT_PLANES_INSIDE_VOLUMES_H

#include "mesh/kinetic/Plane_coverage.h"
#include "mesh/kinetic/Volumes.h"
#include "mesh/mesh_methods.h"
#include "signals.h"

#include <CGAL/Bbox_2.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/boost/graph/alpha_expansion_graphcut.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace program {

struct Facet {
  Volumes::Dart edge;
  double area;
  double covered_area;
};

inline std::vector<Plane_coverage> coverage_of_planes(const Mesh_input& input)
{
  std::vector<std::vector<Kernel::Point_3>> points(input.planes.size());
  for(const Mesh_input::Item& item : input.items)
    points[std::size_t(std::get<2>(item))].push_back(std::get<0>(item));
  std::vector<Plane_coverage> result;
  for(std::size_t p = 0; p < points.size(); ++p)
    result.emplace_back(input.planes[p], points[p]);
  return result;
}

// Adds the squares of the plane to the facets that they are in.
inline void add_covered_area(const Volumes& volumes, const Plane_coverage& coverage, const std::vector<Facet*>& facets)
{
  struct Flat_facet {
    std::vector<Kernel::Point_2> corners;
    CGAL::Bbox_2 box;
    Facet* facet;
  };
  std::vector<Flat_facet> flat;
  for(Facet* facet : facets) {
    flat.push_back({{}, {}, facet});
    for(const Kernel::Point_3& p : volumes.corners_of_facet(facet->edge))
      flat.back().corners.push_back(coverage.flat(p));
    flat.back().box = CGAL::bbox_2(flat.back().corners.begin(), flat.back().corners.end());
  }
  for(const Kernel::Point_2& p : coverage.centers_of_squares()) {
    const auto found = std::find_if(flat.begin(), flat.end(), [&](const Flat_facet& f) {
      return CGAL::do_overlap(f.box, p.bbox()) &&
             CGAL::bounded_side_2(f.corners.begin(), f.corners.end(), p) != CGAL::ON_UNBOUNDED_SIDE;
    });
    if(found != flat.end())
      found->facet->covered_area += coverage.area_of_square();
  }
}

inline std::vector<Facet> facets_with_areas(const Volumes& volumes, const std::vector<Plane_coverage>& coverages)
{
  std::vector<Facet> facets;
  for(Volumes::Dart edge : volumes.facets())
    facets.push_back({edge, area_of(volumes.corners_of_facet(edge)), 0});
  std::vector<std::vector<Facet*>> of_plane(coverages.size());
  for(Facet& f : facets)
    if(volumes.plane(f.edge) >= 0)
      of_plane[std::size_t(volumes.plane(f.edge))].push_back(&f);
  for(std::size_t p = 0; p < coverages.size(); ++p)
    add_covered_area(volumes, coverages[p], of_plane[p]);
  for(Facet& f : facets)
    f.covered_area = (std::min)(f.covered_area, f.area);
  return facets;
}

// Spread evenly, on a spiral, and along no axis.
inline std::vector<Kernel::Vector_3> directions_of_rays(int number)
{
  std::vector<Kernel::Vector_3> result;
  for(int i = 0; i < number; ++i) {
    const double z = 1 - (2 * i + 1) / double(number), radius = std::sqrt(1 - z * z), angle = 2.399963 * i;
    result.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return result;
}

inline double share_of_odd_rays(const Kernel::Point_3& start, const std::vector<Kernel::Vector_3>& directions,
                                const std::vector<Plane_coverage>& coverages)
{
  const auto is_odd = [&](const Kernel::Vector_3& direction) {
    const auto crossings = std::count_if(coverages.begin(), coverages.end(), [&](const Plane_coverage& c) {
      return c.is_crossed_where_covered(start, direction);
    });
    return crossings % 2 != 0;
  };
  return double(std::count_if(directions.begin(), directions.end(), is_odd)) / double(directions.size());
}

// From the barycenter of each volume; none beyond the bounding box.
inline std::vector<double> shares_of_odd_rays(const Volumes& volumes, const std::vector<Plane_coverage>& coverages)
{
  constexpr int number_of_rays = 64;
  const std::vector<Kernel::Vector_3> directions = directions_of_rays(number_of_rays);
  std::vector<double> result;
  for(const Kernel::Point_3& barycenter : volumes.barycenters()) {
    if(is_interrupted())
      throw Interrupted();
    result.push_back(share_of_odd_rays(barycenter, directions, coverages));
  }
  result.push_back(0);
  return result;
}

// For each volume, and for what is beyond the bounding box.
inline std::vector<bool> inside_volumes(const Volumes& volumes, const std::vector<Plane_coverage>& coverages)
{
  constexpr double cost_of_boundary = .5;  // of a unit of area without points
  constexpr double clear_difference = .25; // of the shares: the vote has its full weight
  enum Label : std::size_t { inside, outside };
  const std::vector<double> odd_share = shares_of_odd_rays(volumes, coverages);
  std::vector<std::vector<double>> costs(2, std::vector<double>(odd_share.size(), 0)); // of each label
  std::vector<std::pair<std::size_t, std::size_t>> sides;
  std::vector<double> side_costs;
  double area = 0;
  for(const Facet& f : facets_with_areas(volumes, coverages)) {
    std::size_t behind = volumes.volume(f.edge), front = volumes.volume_beyond(f.edge);
    sides.emplace_back(behind, front);
    side_costs.push_back(cost_of_boundary * (f.area - f.covered_area));
    if(odd_share[behind] < odd_share[front])
      std::swap(behind, front);
    const double difference = odd_share[behind] - odd_share[front];
    const double vote = f.covered_area * (std::min)(1., difference / clear_difference);
    costs[outside][behind] += vote;
    costs[inside][front] += vote;
    area += f.area;
  }
  costs[inside].back() += 2 * area;

  std::vector<std::size_t> labels(odd_share.size(), outside);
  CGAL::alpha_expansion_graphcut(sides, side_costs, costs, labels);
  std::vector<bool> result;
  for(std::size_t label : labels)
    result.push_back(label == inside);
  return result;
}

} // namespace program

#endif // DETECT_PLANES_INSIDE_VOLUMES_H
