// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of the CUDA back end share.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CUDA_SUPPORT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CUDA_SUPPORT_H

#include "test_support.h"

#include <CGAL/Shape_regularization_tandem/Planar_shape_detection_3.h>
#include <CGAL/Shape_regularization_tandem/cuda.h>

using CGAL::Tandem::Cuda_tag;

inline bool has_device()
{
  if(CGAL::Tandem::cuda_available())
    return true;
  skip(CGAL::Tandem::cuda_device_report());
  return false;
}

inline Cloud make_cloud(const std::string& scene, std::size_t points, double noise = .001, double outliers = .1)
{
  return to_cloud(scenes::make_scene(scene, scene_options(points, noise, outliers)));
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CUDA_SUPPORT_H
