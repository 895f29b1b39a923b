// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cells of a box that planes cut: each plane cuts those that the hull of its points meets or is close to. So their
// number grows about linearly with that of the planes, and gaps between shapes are bridged.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_LIMITED_PARTITION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_LIMITED_PARTITION_H

#include <CGAL/Shape_regularization_tandem/models/surface/Cell_cutter.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Plane_coverage.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

// Whether an edge of one convex polygon, which is counterclockwise, separates the other one by more than a distance.
inline bool separates(const std::vector<Kernel::Point_2>& a, const std::vector<Kernel::Point_2>& b, double distance)
{
  for(std::size_t i = 0; i < a.size(); ++i) {
    const Kernel::Vector_2 edge = a[(i + 1) % a.size()] - a[i];
    const auto is_beyond = [&](const Kernel::Point_2& p) {
      return CGAL::determinant(edge, p - a[i]) < -distance * std::sqrt(edge.squared_length());
    };
    if(std::all_of(b.begin(), b.end(), is_beyond))
      return true;
  }
  return false;
}

inline Cells limited_partition(const std::vector<Plane_coverage>& planes, const CGAL::Bbox_3& box)
{
  const double reach = .05 * extent_of(box); // of the planes beyond their points
  Cell_cutter cutter(box);
  for(const Plane_coverage& plane : planes) {
    const int number = cutter.add_plane(plane.plane());
    for(int c = int(cutter.number_of_cells()) - 1; c >= 0; --c) {
      std::vector<Kernel::Point_2> corners, section;
      for(const Point& p : cutter.section(c, number))
        corners.push_back(plane.flat(p));
      CGAL::convex_hull_2(corners.begin(), corners.end(), std::back_inserter(section));
      if(section.size() > 2 && !separates(section, plane.hull(), reach) && !separates(plane.hull(), section, reach))
        cutter.split(c, number);
    }
  }
  return cutter.cells();
}

} // namespace surface
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_LIMITED_PARTITION_H
