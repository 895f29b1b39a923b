// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From labels to the result: the exact check, planes through clutter, connected
// components, and the canonical order of the shapes.

#ifndef CGAL_TANDEM_INTERNAL_EXTRACT_SHAPES_H
#define CGAL_TANDEM_INTERNAL_EXTRACT_SHAPES_H

#include <CGAL/Tandem/internal/clutter.h>
#include <CGAL/Tandem/internal/components.h>
#include <CGAL/Tandem/internal/exact_check.h>
#include <CGAL/Tandem/internal/import_cloud.h>
#include <CGAL/Tandem/internal/regularize_shapes.h>
#include <CGAL/Shape_regularization_tandem/Statistics.h>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Engine_shape {
  Coefficients plane; // common to the shapes of a plane group; its normal to those of a direction
  int direction;      // parallel group
  int plane_group;    // coplanar group
};

struct Engine_result {
  std::vector<Engine_shape> shapes;   // by falling number of points
  std::vector<std::int32_t> shape_of; // per imported point, -1 = none
  std::vector<std::uint32_t> normal;  // per imported point, the packed normal that was used
  std::size_t rounds = 0;
  bool is_cancelled = false;
  bool is_coarse = false;
  Stage_times times;
  std::size_t peak_bytes = 0;
};

// The planes of the relations in the caller's coordinates, by plane of the relations.
inline std::vector<Coefficients> caller_planes(const Relations& relations, const Grid& grid)
{
  std::vector<Coefficients> planes;
  for(const Regular_plane& p : relations.planes)
    planes.push_back(to_caller(p, grid));
  return planes;
}

template <class Backend>
class Shape_extractor {
public:
  Shape_extractor(Tandem_state<Backend>& t, const Shape_relations& relations, const Import& in,
                  const std::uint32_t* order)
    : t_(t), relations_(relations), in_(in), order_(order), label_(t.cloud.size), entry_of_(t.shapes.size(), no_index)
  {
    for(std::uint32_t i = 0; i < relations.id.size(); ++i)
      entry_of_[relations.id[i]] = i;
  }

  Engine_result extract()
  {
    copy_labels();
    check_exactly();
    drop_clutter();
    Engine_result result;
    result.shape_of.assign(in_.size(), -1);
    result.normal.resize(in_.has_normals ? 0 : in_.size());
    name_shapes(result);
    for(std::size_t i = 0; i < result.normal.size(); ++i)
      result.normal[order_[i]] = t_.cloud.point[i].normal;
    return result;
  }

private:
  // Shapes without an entry in the relations are too small to be part of a result.
  void copy_labels()
  {
    const std::uint32_t* source = t_.label.data();
    std::uint32_t* target = label_.data();
    const std::uint32_t* entry = entry_of_.data();
    t_.backend.for_each(t_.cloud.size, [=](std::size_t i) {
      target[i] = source[i] < first_mark && entry[source[i]] != no_index ? entry[source[i]] : is_free;
    });
  }

  void check_exactly()
  {
    const Relations& relations = relations_.relations;
    const std::vector<Coefficients> planes = caller_planes(relations, in_.grid);
    for(std::size_t i = 0; i < relations_.id.size(); ++i) {
      plane_.push_back(rounded(relations.planes[std::size_t(relations.plane_of[i])]));
      coefficients_.push_back(planes[std::size_t(relations.plane_of[i])]);
    }
    const Caller_view caller = {in_.coordinates.data(), in_.has_normals ? in_.normals.data() : nullptr};
    t_.backend.for_each(t_.cloud.size, Check_exactly{t_.cloud.point, order_, caller, label_.data(), plane_.data(),
                                                     coefficients_.data(), t_.options.certain, t_.options.exact});
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
    t_.backend.for_each_piece(t_.cloud.size, 4096,
                              Count_neighbors<Backend>{t_.cloud, label_.data(), plane_.data(), is_crisp.data(),
                                                       counts.data(), t_.options.growth.tolerance.distance});
    for(std::size_t i = 0; i < plane_.size(); ++i)
      is_dropped[i] = is_clutter(counts[i], rms(i));
    std::uint32_t* label = label_.data();
    const std::uint8_t* dropped = is_dropped.data();
    t_.backend.for_each(t_.cloud.size, [=](std::size_t i) {
      if(label[i] < first_mark && dropped[label[i]])
        label[i] = is_free;
    });
  }

  // The components that are large enough, by falling size, then by position.
  std::vector<std::uint32_t> large_components(const std::uint32_t* component)
  {
    std::vector<std::uint32_t> size(t_.cloud.size, 0), roots;
    for(std::size_t i = 0; i < t_.cloud.size; ++i)
      ++size[component[i]];
    for(std::uint32_t i = 0; i < t_.cloud.size; ++i)
      if(component[i] == i && label_[i] < first_mark && size[i] >= std::uint64_t(t_.options.minimum_region_size))
        roots.push_back(i);
    std::sort(roots.begin(), roots.end(),
              [&](std::uint32_t a, std::uint32_t b) { return size[a] != size[b] ? size[a] > size[b] : a < b; });
    return roots;
  }

  void name_shapes(Engine_result& result)
  {
    typename Backend::template Buffer<std::uint32_t> component(t_.cloud.size);
    find_components(t_.backend, t_.cloud, label_.data(), component.data());
    const std::vector<std::uint32_t> roots = large_components(component.data());
    std::vector<std::int32_t> shape_of_root(t_.cloud.size, -1);
    std::vector<int> direction(relations_.relations.directions.size(), -1),
      plane(relations_.relations.planes.size(), -1);
    int directions = 0, planes = 0;
    for(std::uint32_t root : roots) {
      const std::uint32_t entry = label_[root];
      const std::size_t d = std::size_t(relations_.relations.direction_of[entry]);
      const std::size_t p = std::size_t(relations_.relations.plane_of[entry]);
      direction[d] = direction[d] < 0 ? directions++ : direction[d];
      plane[p] = plane[p] < 0 ? planes++ : plane[p];
      shape_of_root[root] = std::int32_t(result.shapes.size());
      result.shapes.push_back({coefficients_[entry], direction[d], plane[p]});
    }
    for(std::size_t i = 0; i < t_.cloud.size; ++i)
      result.shape_of[order_[i]] = shape_of_root[component[i]];
  }

  Tandem_state<Backend>& t_;
  const Shape_relations& relations_;
  const Import& in_;
  const std::uint32_t* order_;
  typename Backend::template Buffer<std::uint32_t> label_; // entry of the relations
  std::vector<std::uint32_t> entry_of_;                    // by shape
  std::vector<Plane> plane_;                               // by entry
  std::vector<Coefficients> coefficients_;                 // by entry
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

#endif // CGAL_TANDEM_INTERNAL_EXTRACT_SHAPES_H
