// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_ESTIMATE_PARAMETERS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_ESTIMATE_PARAMETERS_H

#include <CGAL/Shape_regularization_tandem/internal/method.h>
#include <CGAL/Shape_regularization_tandem/internal/range_maps.h>
#include <CGAL/Shape_regularization_tandem/internal/resolve_parameters.h>
#include <CGAL/Tandem/internal/base/listed_parameters.h>
#include <CGAL/Tandem/internal/cloud/import_cloud.h>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief estimates the parameters of a detection from the points.

- `maximum_distance` follows the spacing of the points, between two multiples of their noise. It is between 1e-270 and
  1e270, as it has to be.
- `maximum_offset` is `maximum_distance`.
- `minimum_region_size` grows with the square root of the number of points.

The manual has the numbers, and how noise and spacing are measured: \ref Tandem_parameters_estimated.

Copies of a point count once. Points far from all others do not count where they are at most a hundredth at each end of
each axis. Where given normals have sides, the two sides of a thin wall count each by itself. The estimate is computed
on the host, whatever the tag.

Points with coordinates that are not finite, and points whose given normal is null or not finite, do not count. The
estimate does not depend on the order of the points. All lengths are in the units of the points.

\param points a range of points
\param np as those of `detect_planes()`. Parameters that are given are kept, and checked.
\param estimate where it is not null, gets what is to be said of an estimated `maximum_distance`

\throw Parameter_error a parameter is outside of its range
\throw std::length_error more than 2^31 points (of one process)
\throw std::range_error `maximum_distance` is not given, and more than one point in twenty is beyond 2^24 times 1e270
*/
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class PointRange,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
Parameters estimate_parameters(const PointRange& points, const NamedParameters& np = NamedParameters(),
                               Distance_estimate* estimate = nullptr)
{
  return internal::on_backend<ConcurrencyTag>(points, np, [&](auto& backend, const auto& traits) {
    Parameters p = internal::read_parameters(np);
    internal::check_given_parameters(p);
    internal::check_same_parameters(internal::Ranks(backend), p);
    const internal::Import in = internal::read_range(backend, points, np, traits);
    const Distance_estimate said = internal::complete_parameters(backend, in, internal::has_own_offset(np), p);
    if(estimate != nullptr)
      *estimate = said;
    return p;
  });
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_ESTIMATE_PARAMETERS_H
