// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checks the guarantees of a result from the outputs alone, with its own arithmetic and its own connected components.
// Changes nothing. The guarantees are those of the manual, "Guarantees".

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RESULT_CHECKER_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RESULT_CHECKER_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/internal/base/angles.h>
#include <CGAL/Tandem/internal/base/listed_parameters.h>
#include <CGAL/Tandem/internal/cloud/choose_grid.h>
#include <CGAL/Tandem/internal/cloud/far_points.h>
#include <CGAL/Tandem/internal/engine/first_unconnected.h>
#include <CGAL/Tandem/internal/regularity/Great_circle_index.h>
#include <CGAL/Tandem/internal/regularity/given_directions.h>
#include <CGAL/Tandem/internal/result/Shapes_data.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- Checks of planes, groups and their relations, from the tables of the shapes alone. Each function throws the first
// violation. Later ones rely on earlier ones.

[[noreturn]] inline void refuse(const std::string& violation) { throw std::invalid_argument(violation); }

// A name with its index, for messages.
inline std::string numbered(const char* what, std::size_t index) { return std::string(what) + " " + to_text(index); }

inline std::string text_of(const std::pair<int, int>& groups)
{
  return to_text(groups.first) + " and " + to_text(groups.second);
}

// Unit normals up to rounding, and finite offsets.
inline void check_planes(const Shapes_data& data)
{
  for(std::size_t s = 0; s < data.coefficients.size(); ++s) {
    const Coefficients& c = data.coefficients[s];
    const double length = std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    if(!(std::fabs(length - 1) <= 1e-15) || !std::isfinite(c[3]))
      refuse(numbered("no unit normal in shape", s) + ": length - 1 is " + to_text(length - 1));
  }
}

// Compares bits, not values: 0 and -0 differ.
inline bool have_same_bits(const Coefficients& a, const Coefficients& b, std::size_t coefficients)
{
  return std::memcmp(a.data(), b.data(), coefficients * sizeof(double)) == 0;
}

// Exact relations: the planes of a group have the same bits, as doubles and in the kernel. Groups are numbered without
// gaps, in the order in which the shapes have them first.
template <class Shapes>
void check_groups(const Shapes& shapes)
{
  const Shapes_data& data = shapes.data();
  const std::vector<int> direction = representatives(data.parallel_group);
  const std::vector<int> plane = representatives(data.coplanar_group);
  for(const std::vector<int>* first : {&direction, &plane})
    for(std::size_t g = 0; g < first->size(); ++g)
      if((*first)[g] < 0)
        refuse(numbered("no shape in group", g));
  for(std::size_t s = 0; s < data.coefficients.size(); ++s) {
    const std::size_t r = std::size_t(direction[data.parallel_group[s]]);
    const std::size_t p = std::size_t(plane[data.coplanar_group[s]]);
    if(!have_same_bits(data.coefficients[s], data.coefficients[r], 3) ||
       shapes.plane(s).orthogonal_vector() != shapes.plane(r).orthogonal_vector())
      refuse(numbered("not exactly parallel are shape", s) + numbered(" and", r));
    if(!have_same_bits(data.coefficients[s], data.coefficients[p], 4) || shapes.plane(s) != shapes.plane(p) ||
       data.parallel_group[s] != data.parallel_group[p])
      refuse(numbered("not exactly coplanar are shape", s) + numbered(" and", p));
  }
  if(!std::is_sorted(direction.begin(), direction.end()) || !std::is_sorted(plane.begin(), plane.end()))
    refuse("the groups are not numbered in the order of their shapes");
}

// Exact relations: the dot product of each orthogonal pair of groups, in plain double arithmetic. Pairs are sorted, and
// name groups that exist.
inline void check_orthogonality(const Shapes_data& data)
{
  const std::vector<int> first = representatives(data.parallel_group);
  const auto& pairs = data.orthogonal_groups;
  for(std::size_t i = 0; i < pairs.size(); ++i) {
    const std::pair<int, int>& pair = pairs[i];
    if(pair.first < 0 || pair.first >= pair.second || std::size_t(pair.second) >= first.size())
      refuse("no such pair of orthogonal groups: " + text_of(pair));
    if(i > 0 && !(pairs[i - 1] < pair))
      refuse("listed twice, or not sorted, are the orthogonal groups " + text_of(pair));
    const Coefficients &a = data.coefficients[first[pair.first]], &b = data.coefficients[first[pair.second]];
    const double product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    if(!(std::fabs(product) <= 1e-15))
      refuse("not orthogonal are groups " + text_of(pair) + ": the dot product is " + to_text(product));
  }
}

// Exact relations to what was given: the bits of a fixed direction, the cosine of the angle to the axis.
inline void check_given_directions(const Shapes_data& data, const std::vector<Vector>& directions)
{
  const std::vector<int> fixed = fixed_directions_of(directions, data.parameters);
  const std::vector<int> symmetry = symmetry_groups(directions, data.parameters);
  if(data.fixed_direction.size() != fixed.size() || data.symmetry_group.size() != symmetry.size())
    refuse("the tables of the parallel groups differ in size");
  for(std::size_t g = 0; g < directions.size(); ++g) {
    if(data.fixed_direction[g] != fixed[g])
      refuse(numbered("not exactly a fixed direction has group", g) + ": it is said to have " +
             to_text(data.fixed_direction[g]) + ", and has " + to_text(fixed[g]));
    if(data.symmetry_group[g] != symmetry[g])
      refuse(numbered("not symmetric is group", g) + ": it is said to be in symmetry group " +
             to_text(data.symmetry_group[g]) + ", and is in " + to_text(symmetry[g]));
  }
}

// All relations that the planes have, and no others, are in the result.
inline void check_listing(const Shapes_data& data)
{
  const std::vector<Vector> directions = group_directions(data.parallel_group, data.coefficients);
  const auto& listed = data.orthogonal_groups;
  std::vector<std::pair<int, int>> difference;
  const auto found = orthogonal_pairs(directions, listed.size());
  std::set_difference(found.begin(), found.end(), listed.begin(), listed.end(), std::back_inserter(difference));
  if(!difference.empty())
    refuse("not listed are the orthogonal groups " + text_of(difference[0]));
  std::set_difference(listed.begin(), listed.end(), found.begin(), found.end(), std::back_inserter(difference));
  if(!difference.empty())
    refuse("not orthogonal are groups " + text_of(difference[0]));
  check_given_directions(data, directions);
}

// --- What all processes have of a result, as one number.

// Of all but what is said of single points.
inline std::uint64_t common_hash(const Shapes_data& data)
{
  std::vector<double> numbers;
  const auto add = [&](const auto& list) {
    numbers.push_back(double(list.size()));
    numbers.insert(numbers.end(), list.begin(), list.end());
  };
  for(const Coefficients& c : data.coefficients)
    add(c);
  add(data.size);
  add(data.parallel_group);
  add(data.coplanar_group);
  add(data.is_flipped);
  for(const Plane_uncertainty& u : data.uncertainty) {
    add(u.centroid);
    add(u.normal_covariance);
    add(std::array<double, 3>{u.noise, u.offset_deviation, u.angle_deg});
  }
  add(data.fixed_direction);
  add(data.symmetry_group);
  for(const auto& pair : data.orthogonal_groups)
    add(std::array<int, 2>{pair.first, pair.second});
  for(const auto& parameter : listed(data.parameters))
    numbers.push_back(parameter.second);
  const Statistics& t = data.statistics;
  add(std::array<double, 7>{double(t.number_of_rounds), double(t.is_cancelled), t.score.fit, t.score.links,
                            t.score.size, t.score.price, t.score.freedom});
  const auto* bytes = reinterpret_cast<const char*>(numbers.data());
  return std::hash<std::string_view>()(std::string_view(bytes, numbers.size() * sizeof(double)));
}

// A number of the statistics, and what it should be.
struct Statistic {
  const char* name;
  double found, expected, margin;
};

inline std::string first_violation(std::initializer_list<Statistic> numbers)
{
  for(const auto& [name, found, expected, margin] : numbers)
    if(!(std::fabs(found - expected) <= margin))
      return "the statistics are wrong: " + std::string(name) + " is " + to_text(found) + " instead of " +
             to_text(expected);
  return {};
}

// Exact: a double has all numbers of points. One that is too large for it is wrong in any case.
inline Statistic count_of(const char* name, std::size_t found, std::size_t expected)
{
  return {name, double(found), double(expected), 0};
}

// Memory and time are those of a neighbor search, and of a few passes over the points.
template <class GeomTraits>
class Result_checker {
public:
  using Shapes = Planar_shapes_3<GeomTraits>;

  // The grid of the points is chosen here.
  Result_checker(Import& in, const Shapes& shapes) : in_(in), shapes_(shapes), data_(shapes.data()) {}

  // Throws the first violation, which stops all ranks: later checks rely on earlier ones. Parameters are those of a
  // detection, and indices are valid, before anything is computed with them.
  template <class Backend>
  void check(Backend& backend)
  {
    const Ranks<Backend> ranks(backend);
    // There is a detection with these parameters, and a grid for the points.
    Tandem::check_parameters(data_.parameters);
    check_same(ranks);
    drop_far_points(ranks, in_, data_.parameters.maximum_distance);
    choose_grid(in_, data_.parameters);
    check_tables();
    check_labels();
    check_lists();
    check_planes(data_);
    check_groups(shapes_);
    check_orthogonality(data_);
    check_points();
    check_sums(ranks);
    check_connectivity(backend);
    check_listing(data_);
    check_statistics();
  }

private:
  // Corrupted tables may have any number.
  static bool is_index(int i, std::size_t size) { return i >= 0 && std::size_t(i) < size; }

  // Sizes of the tables, and that groups of shapes exist: the indices of all later checks.
  void check_tables()
  {
    const std::size_t n = data_.coefficients.size();
    if(data_.size.size() != n || data_.parallel_group.size() != n || data_.coplanar_group.size() != n ||
       data_.is_flipped.size() != n || data_.uncertainty.size() != n)
      refuse("the tables of the shapes differ in size");
    if(data_.shape_of.size() != in_.number_of_items)
      refuse("there are " + to_text(data_.shape_of.size()) + " shape indices for " + to_text(in_.number_of_items) +
             " points");
    const std::size_t normals = in_.has_normals ? 0 : in_.number_of_items;
    if(data_.normal.size() != normals)
      refuse("there are " + to_text(data_.normal.size()) + " estimated normals instead of " + to_text(normals));
    for(std::size_t s = 0; s < n; ++s)
      if(!is_index(data_.parallel_group[s], n) || !is_index(data_.coplanar_group[s], n))
        refuse(numbered("no group for shape", s));
  }

  // Partition: each point has a shape of the result or none. Points that were left out have none.
  void check_labels()
  {
    for(std::size_t i = 0; i < data_.shape_of.size(); ++i)
      if(data_.shape_of[i] != -1 && !is_index(data_.shape_of[i], data_.coefficients.size()))
        refuse(numbered("the shape index is out of range at point", i) + ": " + to_text(data_.shape_of[i]));
    std::vector<char> is_known(in_.number_of_items, 0);
    for(std::size_t i = 0; i < in_.size(); ++i)
      is_known[in_.item_of(i)] = 1;
    for(std::size_t i = 0; i < is_known.size(); ++i)
      if(!is_known[i] && (data_.shape_of[i] >= 0 || (!in_.has_normals && data_.normal[i] != no_normal)))
        refuse(numbered("a shape or a normal has the invalid point", i));
  }

  // The points of each shape, ascending, are those of its index.
  void check_lists()
  {
    const std::vector<std::size_t>& first = shapes_.point_groups().first;
    const auto& position = shapes_.point_groups().position;
    std::size_t assigned = 0;
    for(std::int32_t s : data_.shape_of)
      assigned += s >= 0;
    if(first.size() != data_.coefficients.size() + 1 || first[0] != 0 || first.back() != position.size() ||
       position.size() != assigned || !std::is_sorted(first.begin(), first.end()))
      refuse("the lists of the points of the shapes have other sizes than the shapes");
    for(std::size_t s = 0; s + 1 < first.size(); ++s)
      for(std::size_t i = first[s]; i < first[s + 1]; ++i)
        if(position[i] >= data_.shape_of.size() || data_.shape_of[position[i]] != std::int32_t(s) ||
           (i > first[s] && position[i - 1] >= position[i]))
          refuse(numbered("other points than those of its index are listed for shape", s));
  }

  // Fidelity: distance and angle of each point of a shape, on the caller's values. The added terms bound the rounding
  // of this evaluation.
  void check_points()
  {
    constexpr double packing = 2e-4; // the method decides on packed normals, which are turned a little
    const double cosine = cosine_deg(data_.parameters.maximum_angle);
    opposed_.assign(2 * data_.coefficients.size(), 0);
    distances_ = {0, 0};
    for(std::size_t i = 0; i < in_.size(); ++i) {
      const std::size_t item = in_.item_of(i);
      if(data_.shape_of[item] < 0)
        continue;
      const std::size_t s = std::size_t(data_.shape_of[item]);
      const Coefficients& c = data_.coefficients[s];
      const Vector p = in_.position(i);
      const double x = c[0] * p.x, y = c[1] * p.y, z = c[2] * p.z;
      const double distance = std::fabs(x + y + z + c[3]);
      const double largest = (std::max)({std::fabs(x), std::fabs(y), std::fabs(z), std::fabs(c[3])});
      const double epsilon = data_.parameters.maximum_distance;
      const double tolerance = in_.has_tolerances ? (std::min)(in_.tolerances[i], epsilon) : epsilon;
      if(!(distance <= tolerance + 8 * 2.3e-16 * largest))
        refuse(numbered("too far from its plane is point", item) + ": " + to_text(distance) + " from the plane of " +
               numbered("shape", s));
      const Vector n = in_.has_normals ? in_.normal(i) : unpacked_normal(data_.normal[item]);
      const double aligned = c[0] * n.x + c[1] * n.y + c[2] * n.z;
      // With a maximum_angle of nearly 90 degrees, a normal within the plane must still fail.
      if(!(std::fabs(aligned) >= cosine * std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z) - 1e-14) || aligned == 0)
        refuse(numbered("too oblique is the normal of point", item) + ": the cosine is " + to_text(std::fabs(aligned)) +
               " with that of " + numbered("shape", s));
      ++distances_[0];
      distances_[1] += std::uint64_t(std::llround(distance / epsilon * distance_units));
      opposed_[2 * s] += aligned < -packing;
      opposed_[2 * s + 1] += aligned < packing;
    }
  }

  // All processes have the same shapes, up to the points. What follows is then the same on all of them.
  template <class Ranks>
  void check_same(const Ranks& ranks)
  {
    const std::uint64_t own = common_hash(data_);
    const std::vector<std::uint64_t> all = ranks.gather(std::vector<std::uint64_t>{own});
    if(std::count(all.begin(), all.end(), own) != std::ptrdiff_t(all.size()))
      refuse("the processes have different shapes or parameters");
  }

  // What is summed over the points of all ranks.
  template <class Ranks>
  void check_sums(const Ranks& ranks)
  {
    const std::size_t n = data_.coefficients.size();
    std::vector<std::uint64_t> size;
    for(std::size_t s = 0; s < n; ++s)
      size.push_back(shapes_.points(s).size());
    size = ranks.total(std::move(size));
    opposed_ = ranks.total(std::move(opposed_));
    check_sizes(size);
    check_orientations(size);
    distances_ = ranks.total(std::move(distances_));
  }

  // Those that follow from points and labels. A selection keeps the mean distance of the shapes that it is of.
  void check_statistics() const
  {
    const Statistics& t = data_.statistics;
    const auto& total = in_.total;
    const double assigned = double(distances_[0]), items = double(total.items);
    const double mean = assigned > 0 ? double(distances_[1]) / distance_units / assigned : 0;
    const bool is_mean_of_others = t.free_points.unselected > 0;
    const std::string violation = first_violation(
      {count_of("number_of_points", t.number_of_points, total.items),
       count_of("number_of_ignored_coordinates", t.number_of_ignored_coordinates, total.ignored_coordinates),
       count_of("number_of_ignored_normals", t.number_of_ignored_normals, total.ignored_normals),
       count_of("number_of_ignored_tolerances", t.number_of_ignored_tolerances, total.ignored_tolerances),
       count_of("number_of_far_points", t.number_of_far_points, total.far_points),
       count_of("number_of_assigned_points", t.number_of_assigned_points, distances_[0]),
       count_of("the sum of free_points", t.free_points.total(), total.points - distances_[0]),
       count_of("number_of_shapes", t.number_of_shapes, data_.coefficients.size()),
       {"coverage", t.coverage, total.items > 0 ? assigned / items : 0, 0},
       {"mean_distance", t.mean_distance, mean * data_.parameters.maximum_distance,
        is_mean_of_others ? data_.parameters.maximum_distance : in_.grid.step}});
    if(!violation.empty())
      refuse(violation);
  }

  // Size: the number of points, and no shape is below the minimum.
  void check_sizes(const std::vector<std::uint64_t>& size)
  {
    for(std::size_t s = 0; s < size.size(); ++s) {
      if(size[s] != data_.size[s])
        refuse(numbered("the size is wrong of shape", s) + ": " + to_text(data_.size[s]) + " instead of " +
               to_text(size[s]) + " points");
      if(size[s] < data_.parameters.minimum_region_size)
        refuse(numbered("too small is shape", s) + ": " + to_text(size[s]) + " points");
    }
  }

  // Whether most normals are opposite. Estimated normals are not oriented.
  void check_orientations(const std::vector<std::uint64_t>& size)
  {
    for(std::size_t s = 0; s < size.size(); ++s) {
      const char is_flipped = data_.is_flipped[s];
      const bool may_be = in_.has_normals && 2 * opposed_[2 * s + 1] > size[s];
      const bool must_be = in_.has_normals && 2 * opposed_[2 * s] > size[s];
      if(!(is_flipped == 0 && !must_be) && !(is_flipped == 1 && may_be))
        refuse(numbered("wrongly flipped or not is shape", s));
    }
  }

  // Connectivity: the surfels of each shape are one component. Two surfels are adjacent if one is a neighbor of the
  // other, or both are neighbors of one surfel.
  template <class Backend>
  void check_connectivity(Backend& backend)
  {
    Labeled_points points = {data_.parameters, data_.coefficients, {}, {}};
    for(std::size_t i = 0; i < in_.size(); ++i) {
      points.shape.push_back(data_.shape_of[in_.item_of(i)]);
      if(!in_.has_normals)
        points.normal.push_back(data_.normal[in_.item_of(i)]);
    }
    const std::size_t s = first_unconnected(backend, in_, points);
    if(s != points.shapes())
      refuse(numbered("not connected is shape", s));
  }

  // The points as they were imported, and the result in two forms: planes of the kernel, and plain tables.
  Import& in_;
  const Shapes& shapes_;
  const Shapes_data& data_;
  std::vector<std::uint64_t> opposed_;   // of each shape: the normals that are surely, and those that may be opposite
  std::vector<std::uint64_t> distances_; // of points of shapes: how many, and their sum in units

  static constexpr double distance_units = 1 << 15; // in epsilon
};

// The first violation, or an empty text.
template <class Backend, class GeomTraits>
std::string violation_of_promises(Backend& backend, Import& in, const Planar_shapes_3<GeomTraits>& shapes)
{
  try {
    Ranks<Backend>(backend).together([&] { Result_checker<GeomTraits>(in, shapes).check(backend); });
  } catch(const std::invalid_argument& violation) {
    return violation.what();
  } catch(const std::range_error& no_grid) {
    return no_grid.what();
  }
  return {};
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RESULT_CHECKER_H
