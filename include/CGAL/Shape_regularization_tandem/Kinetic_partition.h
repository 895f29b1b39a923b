// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_KINETIC_PARTITION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_KINETIC_PARTITION_H

#include <CGAL/version.h>

#if CGAL_VERSION_NR < 1060000900
#error "Kinetic_partition needs CGAL 6: leave the parameter partition of closed_surface() out"
#endif

#include <CGAL/Shape_regularization_tandem/internal/surface/Kinetic_cells.h>

#include <vector>

namespace CGAL {
namespace Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief the kinetic space partition of CGAL 6, for the parameter `partition` of `closed_surface()`.

The convex hull of the points of each plane, about, grows until it meets another one \cgalCite{BL20}:
`CGAL::Kinetic_space_partition_3`. It takes many times as long as the default.

It is in the header `CGAL/Shape_regularization_tandem/Kinetic_partition.h`, which no other one includes. With CGAL 5 this
header does not compile. While CGAL makes the partition, what is written to `std::cout` and `std::cerr` is lost, in other
threads, too: CGAL prints remarks there.

`closed_surface()` throws `std::runtime_error` if CGAL makes no partition of the planes. Fewer planes, or the default, may
do then.
*/
struct Kinetic_partition {
  /// \cond SKIP_IN_MANUAL
  internal::surface::Cells operator()(const std::vector<internal::surface::Plane_coverage>& planes,
                                      const CGAL::Bbox_3& box) const
  {
    return internal::surface::Kinetic_cells(planes, box).cells();
  }
  /// \endcond
};

} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_KINETIC_PARTITION_H
