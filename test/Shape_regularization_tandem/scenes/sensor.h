// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A model as one sensor sees it from one place: a frame, whose points lie on the grid of the sensor, with noise along
// the rays. A label is a piece of a face that is connected on that grid, since shadows of other things divide faces.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SENSOR_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SENSOR_H

#include "scenes.h"

namespace CGAL::Tandem::scenes {

enum class Sensor_kind {
  scanner, // turns about the z axis; rows are elevations. Noise grows with the distance
  camera,  // of depth; looks along the z axis. Noise grows with the square of the distance
  aerial,  // looks down along -z from a rectangle in the xy plane, at a random place of each square. Constant noise
  lidar,   // turns as a scanner; few rows, which are far apart, as beams are. Constant noise
  profiler // looks down from a rectangle, at the middle of each square; rows are profiles. Constant noise
};

struct Sensor {
  Sensor_kind kind;
  Frame pose;
  unsigned columns, rows;
  double width, height; // radians of azimuth and elevation; tangents of both sides of the image; lengths
  double lowest = 0;    // elevation of the first row of a scanner
  double noise = 0;     // sigma at a distance of three units; constant noise: everywhere
  std::uint64_t seed = 1;
};

// Without normals; `ideal` has the points without noise, and each face its plane.
Scene scan(const Model& model, const Sensor& sensor);

} // namespace CGAL::Tandem::scenes

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SENSOR_H
