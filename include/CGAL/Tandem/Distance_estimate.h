// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_DISTANCE_ESTIMATE_H
#define CGAL_TANDEM_DISTANCE_ESTIMATE_H

#include <string>

namespace CGAL {
namespace Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

What is to be said of a `maximum_distance` that `estimate_parameters()` estimated: \ref Tandem_parameters_estimated.
*/
struct Distance_estimate {
  /// where one distance for all points is a compromise, a sentence that says why; otherwise nothing
  std::string note;
  /// whether that is because the noise varies for certain. Then `estimate_local_distances()` fits better.
  bool noise_varies = false;
};

} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_DISTANCE_ESTIMATE_H
