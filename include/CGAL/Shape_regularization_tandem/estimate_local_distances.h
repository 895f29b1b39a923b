// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_ESTIMATE_LOCAL_DISTANCES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_ESTIMATE_LOCAL_DISTANCES_H

#include <CGAL/Shape_regularization_tandem/internal/range_maps.h>
#include <CGAL/Tandem/internal/cloud/import_cloud.h>
#include <CGAL/Tandem/internal/engine/local_distances.h>

#include <vector>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief estimates a tolerance for each point: the largest distance to the plane of its shape, where the noise varies over
the cloud.

It is the `maximum_distance` that `estimate_parameters()` gives for all points, times the noise about the point against that
of the cloud, and smooth along the surfaces: \ref Tandem_parameters_estimated. Whether the noise varies for certain says
`estimate_parameters()`; then there is a margin. The estimate does not depend on the order of the points, and is computed on
the host, whatever the tag.

It is in the header `CGAL/Shape_regularization_tandem/estimate_local_distances.h`, which
`CGAL/Shape_regularization_tandem.h` does not include: it is never compiled beforehand.

\param points a range of points
\param np as those of `detect_planes()`, of which those for points and normals count

\return a value for each item of the range, in its order, in the units of the points; NaN for points that are ignored
\throw std::length_error more than 2^31 points (of one process)
\throw std::range_error the extent of the points is more than 2^24 times 1e270
*/
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class PointRange,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
std::vector<double> estimate_local_distances(const PointRange& points, const NamedParameters& np = NamedParameters())
{
  return internal::on_backend<ConcurrencyTag>(points, np, [&](auto& backend, const auto& traits) {
    const internal::Import in = internal::read_range(backend, points, np, traits);
    return internal::estimate_local_distances(backend, in);
  });
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_ESTIMATE_LOCAL_DISTANCES_H
