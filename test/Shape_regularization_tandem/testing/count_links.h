// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The links of the score, counted in a neighbor graph.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_COUNT_LINKS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_COUNT_LINKS_H

#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/score/Score.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

#include <cstdint>

namespace CGAL::Tandem::internal {

// The neighbors of surfel i that have another shape, or one where it has none, for each of its points.
inline void count_links(const Cloud_view& cloud, std::uint32_t i, const std::uint32_t* label, Score_counts& counts)
{
  const std::uint32_t* row = cloud.row(i);
  for(int j = 0; j < cloud.k && row[j] != no_index; ++j)
    if(label[row[j]] != label[i])
      (label[i] == free_label || label[row[j]] == free_label ? counts.free_links : counts.links) +=
        cloud.surfels.points(i).size();
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_COUNT_LINKS_H
