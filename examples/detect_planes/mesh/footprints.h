// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The polygons of a GeoJSON file, with coordinates of the cloud.

#ifndef DETECT_PLANES_FOOTPRINTS_H
#define DETECT_PLANES_FOOTPRINTS_H

#include "input/point_set.h"

#include <CGAL/Polygon_with_holes_2.h>

#include <string>
#include <vector>

namespace program {

using Footprints = std::vector<CGAL::Polygon_with_holes_2<Kernel>>;

Footprints read_footprints(const std::string& path);

} // namespace program

#endif // DETECT_PLANES_FOOTPRINTS_H
