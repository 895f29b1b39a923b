// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Comes before the sources of tests, examples and benchmark. Precompiled, it spares them the reading of CGAL.

#ifndef CGAL_TANDEM_PRECOMPILED_H
#define CGAL_TANDEM_PRECOMPILED_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Simple_cartesian.h>

#endif // CGAL_TANDEM_PRECOMPILED_H
