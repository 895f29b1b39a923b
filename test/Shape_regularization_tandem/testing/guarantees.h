// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A second check of the guarantees of the manual, but for connectivity. It shares nothing with is_valid_result(): it sees
// the caller's points and the public interface of a result, computes with 113 bits, and has no tolerance.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_GUARANTEES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_GUARANTEES_H

#include "test_support.h"

#include <cfloat>
#include <map>
#include <set>

namespace guarantees {

// The product of two doubles is exact.
#if LDBL_MANT_DIG >= 113
using Real = long double;
#else
using Real = __float128;
#endif

using Vector = std::array<Real, 3>;

inline Real dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Vector cross(const Vector& a, const Vector& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class Geometry>
Vector to_vector(const Geometry& g)
{
  return {Real(g.x()), Real(g.y()), Real(g.z())};
}

// The Taylor series, for 0 to 90 degrees.
inline Real cosine(double degrees)
{
  const Real pi = Real(0x1.921fb54442d18p+1) + Real(0x1.1a62633145c07p-53) + Real(-0x1.f1976b7ed8fbcp-109);
  const Real x = Real(degrees) * pi / 180;
  Real sum = 0, term = 1;
  for(int i = 1; i <= 60; i += 2) {
    sum += term;
    term *= -x * x / (i * (i + 1));
  }
  return sum;
}

template <class Geometry>
bool has_finite_values(const Geometry& g)
{
  return std::isfinite(g.x()) && std::isfinite(g.y()) && std::isfinite(g.z());
}

// Collects all violations. Each begins with the name of the guarantee in the manual.
class Checker {
public:
  Checker(const Cloud& cloud, Given given, const Shapes& shapes) : cloud_(cloud), given_(given), shapes_(shapes)
  {
    check_points();
    check_planes();
    check_orthogonality();
    check_given_directions();
  }

  const std::vector<std::string>& violations() const { return violations_; }

private:
  bool is_usable(std::size_t i) const
  {
    const bool has_normal =
      given_ == Given::nothing || (has_finite_values(cloud_[i].second) && cloud_[i].second != CGAL::NULL_VECTOR);
    return has_normal && has_finite_values(cloud_[i].first);
  }

  // Of a shape that exists; otherwise -1, so that all else can be checked in corrupted results as well.
  int shape_of(std::size_t i) const
  {
    const int s = shapes_.shape_index(i);
    return s >= 0 && std::size_t(s) < shapes_.number_of_shapes() ? s : -1;
  }

  Vector normal_of(std::size_t s) const
  {
    const auto& c = shapes_.coefficients(s);
    return {Real(c[0]), Real(c[1]), Real(c[2])};
  }

  // `index` is that of a point, a shape or a group.
  void expect(bool is_true, const char* what, std::size_t index)
  {
    if(!is_true)
      violations_.push_back(what + (" " + std::to_string(index)));
  }

  // Each point has a shape or none, and shapes list their points in the order of the caller.
  void check_points()
  {
    const CGAL::Tandem::Statistics& t = shapes_.statistics();
    const Real least_cosine = cosine(shapes_.parameters().maximum_angle);
    std::vector<std::size_t> size(shapes_.number_of_shapes(), 0);
    std::size_t usable = 0, assigned = 0, coordinates = 0;
    for(std::size_t i = 0; i < cloud_.size(); ++i) {
      const int s = shapes_.shape_index(i);
      const bool is_good = is_usable(i);
      usable += is_good;
      coordinates += !has_finite_values(cloud_[i].first);
      assigned += s >= 0;
      expect(s == -1 || shape_of(i) == s, "partition: no shape of this index has point", i);
      expect(s == -1 || is_good, "bad data: a shape has point", i);
      if(shape_of(i) < 0)
        continue;
      const auto points = shapes_.points(std::size_t(s));
      expect(size[s] < points.size() && points[size[s]] == i, "partition: not in the list of its shape is point", i);
      ++size[s];
      check_fidelity(i, least_cosine);
    }
    for(std::size_t s = 0; s < size.size(); ++s) {
      expect(size[s] == shapes_.points(s).size(), "partition: other points are in the list of shape", s);
      expect(size[s] >= shapes_.parameters().minimum_region_size, "size: too small is shape", s);
    }
    const std::size_t far = t.number_of_far_points;
    expect(shapes_.number_of_points() == cloud_.size(), "partition: number of points", shapes_.number_of_points());
    expect(t.number_of_points == cloud_.size(), "statistics: points", t.number_of_points);
    expect(t.number_of_assigned_points == assigned, "statistics: assigned points", t.number_of_assigned_points);
    expect(20 * far <= usable, "statistics: far points", far);
    expect(t.free_points.total() + far + assigned == usable, "statistics: free points", t.free_points.total());
    expect(t.number_of_shapes == size.size(), "statistics: shapes", t.number_of_shapes);
    expect(t.number_of_ignored_coordinates == coordinates, "bad data: points that are not finite",
           t.number_of_ignored_coordinates);
    expect(t.number_of_ignored_points() - far == cloud_.size() - usable, "bad data: ignored points",
           t.number_of_ignored_points());
  }

  // Distances and angles are compared by their squares.
  void check_fidelity(std::size_t i, Real least_cosine)
  {
    const std::size_t s = std::size_t(shape_of(i));
    const Vector normal = normal_of(s);
    const Vector of_point =
      to_vector(given_ == Given::normals ? cloud_[i].second : Kernel::Vector_3(shapes_.estimated_normal(i)));
    const Real squared_length = dot(normal, normal), epsilon = Real(shapes_.parameters().maximum_distance);
    const Real distance = dot(normal, to_vector(cloud_[i].first)) + Real(shapes_.coefficients(s)[3]);
    expect(distance * distance <= epsilon * epsilon * squared_length, "fidelity: too far from its plane is point", i);
    const Real aligned = dot(normal, of_point);
    const Real least = least_cosine * least_cosine * squared_length * dot(of_point, of_point);
    expect(aligned * aligned >= least && least > 0, "fidelity: too oblique is the normal of point", i);
  }

  bool has_same_bits(std::size_t s, std::size_t t, std::size_t coefficients) const
  {
    return std::memcmp(&shapes_.coefficients(s), &shapes_.coefficients(t), coefficients * sizeof(double)) == 0;
  }

  // Unit normals as far as doubles go. The shapes of a group are compared with its first one.
  void check_planes()
  {
    std::map<std::size_t, std::size_t> direction, plane;
    for(std::size_t s = 0; s < shapes_.number_of_shapes(); ++s) {
      const Real excess = dot(normal_of(s), normal_of(s)) - 1;
      expect(excess < Real(2e-15) && -excess < Real(2e-15), "exact relations: no unit normal has shape", s);
      const auto& c = shapes_.coefficients(s);
      const auto& plane_3 = shapes_.plane(s);
      expect(plane_3.a() == c[0] && plane_3.b() == c[1] && plane_3.c() == c[2] && plane_3.d() == c[3],
             "exact relations: another plane in the kernel has shape", s);
      const std::size_t r = direction.emplace(shapes_.parallel_group(s), s).first->second;
      const std::size_t p = plane.emplace(shapes_.coplanar_group(s), s).first->second;
      expect(has_same_bits(s, r, 3), "exact relations: not parallel to its group is shape", s);
      expect(has_same_bits(s, p, 4) && shapes_.are_parallel(s, p),
             "exact relations: not coplanar with its group is shape", s);
    }
    const auto is_last = [](const std::map<std::size_t, std::size_t>& groups, std::size_t number) {
      return groups.size() == number && (number == 0 || groups.rbegin()->first == number - 1);
    };
    expect(is_last(direction, shapes_.number_of_parallel_groups()), "exact relations: parallel groups, not",
           direction.size());
    expect(is_last(plane, shapes_.number_of_coplanar_groups()), "exact relations: coplanar groups, not", plane.size());
  }

  void check_orthogonality()
  {
    const auto& pairs = shapes_.orthogonal_groups();
    for(std::size_t i = 1; i < pairs.size(); ++i)
      expect(pairs[i - 1] < pairs[i], "exact relations: not sorted is the orthogonal pair", i);
    std::set<std::pair<std::size_t, std::size_t>> found;
    for(std::size_t s = 0; s < shapes_.number_of_shapes(); ++s)
      for(std::size_t t = 0; t < shapes_.number_of_shapes(); ++t)
        if(shapes_.parallel_group(s) < shapes_.parallel_group(t) && shapes_.are_orthogonal(s, t)) {
          found.emplace(shapes_.parallel_group(s), shapes_.parallel_group(t));
          const Real product = dot(normal_of(s), normal_of(t));
          expect(product <= Real(1e-15) && -product <= Real(1e-15), "exact relations: not orthogonal to all is shape",
                 s);
        }
    expect(found.size() == pairs.size(), "exact relations: orthogonal groups of shapes are", found.size());
  }

  // Those of a fixed direction are parallel to it, as far as doubles go. Those of a symmetry group are compared with its
  // first one.
  void check_given_directions()
  {
    const Parameters& p = shapes_.parameters();
    const Vector axis = {p.symmetry_direction[0], p.symmetry_direction[1], p.symmetry_direction[2]};
    std::map<int, Real> cosines;
    for(std::size_t s = 0; s < shapes_.number_of_shapes(); ++s) {
      const Vector n = normal_of(s);
      const int fixed = shapes_.fixed_direction(shapes_.parallel_group(s));
      if(fixed >= 0) {
        const auto& given = p.fixed_directions[std::size_t(fixed)];
        const Vector d = {given[0], given[1], given[2]}, c = cross(n, d);
        expect(dot(c, c) <= Real(1e-31) * dot(d, d), "exact relations: not parallel to its direction is shape", s);
      }
      const int symmetry = shapes_.symmetry_group(shapes_.parallel_group(s));
      if(symmetry < 0)
        continue;
      const Real cosine = dot(n, axis) < 0 ? -dot(n, axis) : dot(n, axis);
      const Real excess = cosine - cosines.emplace(symmetry, cosine).first->second;
      expect(excess * excess <= Real(1e-30) * dot(axis, axis), "exact relations: not symmetric to its group is shape",
             s);
    }
  }

  const Cloud& cloud_;
  Given given_;
  const Shapes& shapes_;
  std::vector<std::string> violations_;
};

} // namespace guarantees

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_GUARANTEES_H
