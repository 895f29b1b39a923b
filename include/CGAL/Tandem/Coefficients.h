// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_COEFFICIENTS_H
#define CGAL_TANDEM_COEFFICIENTS_H

#include <array>

namespace CGAL::Tandem {

/// \ingroup PkgShapeRegularizationTandemRef
/// the plane a x + b y + c z + d = 0 as the four numbers (a, b, c, d), in double for every kernel
using Coefficients = std::array<double, 4>;

namespace internal {

using Position = std::array<double, 3>; // the coordinates of a point

} // namespace internal

} // namespace CGAL::Tandem

#endif // CGAL_TANDEM_COEFFICIENTS_H
