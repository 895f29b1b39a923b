// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the rounds work on. Each step takes the parts that it reads and writes.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_TANDEM_STATE_H
#define CGAL_TANDEM_INTERNAL_ENGINE_TANDEM_STATE_H

#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/Seeds.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>

namespace CGAL {
namespace Tandem {
namespace internal {

template <class Backend>
struct Tandem_state {
  explicit Tandem_state(Backend& backend) : points(backend) {}

  Options options;
  Labeled_cloud<Backend> points;
  Seeds<Backend> seeds;
  Shape_table<Backend> shapes;
  int round = 0;
  std::size_t peak_bytes = 0; // of the tables of the size of the cloud
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ENGINE_TANDEM_STATE_H
