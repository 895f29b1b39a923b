// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_SELECT_SHAPES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_SELECT_SHAPES_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/internal/relabel_shapes.h>
#include <CGAL/Tandem/Parameters.h>

#include <cstddef>
#include <stdexcept>
#include <vector>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief returns a result that has only the shapes with these indices.

Shape i of the result is the shape of the i-th index, so the order is that of the indices. Points of other shapes have
no shape, and count as `Free_points::unselected`. Planes, and the relations of the shapes that are left, are the same;
groups are numbered again, and numbers of shapes, relations and points are counted again. So `is_valid_result()` returns
`true`, and all functions on results can be used. Some measures remain those of the detection:
`Statistics::mean_distance`, the other numbers of `Statistics::free_points`, `Statistics::times` and, where shapes are
left out, `Statistics::score`.

With `Mpi_tag`, each process calls it for its own result, with the
same indices.

\param shapes the result of a detection
\param indices a range of integers, in any order; an empty range gives a result without shapes

\throw std::invalid_argument an index is not that of a shape, or occurs twice
*/
template <class GeomTraits, class IndexRange>
Planar_shapes_3<GeomTraits> select_shapes(const Planar_shapes_3<GeomTraits>& shapes, const IndexRange& indices)
{
  std::vector<std::size_t> source;
  std::vector<int> number(shapes.number_of_shapes(), -1); // in the result, by shape
  for(const auto& index : indices) {
    const std::size_t s = std::size_t(index); // negative ones become too large
    if(s >= number.size())
      throw std::invalid_argument("There is no shape " + internal::to_text(index) + ": the result has " +
                                  internal::to_text(number.size()) + " shapes, from 0 on.");
    if(number[s] >= 0)
      throw std::invalid_argument("Shape " + internal::to_text(s) + " is selected twice.");
    number[s] = int(source.size());
    source.push_back(s);
  }
  return Planar_shapes_3<GeomTraits>(internal::relabel_shapes(shapes.data(), source, number));
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_SELECT_SHAPES_H
