// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of the CUDA back end share.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CUDA_SUPPORT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CUDA_SUPPORT_H

#include "border_clouds.h"

#include <CGAL/Shape_regularization_tandem/Planar_shape_detection_3.h>
#include <CGAL/Shape_regularization_tandem/cuda.h>

using CGAL::Tandem::Cuda_tag;

// Suites that need a device are skipped without one.
inline boost::test_tools::assertion_result has_device(boost::unit_test::test_unit_id = 0)
{
  const bool has_device = CGAL::Tandem::cuda_available();
  if(!has_device)
    skip(CGAL::Tandem::cuda_device_report());
  return has_device;
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CUDA_SUPPORT_H
