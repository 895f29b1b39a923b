// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checks the guarantees of a result from the outputs alone, with its own arithmetic and its own connected components.
// Changes nothing. The guarantees are those of the manual, "Guarantees".

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RESULT_CHECKER_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RESULT_CHECKER_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Tandem/internal/engine/first_unconnected.h>
#include <CGAL/Tandem/internal/finish/exact_check.h>
#include <CGAL/Tandem/internal/regularity/given_directions.h>

#include <cmath>
#include <string>

namespace CGAL {
namespace Tandem {
namespace internal {

// Memory and time are those of a neighbor search, and of a few passes over the points.
template <class GeomTraits>
class Result_checker {
public:
  using Shapes = Planar_shapes_3<GeomTraits>;

  Result_checker(const Import& in, const Shapes& shapes) : in_(in), shapes_(shapes), data_(shapes.data()) {}

  // Stops at the first check that fails, which sets violation(). Later checks rely on earlier ones: indices are valid
  // then.
  template <class Backend>
  bool check(Backend& backend)
  {
    const bool is_valid_here = check_tables() && check_labels() && check_planes() && check_groups() &&
                               check_orthogonality() && check_given_directions() && check_points();
    const Ranks<Backend> ranks(backend);
    return ranks.all(is_valid_here, violation_) && check_same(ranks) && check_statistics(ranks) && check_sizes(ranks) &&
           check_connectivity(backend);
  }

  const std::string& violation() const { return violation_; }

private:
  // Notes the violation; false, to be returned.
  bool fail(const std::string& what)
  {
    violation_ = what;
    return false;
  }

  // A name with its index, for messages.
  static std::string at(const char* what, std::size_t index) { return std::string(what) + " " + to_text(index); }

  // Corrupted tables may have any number.
  static bool is_index(int i, std::size_t size) { return i >= 0 && std::size_t(i) < size; }

  // Sizes of the tables, and that groups of shapes exist: the indices of all later checks.
  bool check_tables()
  {
    const std::size_t n = data_.coefficients.size();
    if(data_.size.size() != n || data_.parallel_group.size() != n || data_.coplanar_group.size() != n ||
       data_.is_flipped.size() != n)
      return fail("the tables of the shapes differ in size");
    if(data_.shape_of.size() != in_.number_of_items)
      return fail("there are " + to_text(data_.shape_of.size()) + " shape indices for " + to_text(in_.number_of_items) +
                  " points");
    if(!in_.has_normals && data_.normal.size() != in_.number_of_items)
      return fail("there are " + to_text(data_.normal.size()) + " normals for " + to_text(in_.number_of_items) +
                  " points");
    for(std::size_t s = 0; s < n; ++s)
      if(!is_index(data_.parallel_group[s], n) || !is_index(data_.coplanar_group[s], n))
        return fail(at("no group for shape", s));
    return true;
  }

  // Partition: each point has a shape of the result or none. Points without position or normal have none.
  bool check_labels()
  {
    for(std::size_t i = 0; i < data_.shape_of.size(); ++i)
      if(data_.shape_of[i] < -1 || data_.shape_of[i] >= std::int32_t(data_.coefficients.size()))
        return fail(at("the shape index is out of range at point", i) + ": " + to_text(data_.shape_of[i]));
    std::vector<char> is_known(in_.number_of_items, 0);
    for(std::size_t i = 0; i < in_.size(); ++i)
      is_known[in_.item_of(i)] = 1;
    for(std::size_t i = 0; i < is_known.size(); ++i)
      if(!is_known[i] && data_.shape_of[i] >= 0)
        return fail(at("a shape has the invalid point", i));
    return true;
  }

  // Unit normals up to rounding, and finite offsets: the distances below rely on both.
  bool check_planes()
  {
    for(std::size_t s = 0; s < data_.coefficients.size(); ++s) {
      const Coefficients& c = data_.coefficients[s];
      const double length = std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
      if(!(std::fabs(length - 1) <= 1e-15) || !std::isfinite(c[3]))
        return fail(at("no unit normal in shape", s) + ": length - 1 is " + to_text(length - 1));
    }
    return true;
  }

  // Exact relations: the planes of a group have the same bits, as doubles and in the kernel. Groups are numbered
  // without gaps.
  bool check_groups()
  {
    const std::vector<int> direction = representatives(data_.parallel_group);
    const std::vector<int> plane = representatives(data_.coplanar_group);
    for(const std::vector<int>* first : {&direction, &plane})
      for(std::size_t g = 0; g < first->size(); ++g)
        if((*first)[g] < 0)
          return fail(at("no shape in group", g));
    for(std::size_t s = 0; s < data_.coefficients.size(); ++s) {
      const std::size_t r = std::size_t(direction[data_.parallel_group[s]]);
      const std::size_t p = std::size_t(plane[data_.coplanar_group[s]]);
      if(!has_same_bits(s, r, 3) || shapes_.plane(s).orthogonal_vector() != shapes_.plane(r).orthogonal_vector())
        return fail(at("not exactly parallel are shape", s) + at(" and", r));
      if(!has_same_bits(s, p, 4) || shapes_.plane(s) != shapes_.plane(p) ||
         data_.parallel_group[s] != data_.parallel_group[p])
        return fail(at("not exactly coplanar are shape", s) + at(" and", p));
    }
    return true;
  }

  // Compares bits, not values: 0 and -0 differ.
  bool has_same_bits(std::size_t s, std::size_t t, int coefficients) const
  {
    return std::memcmp(data_.coefficients[s].data(), data_.coefficients[t].data(),
                       std::size_t(coefficients) * sizeof(double)) == 0;
  }

  // Exact relations: the dot product of each orthogonal pair of groups, in plain double arithmetic. Pairs are sorted
  // and name groups that exist.
  bool check_orthogonality()
  {
    const std::vector<int> first = representatives(data_.parallel_group);
    for(const auto& pair : data_.orthogonal_groups) {
      if(pair.first < 0 || pair.first >= pair.second || std::size_t(pair.second) >= first.size())
        return fail("no such pair of orthogonal groups: " + to_text(pair.first) + ", " + to_text(pair.second));
      const Coefficients &a = data_.coefficients[first[pair.first]], &b = data_.coefficients[first[pair.second]];
      const double product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
      if(!(std::fabs(product) <= 1e-15))
        return fail("not orthogonal are groups " + to_text(pair.first) + " and " + to_text(pair.second) +
                    ": the dot product is " + to_text(product));
    }
    if(!std::is_sorted(data_.orthogonal_groups.begin(), data_.orthogonal_groups.end()))
      return fail("the orthogonal groups are not sorted");
    return true;
  }

  // Exact relations to what was given: the bits of a fixed direction, the cosine of the angle to the axis.
  bool check_given_directions()
  {
    const std::vector<int> first = representatives(data_.parallel_group);
    if(data_.fixed_direction.size() != first.size() || data_.symmetry_group.size() != first.size())
      return fail("the tables of the parallel groups differ in size");
    std::vector<double> cosine(first.size(), -1); // by symmetry group
    for(std::size_t g = 0; g < first.size(); ++g) {
      const Coefficients& c = data_.coefficients[first[g]];
      const Vector n = {c[0], c[1], c[2]};
      const int fixed = data_.fixed_direction[g], symmetry = data_.symmetry_group[g];
      if(fixed < -1 || fixed >= int(data_.parameters.fixed_directions.size()) || symmetry < -1 ||
         symmetry >= int(first.size()))
        return fail(at("no such direction or symmetry of group", g));
      if(fixed >= 0 && !(canonical(n) == given_direction(data_.parameters.fixed_directions[fixed])))
        return fail(at("not exactly a fixed direction has group", g));
      if(symmetry < 0)
        continue;
      const double own = std::fabs(dot(n, symmetry_axis(data_.parameters)));
      if(cosine[symmetry] >= 0 && !(std::fabs(own - cosine[symmetry]) <= 1e-15))
        return fail(at("not symmetric is group", g));
      cosine[symmetry] = cosine[symmetry] < 0 ? own : cosine[symmetry];
    }
    return true;
  }

  // Fidelity: distance and angle of each point of a shape, on the caller's values. The added terms bound the rounding
  // of this evaluation.
  bool check_points()
  {
    const double cosine = std::cos(data_.parameters.maximum_angle * (3.14159265358979323846 / 180));
    for(std::size_t i = 0; i < in_.size(); ++i) {
      const std::size_t item = in_.item_of(i);
      if(data_.shape_of[item] < 0)
        continue;
      const Coefficients& c = data_.coefficients[data_.shape_of[item]];
      const Vector p = in_.position(i);
      const double x = c[0] * p.x, y = c[1] * p.y, z = c[2] * p.z;
      const double distance = std::fabs(x + y + z + c[3]);
      const double largest = (std::max)({std::fabs(x), std::fabs(y), std::fabs(z), std::fabs(c[3])});
      if(!(distance <= data_.parameters.maximum_distance + 8 * 2.3e-16 * largest))
        return fail(at("too far from its plane is point", item) + ": " + to_text(distance) + " from the plane of " +
                    at("shape", std::size_t(data_.shape_of[item])));
      const Vector n = in_.has_normals ? in_.normal(i) : unpacked_normal(data_.normal[item]);
      const double aligned = std::fabs(c[0] * n.x + c[1] * n.y + c[2] * n.z);
      // With a maximum_angle of nearly 90 degrees, a normal within the plane must still fail.
      if(!(aligned >= cosine * std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z) - 1e-14) || aligned == 0)
        return fail(at("too oblique is the normal of point", item) + ": the cosine is " + to_text(aligned) +
                    " with that of " + at("shape", std::size_t(data_.shape_of[item])));
    }
    return true;
  }

  // All processes have the same shapes, up to the points. What follows is then the same on all of them.
  template <class Ranks>
  bool check_same(const Ranks& ranks)
  {
    std::uint64_t h = 0;
    Shapes::add_to_hash(h, data_.coefficients);
    const auto add = [&](const auto& list) {
      Shapes::add_to_hash(h, list.size());
      for(const auto& x : list)
        Shapes::add_to_hash(h, std::uint64_t(x));
    };
    add(data_.size);
    add(data_.parallel_group);
    add(data_.coplanar_group);
    add(data_.is_flipped);
    add(data_.fixed_direction);
    add(data_.symmetry_group);
    for(const auto& pair : data_.orthogonal_groups)
      add(std::vector<int>{pair.first, pair.second});
    const Statistics& t = data_.statistics;
    add(std::vector<std::size_t>{t.number_of_points, t.number_of_assigned_points, t.number_of_ignored_coordinates,
                                 t.number_of_ignored_normals, t.number_of_shapes, t.number_of_directions,
                                 t.number_of_planes, t.number_of_orthogonal_pairs, data_.parameters.k_neighbors,
                                 data_.parameters.minimum_region_size});
    Shapes::add_to_hash(h, {{t.coverage, t.complexity, t.mean_distance, data_.parameters.maximum_distance}});
    return ranks.are_same(h) || fail("the processes have different shapes, statistics or parameters");
  }

  // Size: the number of points, and no shape is below the minimum.
  template <class Ranks>
  bool check_sizes(const Ranks& ranks)
  {
    std::vector<std::uint64_t> size;
    for(std::size_t s = 0; s < shapes_.number_of_shapes(); ++s)
      size.push_back(shapes_.points(s).size());
    ranks.sum(size.data(), size.size());
    for(std::size_t s = 0; s < size.size(); ++s) {
      if(size[s] != data_.size[s])
        return fail(at("the size is wrong of shape", s) + ": " + to_text(data_.size[s]) + " instead of " +
                    to_text(size[s]) + " points");
      if(size[s] < data_.parameters.minimum_region_size)
        return fail(at("too small is shape", s) + ": " + to_text(size[s]) + " points");
    }
    return true;
  }

  // Counts and ratios of the statistics, counted again from the tables.
  template <class Ranks>
  bool check_statistics(const Ranks& ranks)
  {
    const Statistics& t = data_.statistics;
    std::size_t assigned = 0;
    for(std::int32_t s : data_.shape_of)
      assigned += s >= 0;
    assigned = ranks.total(assigned);
    const bool has_counts = t.number_of_points == in_.total.items && t.number_of_assigned_points == assigned &&
                            t.number_of_ignored_coordinates == in_.total.ignored_coordinates &&
                            t.number_of_ignored_normals == in_.total.ignored_normals;
    if(!has_counts)
      return fail("the statistics count other points: " + to_text(t.number_of_assigned_points) + " instead of " +
                  to_text(assigned) + " assigned ones");
    const bool has_relations = t.number_of_shapes == data_.coefficients.size() &&
                               t.number_of_directions == representatives(data_.parallel_group).size() &&
                               t.number_of_planes == representatives(data_.coplanar_group).size() &&
                               t.number_of_orthogonal_pairs == data_.orthogonal_groups.size();
    if(!has_relations)
      return fail("the statistics count other shapes, directions, planes or orthogonal pairs");
    const double coverage = t.number_of_points > 0 ? double(assigned) / double(t.number_of_points) : 0;
    if(!(std::fabs(t.coverage - coverage) <= 1e-12))
      return fail("the coverage is " + to_text(t.coverage) + " instead of " + to_text(coverage));
    if(!(t.complexity >= 0 && t.complexity <= 1))
      return fail("the complexity is " + to_text(t.complexity) + ", not in [0, 1]");
    if(!(t.mean_distance >= 0 && t.mean_distance <= data_.parameters.maximum_distance * 1.000001))
      return fail("the mean distance is " + to_text(t.mean_distance));
    return true;
  }

  // Connectivity: each shape is one component. Two points are adjacent if one is a neighbor of the other, or both are
  // neighbors of one point.
  template <class Backend>
  bool check_connectivity(Backend& backend)
  {
    std::vector<std::int32_t> label;
    for(std::size_t i = 0; i < in_.size(); ++i)
      label.push_back(data_.shape_of[in_.item_of(i)]);
    const std::size_t k = data_.parameters.k_neighbors, shapes = data_.coefficients.size();
    const std::size_t s = first_unconnected(backend, in_, label, k, shapes);
    return s == shapes || fail(at("not connected is shape", s));
  }

  // The points as they were imported, and the result in two forms: planes of the kernel, and plain tables.
  const Import& in_;
  const Shapes& shapes_;
  const Shapes_data& data_;
  std::string violation_; // empty as long as every check has passed
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RESULT_CHECKER_H
