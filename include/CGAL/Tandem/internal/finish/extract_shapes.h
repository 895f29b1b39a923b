// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From labels to the result: the exact check, planes through clutter, connected
// components, and the canonical order of the shapes.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_EXTRACT_SHAPES_H
#define CGAL_TANDEM_INTERNAL_FINISH_EXTRACT_SHAPES_H

#include <CGAL/Tandem/internal/finish/Engine_result.h>
#include <CGAL/Tandem/internal/finish/clutter.h>
#include <CGAL/Tandem/internal/finish/components.h>
#include <CGAL/Tandem/internal/finish/exact_check.h>
#include <CGAL/Tandem/internal/finish/group_points.h>
#include <CGAL/Tandem/internal/finish/large_components.h>
#include <CGAL/Tandem/internal/finish/measure_shapes.h>
#include <CGAL/Tandem/internal/rounds/regularize_shapes.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// The planes of the relations in the caller's coordinates, by plane of the relations.
inline std::vector<Coefficients> caller_planes(const Relations& relations, const Grid& grid)
{
  std::vector<Coefficients> planes;
  for(const Regular_plane& p : relations.planes)
    planes.push_back(to_caller(p, grid));
  return planes;
}

// The entry of the relations that each point belongs to. Shapes without an entry are
// too small to be part of a result.
struct Take_entries {
  const std::uint32_t* source;
  const std::uint32_t* entry_of; // by shape
  std::uint32_t* label;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t entry = source[i] < first_mark ? entry_of[source[i]] : no_index;
    label[i] = entry != no_index ? entry : free_label;
  }
};

struct Free_dropped {
  const std::uint8_t* is_dropped; // by label
  std::uint32_t* label;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(label[i] < first_mark && is_dropped[label[i]])
      label[i] = free_label;
  }
};

struct Number_roots {
  const Component* component; // in the order of the shapes
  std::uint32_t* number;      // by root

  CGAL_TANDEM_HD void operator()(std::size_t i) const { number[component[i].root] = std::uint32_t(i); }
};

// In the order of the imported points.
struct Write_shapes {
  const std::uint32_t* component;
  const std::uint32_t* number;
  const std::uint32_t* order;
  std::int32_t* shape_of;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { shape_of[order[i]] = std::int32_t(number[component[i]]); }
};

struct Write_normals {
  const Grid_point* point;
  const std::uint32_t* order;
  std::uint32_t* normal;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { normal[order[i]] = point[i].normal; }
};

template <class Backend>
class Shape_extractor {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

public:
  Shape_extractor(Tandem_state<Backend>& t, const Shape_relations& relations, const Import& in,
                  const std::uint32_t* order)
    : t_(t), relations_(relations), in_(in), order_(order), label_(t.cloud.size)
  {}

  Engine_result extract()
  {
    take_entries();
    check_points();
    drop_clutter();
    Engine_result result;
    name_shapes(result);
    if(!in_.has_normals)
      write_normals(result);
    return result;
  }

private:
  void take_entries()
  {
    std::vector<std::uint32_t> entry_of(t_.shapes.size(), no_index);
    for(std::uint32_t i = 0; i < relations_.id.size(); ++i)
      entry_of[relations_.id[i]] = i;
    const auto entries = t_.backend.read_access(entry_of);
    t_.backend.for_each(t_.cloud.size, Take_entries{t_.label.data(), entries.data(), label_.data()});
  }

  void check_points()
  {
    const Relations& relations = relations_.relations;
    const std::vector<Coefficients> planes = caller_planes(relations, in_.grid);
    for(std::size_t i = 0; i < relations_.id.size(); ++i) {
      plane_.push_back(rounded(relations.planes[std::size_t(relations.plane_of[i])]));
      coefficients_.push_back(planes[std::size_t(relations.plane_of[i])]);
    }
    const Caller_view caller = {in_.coordinates.view(), in_.normals.view()};
    const auto plane = t_.backend.read_access(plane_);
    check_exactly(t_.backend, Is_uncertain{t_.cloud.point, label_.data(), plane.data(), t_.options.certain},
                  label_.data(), t_.cloud.size, order_, Check_exactly{caller, coefficients_.data(), t_.options.exact});
  }

  // Of the distances of the points to the plane of an entry, in epsilons.
  double rms(std::size_t entry) const
  {
    const Shape& shape = t_.shapes[relations_.id[entry]];
    const double squares = excess(shape.scatter, shape.fit, shape.plane) + shape.fit.smallest;
    return std::sqrt((std::max)(squares, 0.) / (std::max)(shape.scatter.count, 1.)) / t_.options.maximum_distance;
  }

  void drop_clutter()
  {
    std::vector<Neighbor_counts> counts(plane_.size());
    std::vector<std::uint8_t> is_crisp(plane_.size()), is_dropped(plane_.size());
    for(std::size_t i = 0; i < plane_.size(); ++i)
      is_crisp[i] = rms(i) < crisp_rms;
    const auto plane = t_.backend.read_access(plane_);
    const auto crisp = t_.backend.read_access(is_crisp);
    auto sums = t_.backend.read_write_access(counts);
    t_.backend.template for_each_cell<Neighbor_scratch>(
      t_.number_of_cells, Count_neighbors<Backend>{t_.cloud, t_.cells.data(), label_.data(), plane.data(), crisp.data(),
                                                   sums.data(), t_.options.growth.tolerance.distance});
    sums.copy_back();
    for(std::size_t i = 0; i < plane_.size(); ++i)
      is_dropped[i] = is_clutter(counts[i], rms(i));
    const auto dropped = t_.backend.read_access(is_dropped);
    t_.backend.for_each(t_.cloud.size, Free_dropped{dropped.data(), label_.data()});
  }

  void name_shapes(Engine_result& result)
  {
    const std::size_t n = t_.cloud.size;
    Buffer<std::uint32_t> component(n);
    find_components(t_, label_.data(), component.data());
    const std::vector<Component> components = large_components(t_, label_.data(), component.data());
    number_groups(components, result);
    Buffer<std::uint32_t> number(n);
    t_.backend.for_each(n, Fill{number.data(), no_index});
    const auto named = t_.backend.read_access(components);
    t_.backend.for_each(components.size(), Number_roots{named.data(), number.data()});
    measure_shapes(component.data(), number.data(), result);
    Buffer<std::int32_t> shape_of(n);
    t_.backend.for_each(n, Write_shapes{component.data(), number.data(), order_, shape_of.data()});
    component.release();
    number.release();
    take_points(t_.backend, std::move(shape_of), components.size(), result);
  }

  // Directions and planes in the order in which the shapes have them first.
  void number_groups(const std::vector<Component>& components, Engine_result& result) const
  {
    const Relations& relations = relations_.relations;
    std::vector<int> direction(relations.directions.size(), -1), plane(relations.planes.size(), -1);
    int directions = 0, planes = 0;
    for(const Component& c : components) {
      const std::size_t d = std::size_t(relations.direction_of[c.entry]);
      const std::size_t p = std::size_t(relations.plane_of[c.entry]);
      direction[d] = direction[d] < 0 ? directions++ : direction[d];
      plane[p] = plane[p] < 0 ? planes++ : plane[p];
      result.shapes.push_back({coefficients_[c.entry], direction[d], plane[p], c.size, false});
    }
  }

  void measure_shapes(const std::uint32_t* component, const std::uint32_t* number, Engine_result& result)
  {
    std::vector<std::uint32_t> opposed(result.shapes.size(), 0);
    std::vector<std::uint64_t> distance(1, 0);
    const auto plane = t_.backend.read_access(plane_);
    auto opposed_sums = t_.backend.read_write_access(opposed);
    auto distance_sum = t_.backend.read_write_access(distance);
    t_.backend.template for_each_cell<Measure_scratch>(
      t_.number_of_cells,
      Measure_points<Backend>{t_.cloud.point, t_.cells.data(), label_.data(), plane.data(), component, number,
                              t_.options.growth.tolerance.distance, opposed_sums.data(), distance_sum.data()});
    opposed_sums.copy_back();
    distance_sum.copy_back();
    std::size_t points = 0;
    for(std::size_t s = 0; s < result.shapes.size(); ++s) {
      points += result.shapes[s].size;
      result.shapes[s].is_flipped = in_.has_normals && 2 * std::size_t(opposed[s]) > result.shapes[s].size;
    }
    result.mean_distance = points > 0 ? double(distance[0]) / double(points) / distance_units : 0;
  }

  // The items of a buffer, which is given up.
  template <class T>
  Shared_table<T> on_host(Buffer<T>&& buffer)
  {
    if constexpr(std::is_base_of<Host_buffer<T>, Buffer<T>>::value)
      return Shared_table<T>(std::move(buffer));
    else {
      Host_buffer<T> table(buffer.size());
      table.keep_pages();
      t_.backend.to_host(buffer.data(), buffer.size(), table.data());
      return Shared_table<T>(std::move(table));
    }
  }

  void write_normals(Engine_result& result)
  {
    Buffer<std::uint32_t> normal(t_.cloud.size);
    t_.backend.for_each(t_.cloud.size, Write_normals{t_.cloud.point, order_, normal.data()});
    result.normal = on_host<std::uint32_t>(std::move(normal));
  }

  Tandem_state<Backend>& t_;
  const Shape_relations& relations_;
  const Import& in_;
  const std::uint32_t* order_;
  Buffer<std::uint32_t> label_;            // entry of the relations
  std::vector<Plane> plane_;               // by entry
  std::vector<Coefficients> coefficients_; // by entry
};

template <class Backend>
Engine_result extract_shapes(Tandem_state<Backend>& t, const Shape_relations& relations, const Import& in,
                             const std::uint32_t* order)
{
  return Shape_extractor<Backend>(t, relations, in, order).extract();
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_EXTRACT_SHAPES_H
