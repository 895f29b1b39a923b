// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rounding mode of public functions.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_ROUND_TO_NEAREST_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_ROUND_TO_NEAREST_H

#include <CGAL/FPU.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// While one exists, this thread rounds to the nearest double, on which equal bits depend. Then the caller's rounding
// mode is set again. Threads of the back ends take over the mode of this one.
class Round_to_nearest {
public:
  Round_to_nearest() : protect_(CGAL_FE_TONEAREST) {}

private:
  Protect_FPU_rounding<true> protect_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_ROUND_TO_NEAREST_H
