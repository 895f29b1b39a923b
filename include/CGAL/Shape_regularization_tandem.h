// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_H

/*!
\file
The detector, and what a result offers without further libraries. Models made of a result are in
`CGAL/Shape_regularization_tandem_models.h`, processes of MPI in `CGAL/Shape_regularization_tandem/mpi.h`.
*/

#include <CGAL/Shape_regularization_tandem/Planar_shape_detection_3.h>
#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/Tandem_traits_3.h>
#include <CGAL/Shape_regularization_tandem/adapters.h>
#include <CGAL/Shape_regularization_tandem/cuda.h>
#include <CGAL/Shape_regularization_tandem/detect_planes.h>
#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>
#include <CGAL/Shape_regularization_tandem/is_valid_result.h>
#include <CGAL/Shape_regularization_tandem/join_coplanar_shapes.h>
#include <CGAL/Shape_regularization_tandem/label_points.h>
#include <CGAL/Shape_regularization_tandem/named_parameters.h>
#include <CGAL/Shape_regularization_tandem/regularize_planes.h>
#include <CGAL/Shape_regularization_tandem/select_shapes.h>
#include <CGAL/Shape_regularization_tandem/shapes_of_planes.h>
#include <CGAL/Shape_regularization_tandem/tags.h>
#include <CGAL/Shape_regularization_tandem/upward_direction.h>
#include <CGAL/Shape_regularization_tandem/version.h>
#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/Plane_relations.h>
#include <CGAL/Tandem/Statistics.h>

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_H
