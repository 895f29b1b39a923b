// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A result with other shapes of the same planes: some are left out, or several become one. Planes do not change.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RELABEL_SHAPES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RELABEL_SHAPES_H

#include <CGAL/Tandem/internal/result/export_shapes.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// The numbers of equal keys, in the order in which they come first.
template <class Key>
class Numbering {
public:
  int operator()(const Key& key) { return number_.emplace(key, int(number_.size())).first->second; }

private:
  std::map<Key, int> number_;
};

// What follows from sizes and relations. What was measured at points stays that of the detection: the mean distance,
// the reasons of its free points, and the score. Where no points were left out, only the fit and the links of the score
// were. Known planes have no score, and get none: that of shapes has a price.
inline void count_shapes_again(const Statistics& before, Shapes_data& data)
{
  Statistics& t = data.statistics;
  measure_relations(data, {});
  t.number_of_assigned_points = std::accumulate(data.size.begin(), data.size.end(), std::size_t(0));
  if(t.number_of_assigned_points < before.number_of_assigned_points || before.score.price == 0)
    t.score = before.score;
  t.score.fit = before.score.fit;
  t.score.links = before.score.links;
  t.free_points.unselected += before.number_of_assigned_points - t.number_of_assigned_points;
  t.coverage = t.number_of_points > 0 ? double(t.number_of_assigned_points) / double(t.number_of_points) : 0;
}

// Shape s of the result is shape source[s], with the points of all shapes t that have shape_of[t] == s. Points of
// shapes that have -1 there get none.
inline Shapes_data relabel_shapes(const Shapes_data& data, const std::vector<std::size_t>& source,
                                  const std::vector<int>& shape_of)
{
  Shapes_data result;
  Numbering<int> parallel, coplanar;
  for(std::size_t s : source) {
    result.coefficients.push_back(data.coefficients[s]);
    result.parallel_group.push_back(parallel(data.parallel_group[s]));
    result.coplanar_group.push_back(coplanar(data.coplanar_group[s]));
    result.is_flipped.push_back(data.is_flipped[s]);
    result.uncertainty.push_back(data.uncertainty[s]);
  }
  result.size.assign(source.size(), 0);
  for(std::size_t t = 0; t < shape_of.size(); ++t)
    if(shape_of[t] >= 0)
      result.size[std::size_t(shape_of[t])] += data.size[t];
  std::vector<std::int32_t> label(data.shape_of.begin(), data.shape_of.end());
  for(std::int32_t& l : label)
    l = l < 0 ? -1 : shape_of[std::size_t(l)];
  result.shape_of = std::move(label);
  result.normal = data.normal;
  result.parameters = data.parameters;
  result.statistics = data.statistics;
  relate_groups(result);
  count_shapes_again(data.statistics, result);
  return result;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RELABEL_SHAPES_H
