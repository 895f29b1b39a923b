// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Generated twins of real clouds, one for each kind of sensor, with ground truth:
// a model, and what the sensor does to it. The same bits on every machine.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_TWINS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_TWINS_H

#include "scenes.h"

namespace CGAL::Tandem::scenes {

// Errors along the ray from the nearest scanner grow with a power of the range.
struct Sensor_errors {
  double range_noise = 0;  // sigma, at the range 1
  int range_power = 0;     // how it grows
  double depth_step = 0;   // depths are multiples of this, at the range 1; it grows with the square
  double registration = 0; // sigma of the offset of all that a scanner sees
  double roughness = 0;    // largest smooth displacement, as image matching makes them ...
  double wavelength = 1;   // ... and its length
};

struct Twin {
  std::string name;
  Model (*model)();
  Sensor_errors sensor;
  double outliers;
  bool varies_density;
  double epsilon, alpha_deg;
  double gap;           // within a shape of 500,000 points in all, for methods that ask for it
  double minimum_share; // smallest shape, as a share of the points

  std::size_t minimum(std::size_t points) const { return std::size_t((std::max)(20., minimum_share * double(points))); }
};

const std::vector<Twin>& twins();

const Twin& twin(const std::string& name);

// Without normals, as such clouds come; `ideal` has the points before the sensor.
Scene make_twin(const Twin& twin, std::size_t points, std::uint64_t seed = 1);

} // namespace CGAL::Tandem::scenes

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_TWINS_H
