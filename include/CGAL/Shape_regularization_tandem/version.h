// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_VERSION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_VERSION_H

/// \ingroup PkgShapeRegularizationTandemRef
/// the version of this package; CMake reads it from here
#define CGAL_TANDEM_VERSION "0.3.0"

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_VERSION_H
