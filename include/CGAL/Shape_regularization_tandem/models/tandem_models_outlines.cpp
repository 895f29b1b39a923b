// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A part of the library Tandem::tandem_models, which is compiled with CGAL_TANDEM_USE_MODELS.

#include <CGAL/Shape_regularization_tandem/models/facts/facts_table.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/line_table.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/outline_table.h>
