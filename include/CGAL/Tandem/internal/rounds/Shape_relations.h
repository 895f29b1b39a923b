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
  std::uint64_t id; // wide, so that all bytes are defined where summaries are copied
  Shape_fit fit;
};

// What it writes.
struct Regular_shape {
  Regular_plane plane;
  std::int64_t plane_number;
};

// The relations of some shapes: those of shape id[i] are the entries i. The ids are valid until the next pass of
// growth, which may renumber the shapes.
struct Shape_relations {
  std::vector<std::uint32_t> id;
  Relations relations;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_RELATIONS_H
