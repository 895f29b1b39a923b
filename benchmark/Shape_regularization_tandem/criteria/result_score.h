// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The score of labels and planes, whichever detector they are of: by the function that the statistics of a detection
// come from, with the neighbor graph of the engine. Points that violate the tolerances count as free. Relations hold
// within 1e-6, as peers have no exact ones.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RESULT_SCORE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RESULT_SCORE_H

#include "table.h"

#include <CGAL/Tandem/Statistics.h>

namespace CGAL::Tandem::benchmark {

constexpr std::uint32_t no_neighbor = 0xffffffffu;

// The k nearest neighbors of each point, one row after the other; no_neighbor ends shorter rows.
struct Neighbor_graph {
  std::size_t k = 0;
  std::vector<std::uint32_t> neighbor;
};

// As the engine finds them, on its grid for this distance.
Neighbor_graph neighbor_graph(const std::vector<Vec>& points, std::size_t k, double maximum_distance);

// What is scored, and by which parameters.
struct Scored_cloud {
  const std::vector<Vec>& points;
  const std::vector<Vec>& normals; // empty: no point is beyond alpha
  const Neighbor_graph& graph;
  Tolerances tolerances;
  std::size_t minimum_region_size;
};

Result_score evaluate_score(const Scored_cloud& cloud, const Detection& detection);

inline void append_score(Row& row, const Result_score& score, std::size_t points)
{
  append_cell(row, "score_fit", score.fit);
  append_cell(row, "score_links", score.links);
  append_cell(row, "score_size", score.size);
  append_cell(row, "score_price", score.price);
  append_cell(row, "score_freedom", score.freedom);
  append_cell(row, "score", score.total());
  append_cell_if(row, points > 0, "score_of_point", score.total() / double(points));
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RESULT_SCORE_H
