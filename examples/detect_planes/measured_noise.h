// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_MEASURED_NOISE_H
#define DETECT_PLANES_MEASURED_NOISE_H

#include "input/point_set.h"

namespace program {

// That from which the maximum distance is estimated where it is not given; 0 if there are no points.
double measured_noise(const Point_set& points);

} // namespace program

#endif // DETECT_PLANES_MEASURED_NOISE_H
