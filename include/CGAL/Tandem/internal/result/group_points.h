// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The list of points of each shape, from the shape of each point. A back end may replace the sort: the lists are
// defined by their contents.

#ifndef CGAL_TANDEM_INTERNAL_RESULT_GROUP_POINTS_H
#define CGAL_TANDEM_INTERNAL_RESULT_GROUP_POINTS_H

#include <CGAL/Tandem/internal/backend/Host_memory.h>
#include <CGAL/Tandem/internal/backend/buffers.h>
#include <CGAL/Tandem/internal/backend/Stage_overrides.h>
#include <CGAL/Tandem/internal/result/Engine_result.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// For n labels in memory of the host; labels outside of [0, shapes) are left out. A stable counting sort in a few large
// pieces, so that points ascend in each shape. A piece has at least as many points as there are shapes: all counts
// together need at most n entries.
template <class Backend>
Point_groups group_points(Backend& backend, const std::int32_t* shape_of, std::size_t n, std::size_t shapes)
{
  static_assert(std::is_base_of<Host_memory, Backend>::value, "a device has to replace this stage");
  const std::size_t grain = (std::max)({n / 64 + 1, shapes, std::size_t(1) << 16});
  std::vector<std::vector<std::size_t>> place((n + grain - 1) / grain);
  const auto for_each_point = [&](auto f) {
    backend.for_each_piece(n, grain, [&](std::size_t first, std::size_t last) {
      std::vector<std::size_t>& own = place[first / grain];
      own.resize(shapes, 0);
      for(std::size_t i = first; i < last; ++i)
        if(shape_of[i] >= 0 && std::size_t(shape_of[i]) < shapes)
          f(own[std::size_t(shape_of[i])], i);
    });
  };
  // First the points of each shape in each piece; the sums then become the places where a piece begins to write.
  for_each_point([](std::size_t& count, std::size_t) { ++count; });
  Point_groups groups;
  std::size_t next = 0;
  for(std::size_t s = 0; s < shapes; ++s) {
    groups.first.push_back(next);
    for(std::vector<std::size_t>& own : place)
      next += std::exchange(own[s], next);
  }
  groups.first.push_back(next);
  Host_buffer<std::uint32_t> position(next);
  for_each_point([&](std::size_t& to, std::size_t i) { position[to++] = std::uint32_t(i); });
  groups.position = std::move(position);
  return groups;
}

// Shapes of points and points of shapes move to the result. The buffer is consumed: its memory becomes the table of the
// result where it can.
template <class Backend>
void take_points(Backend& backend, Buffer_of<Backend, std::int32_t>&& shape_of, std::size_t shapes,
                 Engine_result& result)
{
  if constexpr(Stage_overrides<Backend>::groups_points)
    Stage_overrides<Backend>::group_points(backend, std::move(shape_of), shapes, result);
  else {
    result.points = group_points(backend, shape_of.data(), shape_of.size(), shapes);
    result.shape_of = Shared_table<std::int32_t>(std::move(shape_of));
  }
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_RESULT_GROUP_POINTS_H
