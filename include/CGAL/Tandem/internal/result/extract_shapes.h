// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From labels and relations to the result: exact check, connected components, and the final order of
// the shapes. Works on labels of its own, so it may run between two rounds: labels, states and shapes of the loop stay.
// Labels are entries of the relations here: entry i is the shape relations.id[i].

#ifndef CGAL_TANDEM_INTERNAL_RESULT_EXTRACT_SHAPES_H
#define CGAL_TANDEM_INTERNAL_RESULT_EXTRACT_SHAPES_H

#include <CGAL/Tandem/internal/finish/components.h>
#include <CGAL/Tandem/internal/finish/measure_shapes.h>
#include <CGAL/Tandem/internal/result/Engine_result.h>
#include <CGAL/Tandem/internal/result/exact_check.h>
#include <CGAL/Tandem/internal/result/explain_free_points.h>
#include <CGAL/Tandem/internal/result/group_points.h>
#include <CGAL/Tandem/internal/result/measure_planes.h>
#include <CGAL/Tandem/internal/rounds/regularize_shapes.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>

#include <array>
#include <map>
#include <utility>

namespace CGAL::Tandem::internal {

// One extraction: the steps in the order of extract(), with the tables that they share.
template <class Backend>
class Shape_extractor {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

public:
  Shape_extractor(Labeled_cloud<Backend>& points, const Shape_table<Backend>& shapes, const Stage_parameters& options,
                  const Shape_relations& relations, const Import& in)
    : points_(points), backend_(points.backend), shapes_(shapes), parameters_(options), relations_(relations), in_(in),
      label_(points.cloud.size_with_ghosts())
  {}

  Engine_result extract()
  {
    take_entries();
    check_points();
    label_free_surfels(points_, bounded(parameters_.certain), label_, point_label_);
    Engine_result result;
    name_shapes(result);
    if(!in_.has_normals)
      write_normals(result);
    return result;
  }

private:
  // Fills label_; from here on no step reads the labels of the loop. Shapes without an entry are too small for a
  // result; their surfels are free.
  void take_entries()
  {
    const auto id = to_buffer(backend_, relations_.id);
    const auto entry_of = places_of(backend_, shapes_.size, id);
    backend_.for_each(label_.size(), Take_number{points_.label(), points_.label(), entry_of.data(), label_.data()});
  }

  // The filter uses planes with integer coefficients, the test itself those of the caller's space. Entries of one
  // coplanar group get the same bits in both.
  void check_points()
  {
    const Relations& relations = relations_.relations;
    for(const int p : relations.plane_of)
      coefficients_.push_back(to_caller(relations.planes[std::size_t(p)], in_.grid));
    plane_ = backend_.template make_buffer<Plane>(relations_.id.size(), [&](std::size_t i) {
      return rounded(relations.planes[std::size_t(relations.plane_of[i])]);
    });
    spread_labels(points_, label_.data(), bounded(parameters_.possible), in_.has_normals, point_label_);
    std::uint32_t* const checked = point_label_.size() > 0 ? point_label_.data() : label_.data();
    check_exactly(backend_, points_.cloud.number_of_points(), {bounded(parameters_.certain), checked, order()},
                  {in_.coordinates.view(), in_.normals.view(), coefficients_.data(), parameters_.exact});
    free_rejected(points_, labels(), label_.data());
    points_.ranks.refresh(label_.data(), Rings::inner);
  }

  // Components of the labels become shapes: by falling number of points, ties by position of the root.
  // Buffers of the size of the cloud are released before the points are grouped, which needs memory itself.
  void name_shapes(Engine_result& result)
  {
    const std::size_t n = points_.cloud.number_of_surfels();
    Buffer<std::uint32_t> component(label_.size());
    std::vector<Component> components = large_components(points_, parameters_, labels(), component.data());
    number_groups(components, result);
    for(std::size_t i = 0; i < components.size(); ++i)
      components[i].entry = std::uint32_t(i);
    auto number = filled_buffer(backend_, n, no_index);
    const auto named = to_buffer(backend_, components);
    backend_.for_each(components.size(), Number_roots{named.data(), number.data()});
    backend_.for_each(n, Gather_items<std::uint32_t>{number.data(), component.data(), component.data()});
    number.release();
    points_.ranks.refresh(component.data(), Rings::inner);
    measure_shapes(component.data(), result);
    const Final_shapes shapes = {labels(), component.data()};
    result.free_points = explain_free_points(points_, shapes, result.shapes, in_, parameters_.growth.tolerance);
    measure_planes(points_, shapes, in_.grid, parameters_.exact.maximum_distance, result.shapes);
    auto shape_of = filled_buffer(backend_, points_.cloud.number_of_points(), std::int32_t(-1));
    backend_.for_each(n, Write_shapes{labels(), component.data(), order(), shape_of.data()});
    component.release();
    label_.release();
    point_label_.release();
    take_points(backend_, std::move(shape_of), components.size(), result);
  }

  // Directions and planes are numbered in the order in which the shapes have them first. So numbers do not depend on
  // how the relations were found, and none is unused. Equal planes have one number, found as relations or not.
  void number_groups(const std::vector<Component>& components, Engine_result& result) const
  {
    std::map<std::array<double, 3>, int> direction;
    std::map<Coefficients, int> plane;
    const auto number = [](auto& numbers, const auto& key) {
      return numbers.emplace(key, int(numbers.size())).first->second;
    };
    for(const Component& component : components) {
      const Coefficients& c = coefficients_[component.entry];
      const int d = number(direction, std::array<double, 3>{c[0], c[1], c[2]});
      result.shapes.push_back({c, d, number(plane, c), component.size, false});
    }
  }

  // Counts the opposite normals of each shape, and sums distances and what the score counts. Estimated
  // normals are not oriented.
  void measure_shapes(const std::uint32_t* shape, Engine_result& result)
  {
    const auto sum =
      measure_points(points_, {labels(), shape}, plane_.data(), parameters_.growth.tolerance, result.shapes.size());
    const auto* const opposed = sum.data() + Point_measures::size;
    result.counts = counts_of(sum);
    std::size_t points = 0;
    for(std::size_t s = 0; s < result.shapes.size(); ++s) {
      points += result.shapes[s].size;
      result.shapes[s].is_flipped = in_.has_normals && 2 * std::size_t(opposed[s]) > result.shapes[s].size;
    }
    const double units = double((std::max)(points, std::size_t(1))) * double(Score::tolerance_units);
    result.mean_distance = double(sum[Point_measures::distance]) / units;
  }

  // Moves the items of a buffer to a table of the host, without a copy where the buffer is memory of the host.
  template <class T>
  Shared_table<T> on_host(Buffer<T>&& buffer)
  {
    if constexpr(std::is_base_of<Host_buffer<T>, Buffer<T>>::value)
      return Shared_table<T>(std::move(buffer));
    else {
      Host_buffer<T> table(buffer.size());
      table.keep_pages();
      backend_.to_host(buffer.data(), buffer.size(), table.data());
      return Shared_table<T>(std::move(table));
    }
  }

  void write_normals(Engine_result& result)
  {
    const std::size_t n = points_.cloud.number_of_points();
    Buffer<std::uint32_t> normal(n);
    backend_.for_each(n, Write_normals{points_.cloud.surfels().point, order(), normal.data()});
    result.normal = on_host<std::uint32_t>(std::move(normal));
  }

  Bounded_planes bounded(const Tolerance& t) const { return {points_.cloud.surfels(), plane_.data(), t}; }
  const std::uint32_t* order() const { return points_.cloud.order.data(); }

  Labels_of_points labels() const
  {
    return {points_.cloud.surfels(), label_.data(), point_label_.size() > 0 ? point_label_.data() : nullptr};
  }

  Labeled_cloud<Backend>& points_;
  Backend& backend_;
  const Shape_table<Backend>& shapes_;
  const Stage_parameters& parameters_;
  const Shape_relations& relations_;
  const Import& in_;
  Buffer<std::uint32_t> label_;       // of surfels: entry of the relations
  Buffer<std::uint32_t> point_label_; // of points: the same, or none; empty without surfels. The others are by entry
  Buffer<Plane> plane_;
  std::vector<Coefficients> coefficients_;
};

template <class Backend>
Engine_result extract_shapes(Labeled_cloud<Backend>& points, const Shape_table<Backend>& shapes,
                             const Stage_parameters& options, const Shape_relations& relations, const Import& in)
{
  return Shape_extractor<Backend>(points, shapes, options, relations, in).extract();
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_RESULT_EXTRACT_SHAPES_H
