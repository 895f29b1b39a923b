// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The criteria as named columns: one list for the tables of every program.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_COLUMNS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_COLUMNS_H

#include "evaluate_curves.h"
#include "evaluate_spread.h"
#include "evaluate_truth.h"

#include <iomanip>
#include <sstream>

namespace CGAL {
namespace Tandem {
namespace benchmark {

// (column, value) in the order of the columns. Names are words joined by "_"; an empty value is not known.
using Row = std::vector<std::pair<std::string, std::string>>;

template <class T>
void append_cell(Row& row, const std::string& name, const T& value)
{
  std::ostringstream text;
  text << std::boolalpha << std::setprecision(6) << value;
  row.emplace_back(name, text.str());
}

// What says nothing where there is nothing, and would look perfect, is empty there.
template <class T>
void append_cell_if(Row& row, bool is_known, const std::string& name, const T& value)
{
  if(is_known)
    append_cell(row, name, value);
  else
    row.emplace_back(name, "");
}

inline void append_relation_counts(Row& row, const std::string& kind, const Relation_counts& counts)
{
  append_cell(row, "directions_" + kind, counts.directions);
  append_cell(row, "planes_" + kind, counts.planes);
  append_cell(row, "degrees_of_freedom_" + kind, counts.degrees_of_freedom);
  append_cell_if(row, counts.planes > 0, "complexity_" + kind, counts.complexity);
}

inline void append_criteria(Row& row, const Criteria& c)
{
  append_cell(row, "assigned", c.assigned);
  append_cell(row, "shapes", c.shapes);
  append_cell(row, "smallest_shape", c.smallest_shape);
  append_cell(row, "coverage", c.coverage());
  append_cell_if(row, c.assigned > 0, "mean_distance", c.mean_distance);
  append_cell_if(row, c.assigned > 0, "mean_distance_in_epsilons", c.mean_distance_in_epsilons);
  append_cell_if(row, c.assigned > 0, "max_distance", c.max_distance);
  append_cell_if(row, c.assigned > 0, "max_distance_in_epsilons", c.max_distance_in_epsilons);
  append_cell(row, "beyond_epsilon", c.beyond_epsilon);
  append_cell(row, "beyond_alpha", c.beyond_alpha);
  append_cell(row, "beyond_either", c.beyond_either);
  append_cell_if(row, c.assigned > 0, "mean_normal_angle_deg", c.mean_normal_angle_deg);
  append_cell(row, "normals_not_unit", c.not_unit);
  append_relation_counts(row, "exact", c.exact);
  append_relation_counts(row, "relaxed", c.relaxed);
}

inline void append_size_curve(Row& row, const std::string& kind, const Size_curve& curve)
{
  for(std::size_t n : {10, 30, 100})
    append_cell(row, "top_" + std::to_string(n) + "_" + kind, curve.top(n));
  append_cell(row, "area_100_" + kind, curve.area(100));
}

inline void append_curves(Row& row, const Curves& curves)
{
  append_size_curve(row, "shapes", curves.shapes);
  append_size_curve(row, "planes", curves.planes);
  append_cell(row, "distinct_planes", curves.planes.size());
  append_cell(row, "clean_coverage", curves.shapes.top(curves.shapes.size()));
  for(const Needed_shapes& needed : curves.needed) {
    const std::string percent = std::to_string(int(100 * needed.coverage + .5));
    append_cell_if(row, needed.shapes > 0, "shapes_for_" + percent, needed.shapes);
    append_cell_if(row, needed.shapes > 0, "degrees_of_freedom_for_" + percent, needed.degrees_of_freedom);
  }
}

inline void append_face_score(Row& row, const std::string& kind, const Face_score& score)
{
  append_cell(row, "face_precision_" + kind, score.precision);
  append_cell(row, "face_recall_" + kind, score.recall);
  append_cell(row, "face_f1_" + kind, score.f1);
}

inline void append_pair_score(Row& row, const std::string& relation, const Relation_score& score,
                              Pair_score Relation_score::*pairs, const std::string& kind)
{
  append_cell_if(row, (score.*pairs).true_pairs > 0, relation + "_kept_" + kind, (score.*pairs).share());
  append_cell_if(row, score.pairs > 0, relation + "_false_" + kind, (score.*pairs).false_pairs);
}

inline void append_relations(Row& row, const std::string& relation, const Truth_criteria& t,
                             Pair_score Relation_score::*pairs)
{
  append_cell(row, relation + "_true_pairs", (t.exact.*pairs).true_pairs);
  append_pair_score(row, relation, t.exact, pairs, "exact");
  append_pair_score(row, relation, t.relaxed, pairs, "relaxed");
}

inline void append_truth(Row& row, const Truth_criteria& t)
{
  append_cell(row, "true_faces", t.faces);
  append_cell(row, "point_precision", t.point_precision);
  append_cell(row, "point_recall", t.point_recall);
  append_cell(row, "points_on_no_face", t.false_points);
  append_face_score(row, "50", t.at_50);
  append_face_score(row, "75", t.at_75);
  append_cell_if(row, t.shapes_per_face > 0, "shapes_per_face", t.shapes_per_face);
  append_cell_if(row, t.shapes_per_face > 0, "split_faces", t.split_faces);
  append_cell_if(row, t.shapes_per_face > 0, "swallowed_faces", t.swallowed_faces);
  append_cell_if(row, t.at_50.shapes_found > 0, "angle_error_deg", t.angle_error_deg);
  append_relations(row, "parallel", t, &Relation_score::parallel);
  append_relations(row, "orthogonal", t, &Relation_score::orthogonal);
  append_relations(row, "coplanar", t, &Relation_score::coplanar);
}

// The columns of a truth that is not known, so that all rows have the same.
inline void append_no_truth(Row& row)
{
  Row columns;
  append_truth(columns, Truth_criteria());
  for(auto& cell : columns)
    row.emplace_back(cell.first, "");
}

inline void append_spread(Row& row, const Spread& spread)
{
  append_cell(row, "same_result", spread.is_same);
  append_cell(row, "points_relabeled", spread.relabeled);
  append_cell(row, "shapes_least", spread.fewest_shapes);
  append_cell(row, "shapes_most", spread.maximum_shapes);
  append_cell(row, "coverage_least", spread.minimum_coverage);
  append_cell(row, "coverage_most", spread.maximum_coverage);
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_COLUMNS_H
