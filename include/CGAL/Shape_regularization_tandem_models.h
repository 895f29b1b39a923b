// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_H

/*!
\file
Models made of a result: outlines of shapes, lines at which they meet, closed surfaces, measures of shapes, and selections by them. They take
long to compile: link `Tandem::tandem_models`.
*/

#include <CGAL/Shape_regularization_tandem/closed_surface.h>
#include <CGAL/Shape_regularization_tandem/lines.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>
#include <CGAL/Shape_regularization_tandem/shape_facts.h>

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_H
