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

namespace end_game {

// Share of the minimum size that a shape needs to last until relations are final: it may still get points. Larger:
// faces near the minimum size are lost under noise. Smaller: strips beside faces that a relation has turned last, too.
constexpr Share lasting_size = {2, 3};
// ... and points that it needs, whatever the minimum size: fewer determine no plane.
constexpr std::int64_t minimum_lasting_size = 3;

} // namespace end_game

} // namespace tuning
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BASE_TUNING_FINISH_H
