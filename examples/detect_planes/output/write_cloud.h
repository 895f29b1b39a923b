// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cloud with the shape of each point, in the formats of --output.

#ifndef DETECT_PLANES_WRITE_CLOUD_H
#define DETECT_PLANES_WRITE_CLOUD_H

#include "input/input_settings.h"
#include "output/write_results.h"

#include <optional>
#include <ostream>
#include <string>

namespace program {

struct Cloud_format {
  std::string extension;
  std::string colors;                 // of the points: input, shape, or empty for what the format is used for
  std::optional<Las_frame> las_frame; // of the input
};

// The part of the points that belongs to the file.
void write_cloud(std::ostream& out, const Point_set& points, const Point_part& part, const Shapes& shapes,
                 const Cloud_format& format);

} // namespace program

#endif // DETECT_PLANES_WRITE_CLOUD_H
