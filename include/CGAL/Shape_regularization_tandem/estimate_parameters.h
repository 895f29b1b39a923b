// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_ESTIMATE_PARAMETERS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_ESTIMATE_PARAMETERS_H

#include <CGAL/Shape_regularization_tandem/internal/method.h>
#include <CGAL/Shape_regularization_tandem/internal/range_maps.h>
#include <CGAL/Shape_regularization_tandem/internal/resolve_parameters.h>
#include <CGAL/Tandem/internal/base/listed_parameters.h>
#include <CGAL/Tandem/internal/base/tuning/cloud.h>
#include <CGAL/Tandem/internal/cloud/import_cloud.h>
#include <CGAL/Tandem/internal/engine/local_distances.h>
#include <CGAL/Tandem/internal/neighbors/measure_cloud.h>

#include <vector>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief estimates the parameters of a detection from the points.

- `maximum_distance` follows the spacing of the points, between multiples of their noise. It is between 1e-270 and 1e270,
  as it has to be.
- `maximum_offset` is `maximum_distance`.
- `minimum_region_size` grows with the square root of the number of points, up to a limit that follows from the spacing.

The manual has the numbers, and how noise and spacing are measured: \ref Tandem_parameters_estimated.

Copies of a point count once. Up to a hundredth of the points at each end of each axis do not count if they are far from
all others. Where given normals are oriented, each of the two sides of a thin wall counts by itself. The estimate is
always computed on the CPU.

Points with coordinates that are not finite, and points whose given normal is null or not finite, do not count. The
estimate does not depend on the order of the points. All lengths are in the units of the points.

\param points a range of points
\param np the named parameters of `detect_planes()`. Parameters that are given are kept, and checked.
\param estimate if it is not null, gets a note on the estimated `maximum_distance`

\return all parameters, given and estimated ones

\throw Parameter_error a parameter is outside of its range
\throw std::length_error more than 2^31 points in one process
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

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief measures the noise of points, from which `estimate_parameters()` estimates `maximum_distance`. For each
neighborhood that lies on a surface, it takes the root mean square distance of the points to a fitted plane; the noise
is a quantile of these values, or 0 if there is no surface. `distance_of_noise()` makes a `maximum_distance` of it. The
manual has the numbers: \ref Tandem_parameters_estimated.

\param points a range of points
\param np the named parameters of `detect_planes()`, of which those for points, normals and processes are read

\return the noise, in the units of the points
\throw std::length_error more than 2^31 points in one process
\throw std::logic_error MPI is not initialized (`Mpi_tag`)
\throw std::range_error the extent of the points is more than 2^24 times 1e270, about 1.7e277
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

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief estimates for each point the largest distance that it may have from the plane of its shape. Use it if the noise
varies over the cloud.

It is the `maximum_distance` that `estimate_parameters()` gives for all points, times the ratio of the noise around the
point to the noise of the cloud, and it is smooth along the surfaces: \ref Tandem_parameters_estimated. Pass the values
as `maximum_distance_map` if `estimate_parameters()` sets `Distance_estimate::noise_varies`. The estimate does not
depend on the order of the points. It is always computed on the CPU.

\param points a range of points
\param np the named parameters of `detect_planes()`, of which those for points, normals and processes are read

\return a value for each item of the range, in its order, in the units of the points; NaN for points that are ignored
\throw std::length_error more than 2^31 points in one process
\throw std::range_error the extent of the points is more than 2^24 times 1e270, about 1.7e277
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

/*!
\ingroup PkgShapeRegularizationTandemRef

returns the `maximum_distance` for points whose noise is known, in the unit of the noise: the noise times a constant,
which `estimate_parameters()` uses, too; its value is in \ref Tandem_parameters_estimated. No value is refused: 0 gives
0, NaN gives NaN.

\param noise the standard deviation of the signed distances of points to their plane
*/
inline double distance_of_noise(double noise) { return internal::tuning::estimation::distance_per_noise * noise; }

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_ESTIMATE_PARAMETERS_H
