// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stages that a back end may replace. All others have the same source for every back end.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_STAGE_OVERRIDES_H
#define CGAL_TANDEM_INTERNAL_BACKEND_STAGE_OVERRIDES_H

namespace CGAL::Tandem::internal {

// A specialization of Stage_overrides inherits from this and sets the flags of the stages that it replaces. For each it
// has a static function, with the name, parameters and result that are given here. What a stage returns is defined
// without reference to how it is computed, so all back ends return the same bits. The specialization stands in the
// header of the back end, since it must be seen before the engine is instantiated.
struct No_stage_overrides {
  // Buffer<Grid_point> import_points(Backend&, Import&)
  // The caller's points on the grid, in their order. Generic form: engine/connect_cloud.h.
  static constexpr bool imports_points = false;

  // void expect_cells(Backend&, const Buffer<Range>& cells)
  // Most loops will be over these cells. Only a hint for the order of cells: the generic form does nothing.
  static constexpr bool expects_cells = false;

  // void find_neighbors(Backend&, const Grid_point* point, std::uint32_t n, int k, std::uint32_t* out)
  // The k smallest (squared distance, index) of each point. Generic form: neighbors/find_neighbors.h. It needs host
  // memory, so a device has to replace it.
  static constexpr bool finds_neighbors = false;

  // void group_points(Backend&, Buffer<std::int32_t>&& shape_of, std::size_t shapes, Engine_result& result)
  // Fills the shape of each point and the points of each shape. Generic form: result/group_points.h. It needs host
  // memory, so a device has to replace it.
  static constexpr bool groups_points = false;
};

template <class Backend>
struct Stage_overrides : No_stage_overrides {};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BACKEND_STAGE_OVERRIDES_H
