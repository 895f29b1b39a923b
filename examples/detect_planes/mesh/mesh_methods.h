// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The methods that make a closed surface of planes. It is empty if they enclose nothing; other failures are exceptions.

#ifndef DETECT_PLANES_MESH_METHODS_H
#define DETECT_PLANES_MESH_METHODS_H

#include "mesh/mesh_input.h"

#include <stdexcept>
#include <string>

namespace program {

// What this program was built without; empty if it has the method.
std::string missing_for_polygonal_mesh();
std::string missing_for_kinetic_mesh();

// The polygonal method ends after some seconds: GLPK does, SCIP cannot.
bool has_time_limit();

// Fewer planes may do.
struct Too_many_faces : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// By CGAL::Polygonal_surface_reconstruction. It chooses from all faces that the planes cut each other into: time and
// memory grow with the cube of the number of planes. The solver has `seconds` of processor time.
Surface polygonal_mesh(const Mesh_input& input, int seconds);

// By CGAL::Kinetic_space_partition_3: the boundary of the volumes that are inside.
Surface kinetic_mesh(const Mesh_input& input);

} // namespace program

#endif // DETECT_PLANES_MESH_METHODS_H
