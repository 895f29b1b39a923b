// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_DISTANCE_OF_NOISE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_DISTANCE_OF_NOISE_H

#include <CGAL/Tandem/internal/base/tuning/cloud.h>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

returns the tolerance for points of a known noise: the multiple of it that `estimate_parameters()` takes for
`maximum_distance`.

It is in the header `CGAL/Shape_regularization_tandem/distance_of_noise.h`, which `CGAL/Shape_regularization_tandem.h` does not include.

\param noise the standard deviation of the distances of points to their plane
*/
inline double distance_of_noise(double noise) { return internal::tuning::estimation::distance_per_noise * noise; }

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_DISTANCE_OF_NOISE_H
