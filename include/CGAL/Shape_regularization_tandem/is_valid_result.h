// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_IS_VALID_RESULT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_IS_VALID_RESULT_H

#include <CGAL/Shape_regularization_tandem/internal/Result_checker.h>
#include <CGAL/Shape_regularization_tandem/internal/method.h>
#include <CGAL/Shape_regularization_tandem/internal/range_maps.h>
#include <CGAL/Tandem/internal/cloud/import_cloud.h>

namespace CGAL::Tandem {

namespace internal {

// What executes the check: many processes where there is a communicator.
template <class NP>
using Checking_tag = typename std::conditional<Is_given<internal_np::communicator_t, NP>::value, Mpi_tag<>,
                                               CGAL::Parallel_if_available_tag>::type;

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief checks a result against the points: returns whether all holds that `Planar_shapes_3` promises for a finished
detection.

Returns `true` only if each point is in at most one shape and within the tolerances of it, shapes are large enough and
connected, parameters are within their ranges, and relations are exactly those of the planes. The counts of points and
shapes of the statistics, the coverage, and the mean distance, up to `Statistics::grid_step`, have to be those of the
points; of a result of `select_shapes()`, the mean distance is that of all shapes, and not measured again.
Uncertainties and other statistics are not. The function cannot tell whether the same shapes were detected with other
parameters.

Every point is looked at, and the neighbors of all points are searched for anew, so this takes a good part of the time
of a detection. Distances and angles are evaluated in double. A point may exceed its tolerance only by the rounding of
that evaluation: 8 units in the last place of its largest term.

\param points the range that the shapes were detected in
\param shapes the shapes
\param np the named parameters of the detection, of which only `point_map`, `normal_map`, `maximum_distance_map`,
`geom_traits` and `communicator` are read. The maps have to be those of the detection. A result of `Mpi_tag` needs the
communicator, and all of its processes have to call the function.
\param why if it is not null, gets a sentence on the first violation: what, and of which point or shape

\throw std::invalid_argument processes have different maps (`Mpi_tag`)
\throw std::length_error more than 2^31 points in one process
\throw std::logic_error MPI is not initialized (`Mpi_tag`)
*/
template <class PointRange, class GeomTraits, class NamedParameters = CGAL::parameters::Default_named_parameters>
bool is_valid_result(const PointRange& points, const Planar_shapes_3<GeomTraits>& shapes,
                     const NamedParameters& np = NamedParameters(), std::string* why = nullptr)
{
  using Tag = internal::Checking_tag<NamedParameters>;
  return internal::on_backend<Tag>(points, np, [&](auto& backend, const auto& traits) {
    internal::Import in = internal::read_range(backend, points, np, traits);
    const std::string violation = internal::violation_of_promises(backend, in, shapes);
    if(why)
      *why = violation;
    return violation.empty();
  });
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_IS_VALID_RESULT_H
