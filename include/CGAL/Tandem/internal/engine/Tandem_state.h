// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the rounds change. Only prepare() takes all of it; the other stages take the parts that they read and write, so
// that their signatures show what they may change.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_TANDEM_STATE_H
#define CGAL_TANDEM_INTERNAL_ENGINE_TANDEM_STATE_H

#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/Seeds.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Options are constant after prepare(), but for the seeds in flight. Between rounds, labels are ids of live shapes, or
// the point is free. Moments are those of the points with that label.
template <class Backend>
struct Tandem_state {
  explicit Tandem_state(Backend& backend) : points(backend) {}

  Options options;
  Labeled_cloud<Backend> points;
  Seeds<Backend> seeds;
  Shape_table<Backend> shapes;
  int round = 0;              // rounds that are complete
  std::size_t peak_bytes = 0; // of the tables of the size of the cloud
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ENGINE_TANDEM_STATE_H
