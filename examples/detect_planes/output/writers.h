// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What writes the larger outputs.

#ifndef DETECT_PLANES_WRITERS_H
#define DETECT_PLANES_WRITERS_H

#include "input/input_settings.h"
#include "output/Described_shapes.h"
#include "output/report.h"
#include "output/write_results.h"

#include <iosfwd>
#include <optional>
#include <ostream>
#include <string>

namespace program {

struct Cloud_format {
  std::string extension;
  std::string colors;                 // of the points: input, shape, or empty for what the format is used for
  std::string label_property;         // the name of the shape of a point
  std::optional<Las_frame> las_frame; // of the input
};

// The cloud with the shape of each point: the part of the points that belongs to the file.
void write_cloud(std::ostream& out, const Point_set& points, const Point_part& part, const Shapes& shapes,
                 const Cloud_format& format);

enum class Faces_of_file { polygons, triangles };

struct Polygon_format {
  std::string extension;
  Faces_of_file faces;
  std::string crs; // the name of the coordinate reference system, for GeoJSON; empty: not written
};

// The polygons of the shapes: binary PLY with the shape of each face, OBJ with a group for each shape, OFF with the color
// of the shape, or GeoJSON with a feature for each shape. A vertex that several shapes have is in PLY, OBJ and OFF once.
// Their faces have no holes: polygons with holes are triangles there.
void write_polygons(std::ostream& out, const Described_shapes& shapes, const Polygon_format& format);

// The page that shows a result in three dimensions: one file, which a browser opens from the disk. three.js and the page
// around the data are parts of the program.
void write_view(std::ostream& out, const Described_shapes& shapes, const Run& run);

} // namespace program

#endif // DETECT_PLANES_WRITERS_H
