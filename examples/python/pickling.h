// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shapes as bytes, and back: for this version of the package and the same order of bytes.

#ifndef TANDEM_PYTHON_PICKLING_H
#define TANDEM_PYTHON_PICKLING_H

#include "detection.h"

#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace tandem_python {

// f(member) for all numbers, texts and tables that shapes consist of; the points of each shape follow from the labels.
// What has more members than are named here does not compile.
template <class Data, class F>
void for_each_member(Data& data, F& f)
{
  auto& [coefficients, size, parallel_group, coplanar_group, orthogonal_groups, fixed_direction, symmetry_group,
         is_flipped, uncertainty, shape_of, normal, parameters, statistics, points] = data;
  const auto all = [&f](auto&... members) { (f(members), ...); };
  all(coefficients, size, parallel_group, coplanar_group, orthogonal_groups, fixed_direction, symmetry_group,
      is_flipped, uncertainty, shape_of, normal);
  {
    auto& [maximum_distance, maximum_angle, angle_tolerance, maximum_offset, minimum_region_size, simplicity,
           regularity, surfel_size, k_neighbors, cell_size, parallelism, orthogonality, coplanarity, fixed_directions,
           fixed_regularity, axis_symmetry, symmetry_direction, period] = parameters;
    all(maximum_distance, maximum_angle, angle_tolerance, maximum_offset, minimum_region_size, simplicity, regularity,
        surfel_size, k_neighbors, cell_size, parallelism, orthogonality, coplanarity, fixed_directions,
        fixed_regularity, axis_symmetry, symmetry_direction, period);
  }
  auto& [number_of_points, ignored_coordinates, ignored_normals, ignored_tolerances, far, assigned, free_points,
         number_of_shapes, directions, planes, orthogonal_pairs, coverage, mean_distance, degrees_of_freedom,
         complexity, score, rounds, times, peak_bytes, grid_step, is_grid_coarse, line_spacing, has_estimated_normals,
         is_cancelled, estimate_note, angle_note, backend] = statistics;
  all(number_of_points, ignored_coordinates, ignored_normals, ignored_tolerances, far, assigned, free_points,
      number_of_shapes, directions, planes, orthogonal_pairs, coverage, mean_distance, degrees_of_freedom, complexity,
      score, rounds, times, peak_bytes, grid_step, is_grid_coarse, line_spacing, has_estimated_normals, is_cancelled,
      estimate_note, angle_note, backend);
}

// Tables and texts have their size in front.
class Byte_writer {
public:
  template <class Member>
  void operator()(const Member& member)
  {
    if constexpr(std::is_trivially_copyable_v<Member>)
      write(&member, sizeof member);
    else {
      (*this)(member.size());
      write(member.data(), member.size() * sizeof(typename Member::value_type));
    }
  }

  std::string bytes;

private:
  void write(const void* from, std::size_t size) { bytes.append(static_cast<const char*>(from), size); }
};

class Byte_reader {
public:
  explicit Byte_reader(std::string_view bytes) : rest_(bytes) {}

  template <class Member>
  void operator()(Member& member)
  {
    if constexpr(std::is_trivially_copyable_v<Member>)
      std::memcpy(&member, take(1, sizeof member), sizeof member);
    else {
      using Item = typename Member::value_type;
      std::size_t size = 0;
      (*this)(size);
      const auto* const from = take(size, sizeof(Item));
      if constexpr(std::is_same_v<Member, std::string>)
        member.assign(from, size);
      else {
        std::vector<Item> items(size);
        if(size > 0)
          std::memcpy(static_cast<void*>(items.data()), from, size * sizeof(Item));
        member = std::move(items);
      }
    }
  }

  bool is_at_end() const { return rest_.empty(); }

private:
  const char* take(std::size_t items, std::size_t size)
  {
    if(items > rest_.size() / size)
      throw std::invalid_argument("the pickle of tandem.PlanarShapes is incomplete");
    const char* const from = rest_.data();
    rest_.remove_prefix(items * size);
    return from;
  }

  std::string_view rest_;
};

inline std::string bytes_of(const Shapes& shapes)
{
  Byte_writer writer;
  for_each_member(shapes.data(), writer);
  return std::move(writer.bytes);
}

// Throws std::invalid_argument for bytes that are not those of shapes in so many points.
inline Shapes shapes_of(std::string_view bytes, std::size_t number_of_points)
{
  Shapes::Data data;
  Byte_reader reader(bytes);
  for_each_member(data, reader);
  if(!reader.is_at_end() || data.shape_of.size() != number_of_points)
    throw std::invalid_argument("the pickle of tandem.PlanarShapes is not of " + std::to_string(number_of_points) +
                                " points");
  return Shapes(std::move(data));
}

} // namespace tandem_python

#endif // TANDEM_PYTHON_PICKLING_H
