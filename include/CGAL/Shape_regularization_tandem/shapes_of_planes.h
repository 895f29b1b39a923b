// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_SHAPES_OF_PLANES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_SHAPES_OF_PLANES_H

#include <CGAL/Shape_regularization_tandem/internal/measured_uncertainty.h>
#include <CGAL/Shape_regularization_tandem/internal/relabel_shapes.h>
#include <CGAL/Shape_regularization_tandem/label_points.h>
#include <CGAL/Tandem/internal/engine/complete_parameters.h>

#include <CGAL/Real_timer.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace CGAL::Tandem {

namespace internal {

// Of unit normal. One that is unit up to rounding keeps its bits.
inline Coefficients unit_plane(const Coefficients& c, std::size_t index)
{
  const Vector n = {c[0], c[1], c[2]};
  const double largest = largest_component(n);
  const bool are_finite = std::isfinite(c[0]) && std::isfinite(c[1]) && std::isfinite(c[2]);
  if(!(largest > 0) || !are_finite || !std::isfinite(c[3] / largest))
    throw std::invalid_argument(
      "Plane " + to_text(index) + " is (" + to_text(c[0]) + ", " + to_text(c[1]) + ", " + to_text(c[2]) + ", " +
      to_text(c[3]) + "): its normal has to be finite and not null, and its distance from the origin finite.");
  if(std::fabs(length(n) - 1) <= 1e-15)
    return c;
  const double size = length({n.x / largest, n.y / largest, n.z / largest});
  Coefficients unit_plane;
  for(std::size_t i = 0; i < 4; ++i)
    unit_plane[i] = c[i] / largest / size;
  return unit_plane;
}

// Planes of unit normal, and their groups: those of the same normal, up to its sign, which becomes that of the first.
inline void take_planes(const std::vector<Coefficients>& planes, Shapes_data& data)
{
  std::map<std::array<double, 3>, double> sign_of; // by normal, which is there with both signs
  Numbering<std::array<double, 3>> directions;
  Numbering<Coefficients> distinct;
  for(std::size_t s = 0; s < planes.size(); ++s) {
    Coefficients c = unit_plane(planes[s], s);
    for(double& x : c)
      x += 0.; // -0 becomes 0
    const double sign = sign_of.emplace(std::array<double, 3>{c[0], c[1], c[2]}, 1).first->second;
    for(double& x : c)
      x = 0. + sign * x;
    sign_of.emplace(std::array<double, 3>{0. - c[0], 0. - c[1], 0. - c[2]}, -1);
    data.coefficients.push_back(c);
    data.parallel_group.push_back(directions({c[0], c[1], c[2]}));
    data.coplanar_group.push_back(distinct(c));
  }
}

// From the labels of imported points, in doubles: sums may depend on the order of points by rounding.
inline void measure_labels(const Import& in, Shapes_data& data)
{
  const auto position = [&](std::size_t i) { return in.position(i); };
  const std::size_t shapes = data.coefficients.size();
  std::vector<std::vector<std::uint32_t>> points(shapes);
  std::vector<std::size_t> opposed(shapes, 0);
  double distances = 0;
  for(std::size_t i = 0; i < in.size(); ++i) {
    const int label = data.shape_of[in.item_of(i)];
    if(label < 0)
      continue;
    const std::size_t s = std::size_t(label);
    const Coefficients& c = data.coefficients[s];
    points[s].push_back(std::uint32_t(i));
    distances += std::fabs(dot({c[0], c[1], c[2]}, in.position(i)) + c[3]);
    opposed[s] += in.has_normals && dot({c[0], c[1], c[2]}, in.normal(i)) < 0;
  }
  Statistics& t = data.statistics;
  for(std::size_t s = 0; s < shapes; ++s) {
    data.size.push_back(points[s].size());
    data.is_flipped.push_back(2 * opposed[s] > points[s].size());
    data.uncertainty.push_back(points[s].empty() ? Plane_uncertainty()
                                                 : measured_uncertainty(points[s], position, data.coefficients[s],
                                                                        data.parameters, t.grid_step));
    t.number_of_assigned_points += points[s].size();
  }
  t.mean_distance = t.number_of_assigned_points > 0 ? distances / double(t.number_of_assigned_points) : 0;
  t.coverage = t.number_of_points > 0 ? double(t.number_of_assigned_points) / double(t.number_of_points) : 0;
  t.free_points.clutter = std::size_t(in.total.points) - t.number_of_assigned_points;
}

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief returns a result with known planes: each plane is a shape, with the points that `label_points()` gives to it.

Shape s is plane s, also where it has no points. Planes stay as they are, except that their normals become unit vectors,
and that a plane is turned over if its normal is exactly opposite to that of an earlier plane. Planes with exactly the
same normal are parallel, exactly the same planes are coplanar. Orthogonal groups, `fixed_directions` and symmetry are
found, not made. Of coplanar shapes, the first one gets all points.

Of the promises of `Planar_shapes_3`, those on relations hold, and points are within the tolerances. Shapes need not be
connected, and may have less than `minimum_region_size` points, or none, so `is_valid_result()` returns `false`.
Normals are not estimated: without a normal map only distances count, and `Planar_shapes_3::has_estimated_normals()` is
false in any case.
In the statistics, points without a shape count as `Free_points::clutter`, and the score is 0.

\tparam ConcurrencyTag as of `label_points()`
\param planes the planes a x + b y + c z + d = 0, with normals of any length
\param points a range of points
\param np the named parameters of `detect_planes()`. `maximum_distance` is estimated where it is not given.

\return the shapes as a `Planar_shapes_3` of the kernel of the points

\throw Parameter_error as `detect_planes()`
\throw std::invalid_argument the normal of a plane is null or not finite, or its distance from the origin is not finite
\throw std::length_error more than 2^31 points
\throw std::range_error as `detect_planes()`
*/
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class PointRange,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
auto shapes_of_planes(const std::vector<Coefficients>& planes, const PointRange& points,
                      const NamedParameters& np = NamedParameters())
{
  CGAL::Real_timer timer;
  timer.start();
  return internal::on_backend<ConcurrencyTag>(points, np, [&](auto& backend, const auto& traits) {
    Parameters p = internal::read_parameters(np);
    internal::Import in = internal::read_range(backend, points, np, traits);
    const std::string note = internal::set_scale(backend, in, internal::has_own_offset(np), p);
    internal::Shapes_data data = internal::start_export(in, p);
    internal::take_planes(planes, data);
    data.shape_of = internal::labels_by_planes(backend, in, data.coefficients, p);
    data.statistics.has_estimated_normals = false;
    internal::measure_labels(in, data);
    internal::relate_groups(data);
    internal::measure_relations(data, {});
    data.statistics.score = {};
    data.statistics.estimate_note = note;
    data.statistics.angle_note = internal::angle_note(p);
    data.statistics.backend = backend.name();
    data.statistics.times.finish = data.statistics.times.total = timer.time();
    return Planar_shapes_3<typename std::decay<decltype(traits)>::type::Geom_traits>(std::move(data));
  });
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_SHAPES_OF_PLANES_H
