// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// After the loop. See Share.h.

#ifndef CGAL_TANDEM_INTERNAL_BASE_TUNING_FINISH_H
#define CGAL_TANDEM_INTERNAL_BASE_TUNING_FINISH_H

#include <CGAL/Tandem/internal/base/tuning/Share.h>

#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace tuning {

// After the loop: consolidation of fragments, label propagation, reassignment.
namespace end_game {

// Rounds of consolidation. It ends when this share of the shapes is left, and their points are less than this share of
// those before.
constexpr int consolidation_rounds = 2;
constexpr Share kept_shapes = {49, 50};
constexpr Share grown_points = {1001, 1000};
// Share of the minimum size that a shape needs to last until the reassignment: it may still get points. Larger: faces
// near the minimum size are lost under noise. Smaller: strips beside faces that a relation has turned last, too.
constexpr Share lasting_size = {2, 3};
// ... and points that it needs, whatever the minimum size: fewer determine no plane.
constexpr std::int64_t minimum_lasting_size = 3;
// Rounds of label propagation; it ends when at most one point of so many has got a label in a round.
constexpr std::size_t propagation_rounds = 16;
constexpr std::size_t points_per_late_point = 100000;
// Rounds of reassignment to the largest neighbor that fits. Shapes below this share of the minimum size lose no points.
constexpr int reassignment_rounds = 4;
constexpr Share safe_size = {3, 2};
// A point may go to a plane that is farther than the nearest one by one in so many epsilons, or is at most this far
// from that plane at the point, in epsilons. Otherwise both are layers there. Larger distances: layers are swallowed.
// Smaller: parts of a surface that bends keep points that its largest plane explains.
constexpr std::int64_t distance_per_farther_plane = 4;
constexpr Share layer_distance = {9, 10};

} // namespace end_game

// Large planes take what they explain of smaller shapes, in the loop and after it. Measured on aerial, indoor, street
// and image-matched scans and on scenes with known faces.
namespace transfer {

// A plane takes points of a smaller shape if it explains at least this share of it. Smaller: planes cut through noise,
// and faces are lost to it.
constexpr Share explained_share = {1, 5};
// A shape is fitted anew if its new plane explains more than this share of what the former one does. Without a margin,
// planes move for a few points.
constexpr Share better_plane = {501, 500};
// A shape whose centroid is farther from the plane, in epsilons, and whose variance across it is at most this multiple
// of that across its local plane, is a layer of its own, unless at least this share of it fits. A noisy layer at a
// distance of epsilon fits with half of its points. Larger distance, smaller share: layers are swallowed.
constexpr double layer_distance = 0.8;
constexpr double layer_variance = 2.25;
constexpr Share layer_share = {3, 5};
// Rounds, at most: one in each round of the loop after the first ones, more after the loop. A round that moves less
// than one point of so many of the cloud is the last one.
constexpr int maximum_rounds_in_loop = 1;
constexpr int maximum_rounds = 2;
constexpr std::size_t points_per_moved_point = 2000;

} // namespace transfer

// Planes through clutter. Measured: planes through outliers have .40 to .75 of the neighbors near them, faces .89 and
// more. Larger shares: true but noisy faces are dropped.
namespace clutter {

// Largest rms of a crisp shape, in epsilons: its points are no clutter to others.
constexpr double crisp_rms = 0.4;
// A shape is dropped with a smaller share of neighbors near its plane; or with fewer of its own and fewer near; or
// with a larger rms (in epsilons) and fewer near.
constexpr double near_share = .55;
constexpr double own_share = .4;
constexpr double near_share_if_few_own = .75;
constexpr double large_rms = .5;
constexpr double near_share_if_large_rms = .77;

} // namespace clutter

} // namespace tuning
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BASE_TUNING_FINISH_H
