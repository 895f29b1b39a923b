// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The relations of the shapes, and what the regularity step reads and writes.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_RELATIONS_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_RELATIONS_H

#include <CGAL/Tandem/internal/regularity/relations.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// What the regularity step reads of a shape, on the host.
struct Shape_summary {
  std::uint64_t id;                     // wide, so that all bytes are defined where summaries are copied
  std::int64_t points, examined_points; // now, and when it was examined for layers
  Shape_fit fit;
};

// What it writes.
struct Regular_shape {
  Regular_plane plane;
  std::int64_t examined_points;
  std::int64_t plane_number;
};

// The relations of some shapes: those of shape id[i] are the entries i. The ids are valid until the next pass of
// growth, which may renumber the shapes.
struct Shape_relations {
  std::vector<std::uint32_t> id;
  Relations relations;
};

// Afterwards the entry has a plane, and a direction, that no other one has. The former ones stay for the others.
inline void set_own_plane(Relations& r, std::size_t entry, const Regular_plane& plane)
{
  r.direction_of[entry] = int(r.directions.size());
  r.plane_of[entry] = int(r.planes.size());
  r.directions.push_back(plane.normal);
  r.planes.push_back(plane);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_RELATIONS_H
