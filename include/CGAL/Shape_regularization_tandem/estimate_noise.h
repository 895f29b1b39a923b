// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_ESTIMATE_NOISE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_ESTIMATE_NOISE_H

#include <CGAL/Shape_regularization_tandem/internal/range_maps.h>
#include <CGAL/Tandem/internal/cloud/import_cloud.h>
#include <CGAL/Tandem/internal/neighbors/measure_cloud.h>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief measures the noise of points, from which `estimate_parameters()` estimates `maximum_distance`: a quantile, over
the surfaces, of the root mean square distance of points to the planes of their neighborhoods. It is 0 where there is no
surface. The manual has the numbers: \ref Tandem_parameters_estimated.

It is in the header `CGAL/Shape_regularization_tandem/estimate_noise.h`, which `CGAL/Shape_regularization_tandem.h` does
not include: it is never compiled beforehand.

\param points a range of points
\param np as those of `detect_planes()`, of which those for points and normals count
*/
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class PointRange,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
double estimate_noise(const PointRange& points, const NamedParameters& np = NamedParameters())
{
  return internal::on_backend<ConcurrencyTag>(points, np, [&](auto& backend, const auto& traits) {
    const internal::Import in = internal::read_range(backend, points, np, traits);
    return internal::measure_cloud(backend, in).noise;
  });
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_ESTIMATE_NOISE_H
