// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The volumes of a kinetic partition of space, and their facets.

#ifndef DETECT_PLANES_VOLUMES_H
#define DETECT_PLANES_VOLUMES_H

#include "output/write_results.h"

#include <CGAL/Cartesian_converter.h>
#include <CGAL/Kinetic_space_partition_3.h>
#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace program {

class Volumes {
public:
  using Partition = CGAL::Kinetic_space_partition_3<Kernel>;
  using Complex = CGAL::Linear_cell_complex_for_combinatorial_map<3, 3, CGAL::Linear_cell_complex_traits<3, Kernel>,
                                                                  Partition::Linear_cell_complex_min_items>;
  using Dart = Complex::Dart_descriptor; // of an edge of a facet, on one side of it

  explicit Volumes(const Partition& partition) : number(partition.number_of_volumes())
  {
    partition.get_linear_cell_complex(complex);
  }

  std::size_t size() const { return number; }

  // What is beyond the bounding box has the number after the last one.
  std::size_t volume(Dart d) const { return complex.info<3>(d).volume_id; }
  std::size_t volume_beyond(Dart d) const { return complex.is_free<3>(d) ? number : volume(complex.beta<3>(d)); }

  // Negative if it is not one of the input.
  int plane(Dart d) const { return int(complex.info<2>(d).input_polygon_index); }

  const Kernel::Point_3& start(Dart d) const { return complex.point(d); }
  Dart next_edge(Dart d) const { return complex.beta<1>(d); }
  Dart next_facet(Dart d) const { return complex.beta<2>(d); } // of the volume, at the same edge
  Dart beyond(Dart d) const { return complex.beta<3>(d); }

  std::vector<Dart> edges_of_facet(Dart d) const
  {
    std::vector<Dart> result(1, d);
    for(Dart e = next_edge(d); e != d; e = next_edge(e))
      result.push_back(e);
    return result;
  }

  std::vector<Kernel::Point_3> corners_of_facet(Dart d) const
  {
    std::vector<Kernel::Point_3> result;
    for(Dart e : edges_of_facet(d))
      result.push_back(start(e));
    return result;
  }

  std::vector<Dart> edges() const
  {
    std::vector<Dart> result;
    for(auto d = complex.darts().begin(); d != complex.darts().end(); ++d)
      result.push_back(complex.dart_descriptor(*d));
    return result;
  }

  // One edge of each.
  std::vector<Dart> facets() const
  {
    std::vector<Dart> result;
    const auto range = complex.one_dart_per_cell<2>();
    for(auto d = range.begin(); d != range.end(); ++d)
      result.push_back(complex.dart_descriptor(*d));
    return result;
  }

  // Of each volume.
  std::vector<Kernel::Point_3> barycenters() const
  {
    const CGAL::Cartesian_converter<Partition::Intersection_kernel, Kernel> converted;
    std::vector<Kernel::Point_3> result(number);
    const auto range = complex.one_dart_per_cell<3>();
    for(auto d = range.begin(); d != range.end(); ++d) {
      const auto& info = complex.info<3>(complex.dart_descriptor(*d));
      result[info.volume_id] = converted(info.barycenter);
    }
    return result;
  }

private:
  std::size_t number;
  Complex complex;
};

inline double area_of(const std::vector<Kernel::Point_3>& corners)
{
  Kernel::Vector_3 sum = CGAL::NULL_VECTOR;
  for(std::size_t i = 2; i < corners.size(); ++i)
    sum = sum + CGAL::cross_product(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return std::sqrt(sum.squared_length()) / 2;
}

} // namespace program

#endif // DETECT_PLANES_VOLUMES_H
