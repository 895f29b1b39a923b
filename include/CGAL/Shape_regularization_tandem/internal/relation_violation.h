// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checks of planes, groups and their relations, from the tables of the shapes alone. Each function returns the first
// violation, or an empty text. Later ones rely on earlier ones.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RELATION_VIOLATION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RELATION_VIOLATION_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Tandem/check_parameters.h>
#include <CGAL/Tandem/internal/regularity/given_directions.h>
#include <CGAL/Tandem/internal/regularity/orthogonal_pairs.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// A name with its index, for messages.
inline std::string numbered(const char* what, std::size_t index) { return std::string(what) + " " + to_text(index); }

inline std::string text_of(const std::pair<int, int>& groups)
{
  return to_text(groups.first) + " and " + to_text(groups.second);
}

// Unit normals up to rounding, and finite offsets.
inline std::string plane_violation(const Shapes_data& data)
{
  for(std::size_t s = 0; s < data.coefficients.size(); ++s) {
    const Coefficients& c = data.coefficients[s];
    const double length = std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    if(!(std::fabs(length - 1) <= 1e-15) || !std::isfinite(c[3]))
      return numbered("no unit normal in shape", s) + ": length - 1 is " + to_text(length - 1);
  }
  return {};
}

// Compares bits, not values: 0 and -0 differ.
inline bool have_same_bits(const Coefficients& a, const Coefficients& b, std::size_t coefficients)
{
  return std::memcmp(a.data(), b.data(), coefficients * sizeof(double)) == 0;
}

// Exact relations: the planes of a group have the same bits, as doubles and in the kernel. Groups are numbered without
// gaps, in the order in which the shapes have them first.
template <class Shapes>
std::string group_violation(const Shapes& shapes)
{
  const Shapes_data& data = shapes.data();
  const std::vector<int> direction = representatives(data.parallel_group);
  const std::vector<int> plane = representatives(data.coplanar_group);
  for(const std::vector<int>* first : {&direction, &plane})
    for(std::size_t g = 0; g < first->size(); ++g)
      if((*first)[g] < 0)
        return numbered("no shape in group", g);
  for(std::size_t s = 0; s < data.coefficients.size(); ++s) {
    const std::size_t r = std::size_t(direction[data.parallel_group[s]]);
    const std::size_t p = std::size_t(plane[data.coplanar_group[s]]);
    if(!have_same_bits(data.coefficients[s], data.coefficients[r], 3) ||
       shapes.plane(s).orthogonal_vector() != shapes.plane(r).orthogonal_vector())
      return numbered("not exactly parallel are shape", s) + numbered(" and", r);
    if(!have_same_bits(data.coefficients[s], data.coefficients[p], 4) || shapes.plane(s) != shapes.plane(p) ||
       data.parallel_group[s] != data.parallel_group[p])
      return numbered("not exactly coplanar are shape", s) + numbered(" and", p);
  }
  if(!std::is_sorted(direction.begin(), direction.end()) || !std::is_sorted(plane.begin(), plane.end()))
    return "the groups are not numbered in the order of their shapes";
  return {};
}

// Exact relations: the dot product of each orthogonal pair of groups, in plain double arithmetic. Pairs are sorted, and
// name groups that exist.
inline std::string orthogonality_violation(const Shapes_data& data)
{
  const std::vector<int> first = representatives(data.parallel_group);
  const auto& pairs = data.orthogonal_groups;
  for(std::size_t i = 0; i < pairs.size(); ++i) {
    const std::pair<int, int>& pair = pairs[i];
    if(pair.first < 0 || pair.first >= pair.second || std::size_t(pair.second) >= first.size())
      return "no such pair of orthogonal groups: " + text_of(pair);
    if(i > 0 && !(pairs[i - 1] < pair))
      return "listed twice, or not sorted, are the orthogonal groups " + text_of(pair);
    const Coefficients &a = data.coefficients[first[pair.first]], &b = data.coefficients[first[pair.second]];
    const double product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    if(!(std::fabs(product) <= 1e-15))
      return "not orthogonal are groups " + text_of(pair) + ": the dot product is " + to_text(product);
  }
  return {};
}

// Exact relations to what was given: the bits of a fixed direction, the cosine of the angle to the axis.
inline std::string given_direction_violation(const Shapes_data& data, const std::vector<Vector>& directions)
{
  const std::vector<int> fixed = fixed_directions_of(directions, data.parameters);
  const std::vector<int> symmetry = symmetry_groups(directions, data.parameters);
  if(data.fixed_direction.size() != fixed.size() || data.symmetry_group.size() != symmetry.size())
    return "the tables of the parallel groups differ in size";
  for(std::size_t g = 0; g < directions.size(); ++g) {
    if(data.fixed_direction[g] != fixed[g])
      return numbered("not exactly a fixed direction has group", g) + ": it is said to have " +
             to_text(data.fixed_direction[g]) + ", and has " + to_text(fixed[g]);
    if(data.symmetry_group[g] != symmetry[g])
      return numbered("not symmetric is group", g) + ": it is said to be in symmetry group " +
             to_text(data.symmetry_group[g]) + ", and is in " + to_text(symmetry[g]);
  }
  return {};
}

// All relations that the planes have, and no others, are in the result.
inline std::string listing_violation(const Shapes_data& data)
{
  const std::vector<Vector> directions = group_directions(data.parallel_group, data.coefficients);
  const auto& listed = data.orthogonal_groups;
  std::vector<std::pair<int, int>> difference;
  const auto found = orthogonal_pairs(directions, listed.size());
  std::set_difference(found.begin(), found.end(), listed.begin(), listed.end(), std::back_inserter(difference));
  if(!difference.empty())
    return "not listed are the orthogonal groups " + text_of(difference[0]);
  std::set_difference(listed.begin(), listed.end(), found.begin(), found.end(), std::back_inserter(difference));
  if(!difference.empty())
    return "not orthogonal are groups " + text_of(difference[0]);
  return given_direction_violation(data, directions);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RELATION_VIOLATION_H
