// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which shapes are one, and which are two layers. See Share.h.

#ifndef CGAL_TANDEM_INTERNAL_BASE_TUNING_MERGING_H
#define CGAL_TANDEM_INTERNAL_BASE_TUNING_MERGING_H

#include <CGAL/Tandem/internal/base/tuning/Share.h>

#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace tuning {

namespace merging {

// Fewest neighbor relations between two shapes that touch. More: thin contacts are missed.
constexpr std::uint32_t minimum_edges = 2;

} // namespace merging

// Shapes that turn out to be two layers.
namespace layers {

// The histogram of distances: how far it reaches on either side of the plane, in epsilons, and bins of an epsilon.
constexpr int reach = 2;
constexpr int bins_per_distance = 16;
constexpr int bins = 2 * reach * bins_per_distance;
// A Gaussian of sigma = epsilon / 6, at the distance of 0, 1, 2 ... bins, in thousandths. Wider: it hides the gap
// between layers of noise that are 1.1 epsilon apart.
struct Kernel {
  static constexpr int size = 8;
  std::int64_t weight[size];
};
constexpr Kernel kernel = {{1000, 932, 755, 531, 325, 172, 80, 32}};
// A peak counts when it is so much higher than the middle.
constexpr Share peak_height = {3, 2};
// Shapes with fewer points are not examined: their normals are too uncertain.
constexpr std::int64_t reliable_normal_size = 30;
// A shape is suspicious when its points' normals lean to one side of its plane by more than about 4 degrees (sine), or
// their distances are spread (rms, in epsilons).
constexpr double suspicious_lean = 0.07;
constexpr double suspicious_rms = 0.45;
// It bridges layers for certain when they lean by more than about 6 degrees. The normals of fewer points than this, at
// edges, may lean by themselves.
constexpr double certain_lean = 0.1;
constexpr std::int64_t minimum_size = 100;
// Of a shape with twice as many points or more only the normals of a sample are summed, of this to twice as many.
constexpr std::int64_t sample_size = 512;
// A shape is examined again when it has this share of its former points.
constexpr Share examined_growth = {11, 10};

} // namespace layers

} // namespace tuning
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BASE_TUNING_MERGING_H
