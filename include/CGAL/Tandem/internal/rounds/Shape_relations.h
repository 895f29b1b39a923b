// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The relations of the shapes, as they are kept from round to round.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_RELATIONS_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_RELATIONS_H

#include <CGAL/Tandem/internal/regularity/relations.h>
#include <CGAL/Tandem/internal/shapes/Tested_shape.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// What the regularity step reads of a shape, on the host.
struct Shape_summary {
  std::uint32_t id;
  int entry;                // in the relations of before
  std::uint64_t is_waiting; // after a rollback; wide, so that all bytes are defined where summaries are copied
  std::int64_t related_points, examined_points; // when its relations were found, and when it was examined for layers
  Shape_fit fit;
  Tested_shape tested;

  std::int64_t points() const { return tested.points; }
};

// What it writes.
struct Regular_shape {
  Regular_plane plane;
  std::int64_t related_points, examined_points; // when its relations were found, and when it was examined for layers
  Misfit_record last_misfits;
  int plane_number;
  bool is_rolled_back;
};

// The relations of some shapes: those of shape id[i] are the entries i. The ids are valid until the next pass of
// growth, which may renumber the shapes. Shape::entry stays valid after it.
struct Shape_relations {
  std::vector<std::uint32_t> id;
  Relations relations;
  std::int64_t points = 0; // of the shapes when the relations were found
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
