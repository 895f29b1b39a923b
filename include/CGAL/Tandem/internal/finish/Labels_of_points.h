// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which points of a surfel belong to its shape. In the loop all do; in the result those that are within their tolerances.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_LABELS_OF_POINTS_H
#define CGAL_TANDEM_INTERNAL_FINISH_LABELS_OF_POINTS_H

#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// The labels of surfels, and of the points that they stand for. A point has the label of its surfel, or none.
struct Labels_of_points {
  Surfels_view surfels;
  const std::uint32_t* label;       // by surfel
  const std::uint32_t* point_label; // by point; null: all have those of their surfels

  // Whether point p of surfel i has its label.
  CGAL_TANDEM_HD bool has(std::uint32_t i, std::uint32_t p) const
  {
    return label[i] < first_mark && (point_label == nullptr || point_label[p] == label[i]);
  }

  // f(p) for the points of surfel i that have its label.
  template <class F>
  CGAL_TANDEM_HD void for_each_point(std::uint32_t i, F f) const
  {
    const Range points = surfels.points(i);
    for(std::uint32_t p = points.first; p < points.last; ++p)
      if(has(i, p))
        f(p);
  }
};

// The shapes of a result, as functors read them.
struct Final_shapes {
  Labels_of_points labels;
  const std::uint32_t* shape; // of each surfel, and of ghosts; no_index if there is none
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_LABELS_OF_POINTS_H
