// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "measured_noise.h"

#include <CGAL/Shape_regularization_tandem/internal/Round_to_nearest.h>
#include <CGAL/Shape_regularization_tandem/internal/range_maps.h>
#include <CGAL/Tandem/internal/cloud/import_cloud.h>
#include <CGAL/Tandem/internal/neighbors/measure_cloud.h>

namespace program {

double measured_noise(const Point_set& points)
{
  namespace internal = CGAL::Tandem::internal;
  const internal::Round_to_nearest rounding;
  const CGAL::parameters::Default_named_parameters np;
  return internal::with_traits<CGAL::Parallel_if_available_tag>(points, np, [&](const auto& traits) {
    auto backend = traits.backend();
    const internal::Import in = internal::read_points(backend, points, internal::reader_of(points, np, traits));
    return internal::measure_cloud(backend, in).noise;
  });
}

} // namespace program
