// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the command line of detect_planes says.

#ifndef DETECT_PLANES_OPTIONS_H
#define DETECT_PLANES_OPTIONS_H

#include "tolerance/Noise_model.h"

#include <CGAL/Tandem/Coefficients.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace program {

// Bad usage: exit code 2. Every other exception is exit code 1. The library makes them alike on all processes.
using Usage_error = std::invalid_argument;

constexpr long long by_library = 0; // of estimate_normals: no PCA of a given number of neighbors

// Numbers of planes of --mesh: more take minutes, and those not even Ctrl-C ends soon.
constexpr long long fewest_mesh_planes = 4, mesh_planes_by_default = 200, most_mesh_planes = 1000;

// Of the planes that are selected by their normals.
struct Direction_choice {
  enum Of { direction, vertical, horizontal } of = direction;
  std::array<double, 3> normal = {0, 0, 0}; // of `direction`
  std::optional<double> degrees;            // between it and the normals
  std::string text;                         // of the command line
};

// What was not given is left to the library.
struct Options {
  std::vector<std::string> inputs;
  std::string output, output_directory, labels, planes, report, vg, polygons, shapes, mesh, view;
  std::string planes_from;                              // a file
  std::vector<CGAL::Tandem::Coefficients> known_planes; // of it
  std::string crs;                                      // of --polygons
  std::string columns, classes, format, crop;           // of the inputs
  std::string tolerance_column, noise_text;             // of the tolerance of each point
  std::optional<Noise_model> noise;
  std::string colors;                   // of the output: shape, input or empty
  std::string label_property = "shape"; // of the output
  std::optional<double> maximum_distance, maximum_angle, angle_tolerance, maximum_offset, simplicity, regularity,
    surfel_size;
  std::optional<long long> mesh_planes, minimum_region_size, k_neighbors, cell_size, threads, estimate_normals, sample;
  bool regularize_parallelism = true, regularize_orthogonality = true, regularize_coplanarity = true;
  std::vector<std::array<double, 3>> fixed_directions;
  std::optional<std::array<double, 3>> symmetry_direction, viewpoint;
  std::optional<long long> largest; // shapes that are selected
  std::optional<double> minimum_area, minimum_extent;
  std::optional<Direction_choice> near_direction;
  std::string backend = "auto";
  bool has_local_distances = false; // of --maximum-distance auto-local, or of auto where the noise varies
  double estimated_distance = 0;    // of auto
  std::string estimate_note;        // what is said of it
  bool ignores_zeros = false, has_decimal_commas = false;
  bool is_by_plane = false; // coplanar shapes are one
  bool has_group_for_each_plane = false, has_triangles_only = false, is_oriented = false, is_quiet = false;
  bool wants_help = false, wants_version = false;
};

} // namespace program

#endif // DETECT_PLANES_OPTIONS_H
