// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_PLANAR_SHAPES_3_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_PLANAR_SHAPES_3_H

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/result/Shapes_data.h>
#include <CGAL/Tandem/internal/result/group_points.h>

#include <boost/range/iterator_range_core.hpp>

#include <cstring>
#include <utility>
#include <vector>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief The planar shapes of a point cloud, the points of each of them, and how they are related.

Shapes, parallel groups and coplanar groups are numbered from 0, groups in the order in which the shapes have them
first. Functions have as a precondition that an index they take exists. A *parallel group* holds the shapes of one
direction, a *coplanar group* those of one plane; a shape that is related to no other is alone in its groups. For a
finished detection
- each point is in at most one shape, within `maximum_distance` of its plane and `maximum_angle` of its normal;
- the planes of a parallel group have the same normal, those of a coplanar group are the same plane, bit for bit;
- the unit normals of two orthogonal parallel groups have a dot product of at most 1e-15, in absolute value;
- a shape is connected and has at least `minimum_region_size` points.

\tparam GeomTraits a model of `Kernel`
*/
template <class GeomTraits>
class Planar_shapes_3 {
public:
  /// \name Types
  /// @{

  /// the kernel
  using Geom_traits = GeomTraits;
  /// a point of the kernel
  using Point_3 = typename GeomTraits::Point_3;
  /// a vector of the kernel
  using Vector_3 = typename GeomTraits::Vector_3;
  /// a plane of the kernel
  using Plane_3 = typename GeomTraits::Plane_3;
  /// a `std::array` of four doubles
  using Coefficients = Tandem::Coefficients;
  /// a range of `std::int32_t` with random access iterators
  using Shape_indices = internal::Shared_table<std::int32_t>;
  /// \cond SKIP_IN_MANUAL
  using Data = internal::Shapes_data;
  /// \endcond

  /// a range of positions in the caller's range, ascending: iterators, `size()`, `empty()` and an index operator. It
  /// refers to the shapes, which have to outlive it.
  using Positions = boost::iterator_range<const std::uint32_t*>;

  /// @}

  /// \cond SKIP_IN_MANUAL
  explicit Planar_shapes_3(Data data = Data(), const GeomTraits& geom_traits = GeomTraits()) : data_(std::move(data))
  {
    const auto construct = geom_traits.construct_plane_3_object();
    using RT = typename GeomTraits::RT;
    for(const Coefficients& c : data_.coefficients)
      planes_.push_back(construct(RT(c[0]), RT(c[1]), RT(c[2]), RT(c[3])));
    take_points();
  }
  /// \endcond

  /// \name Shapes
  /// @{

  /// returns the number of shapes
  std::size_t number_of_shapes() const { return planes_.size(); }

  /// returns the plane of shape `s`, with a unit normal of arbitrary sign: see `oriented_plane()`. Shapes of a parallel
  /// group have the same normal, bit for bit, sign included.
  const Plane_3& plane(std::size_t s) const { return planes_[s]; }

  /// returns the planes of all shapes
  const std::vector<Plane_3>& planes() const { return planes_; }

  /// returns the plane of shape `s` as (a, b, c, d) with a x + b y + c z + d = 0 and a unit normal, in double for every
  /// kernel
  const Coefficients& coefficients(std::size_t s) const { return data_.coefficients[s]; }

  /// returns whether most of the given normals of the points of shape `s` are opposite to the normal of `plane(s)`
  bool is_flipped(std::size_t s) const { return data_.is_flipped[s] != 0; }

  /// returns the plane of shape `s`, oriented as most of the given normals of its points are. Estimated normals have no
  /// orientation: then it returns `plane(s)`.
  Plane_3 oriented_plane(std::size_t s) const { return is_flipped(s) ? planes_[s].opposite() : planes_[s]; }

  /// returns how well the points of shape `s` determine its plane
  const Plane_uncertainty& uncertainty(std::size_t s) const { return data_.uncertainty[s]; }

  /// returns the number of points of shape `s`. With `Mpi_tag`, it counts the points of all processes, without a
  /// message.
  std::size_t size(std::size_t s) const { return data_.size[s]; }

  /// returns the positions of the points of shape `s` in the caller's range, ascending. With `Mpi_tag`, this and the
  /// functions below are about the range of the calling process.
  Positions points(std::size_t s) const
  {
    return Positions(points_.position.data() + points_.first[s], points_.position.data() + points_.first[s + 1]);
  }
  /// @}

  /// \name Points
  /// @{

  /// returns the number of points of the caller's range
  std::size_t number_of_points() const { return data_.shape_of.size(); }

  /// returns the shape of the point at position `i` of the caller's range, -1 if it has none
  int shape_index(std::size_t i) const { return data_.shape_of[i]; }

  /// returns the shape of each point, -1 for none: a range with iterators, `size()`, `empty()` and an index operator.
  /// Copies share the indices.
  const Shape_indices& shape_indices() const { return data_.shape_of; }

  /// returns whether the normals were estimated
  bool has_estimated_normals() const { return data_.statistics.has_estimated_normals; }

  /// returns the estimated unit normal of the point at position `i`, or a null vector if none could be estimated.
  /// \pre `has_estimated_normals()`
  Vector_3 estimated_normal(std::size_t i) const
  {
    using FT = typename GeomTraits::FT;
    const internal::Vector n = internal::unpacked_normal(data_.normal[i]);
    return Vector_3(FT(n.x), FT(n.y), FT(n.z));
  }
  /// @}

  /// \name Relations
  /// @{

  /// returns the number of distinct directions
  std::size_t number_of_parallel_groups() const { return data_.statistics.number_of_directions; }
  /// returns the number of distinct planes
  std::size_t number_of_coplanar_groups() const { return data_.statistics.number_of_planes; }
  /// returns the parallel group of shape `s`
  std::size_t parallel_group(std::size_t s) const { return std::size_t(data_.parallel_group[s]); }
  /// returns the coplanar group of shape `s`
  std::size_t coplanar_group(std::size_t s) const { return std::size_t(data_.coplanar_group[s]); }

  /// returns pairs of parallel groups that are orthogonal, each with the smaller index first, sorted
  const std::vector<std::pair<int, int>>& orthogonal_groups() const { return data_.orthogonal_groups; }

  /// returns which of the `fixed_directions` of the detection parallel group `g` has, up to its sign: the index of the
  /// first one, or -1
  int fixed_direction(std::size_t g) const { return data_.fixed_direction[g]; }

  /// returns the symmetry group of parallel group `g`: parallel groups of a symmetry group make the same angle with the
  /// `symmetry_direction` of the detection, up to 1e-15 of its cosine. It is -1 for a detection without that direction.
  int symmetry_group(std::size_t g) const { return data_.symmetry_group[g]; }

  /// returns whether shapes `s` and `t` are in one parallel group: their normals are exactly equal
  bool are_parallel(std::size_t s, std::size_t t) const { return parallel_group(s) == parallel_group(t); }
  /// returns whether shapes `s` and `t` are in one coplanar group: their planes are exactly equal
  bool are_coplanar(std::size_t s, std::size_t t) const { return coplanar_group(s) == coplanar_group(t); }
  /// returns whether the planes of shapes `s` and `t` are orthogonal; takes logarithmic time
  bool are_orthogonal(std::size_t s, std::size_t t) const
  {
    const std::pair<int, int> groups = std::minmax({data_.parallel_group[s], data_.parallel_group[t]});
    return std::binary_search(data_.orthogonal_groups.begin(), data_.orthogonal_groups.end(), groups);
  }

  /// returns the first shape of each coplanar group, by group: one shape for each distinct plane
  std::vector<std::size_t> distinct_planes() const
  {
    const std::vector<int> first = internal::representatives(data_.coplanar_group);
    return std::vector<std::size_t>(first.begin(), first.end());
  }
  /// @}

  /// \name The detection
  /// @{

  /// counts, quality, times and memory
  const Statistics& statistics() const { return data_.statistics; }

  /// returns the parameters that were used, estimated ones included
  const Parameters& parameters() const { return data_.parameters; }

  /// returns whether the callback ended the detection early. The shapes found until then are complete and verified.
  bool is_cancelled() const { return data_.statistics.is_cancelled; }

  /// returns a hash of 64 bits by which results are compared: equal results have equal hashes, on every machine. It is
  /// of the shape index of each point, in the order of the range, of the coefficients of each plane and, if they were
  /// estimated, of the normals.
  std::uint64_t hash() const
  {
    std::uint64_t h = hash(data_.shape_of, data_.coefficients);
    for(std::uint32_t n : data_.normal)
      add_to_hash(h, n);
    return h;
  }

  /// returns what `hash()` returns for a result with these shape indices (of each point, -1 for none), these planes (of
  /// each shape) and normals that were not estimated: so results that were written to files can be compared
  template <class IndexRange>
  static std::uint64_t hash(const IndexRange& shape_indices, const std::vector<Coefficients>& planes)
  {
    std::uint64_t h = 14695981039346656037u;
    for(std::int32_t s : shape_indices)
      add_to_hash(h, std::uint32_t(s));
    add_to_hash(h, planes);
    return h;
  }
  /// @}

  /// \cond SKIP_IN_MANUAL
  const Data& data() const { return data_; }
  const internal::Point_groups& point_groups() const { return points_; }

  static void add_to_hash(std::uint64_t& h, std::uint64_t word)
  {
    h = (h ^ word) * 1099511628211u;
    h ^= h >> 29;
  }

  static void add_to_hash(std::uint64_t& h, const std::vector<Coefficients>& planes)
  {
    for(const Coefficients& c : planes)
      for(double x : c) {
        std::uint64_t bits;
        std::memcpy(&bits, &x, sizeof bits);
        add_to_hash(h, bits);
      }
  }
  /// \endcond

private:
  // Labels outside of the shapes are left out; is_valid_result() reports them.
  void take_points()
  {
    points_ = std::exchange(data_.points, internal::Point_groups());
    if(!points_.first.empty())
      return;
    internal::Sequential_backend backend;
    points_ = internal::group_points(backend, data_.shape_of.data(), number_of_points(), number_of_shapes());
  }

  Data data_;
  std::vector<Plane_3> planes_;
  internal::Point_groups points_;
};

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_PLANAR_SHAPES_3_H
