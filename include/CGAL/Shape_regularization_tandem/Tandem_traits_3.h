// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TANDEM_TRAITS_3_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TANDEM_TRAITS_3_H

#include <CGAL/Shape_regularization_tandem/internal/Execution_of.h>

#include <CGAL/Default.h>
#include <CGAL/number_utils.h>

#include <type_traits>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemTraits

\brief The kernel, the range with its maps, and what executes.

\tparam GeomTraits a model of `Kernel`
\tparam PointRange a model of `ConstRange` whose iterators are random access
\tparam PointMap a model of `ReadablePropertyMap` from the value type of `PointRange` to `GeomTraits::Point_3`
\tparam NormalMap a model of `ReadablePropertyMap` from the value type of `PointRange` to `GeomTraits::Vector_3`,
or `CGAL::Default` if the normals are to be estimated
\tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag`, `CGAL::Parallel_if_available_tag`, `Cuda_tag`,
`Cuda_if_available_tag` or `Mpi_tag`

\cgalModels `TandemTraits_3`
*/
template <class GeomTraits, class PointRange, class PointMap, class NormalMap = CGAL::Default,
          class ConcurrencyTag = CGAL::Parallel_if_available_tag>
class Tandem_traits_3 {
public:
#ifdef DOXYGEN_RUNNING
  /*!
  With `Mpi_tag`, the constructor duplicates the communicator, so that messages of the library are not mixed with those
  of the caller: every process of the communicator must call it. With other tags there is no such argument.

  \throw std::logic_error MPI is not initialized
  */
  explicit Tandem_traits_3(const GeomTraits& geom_traits = GeomTraits(),
                           const boost::mpi::communicator& communicator = boost::mpi::communicator());
#else
  using Geom_traits = GeomTraits;
  using Point_range = PointRange;
  using Point_map = PointMap;
  using Normal_map = NormalMap;
  using Execution = internal::Execution_of<ConcurrencyTag>;
  using Backend = typename Execution::Backend;

  using FT = typename GeomTraits::FT;
  using Point_3 = typename GeomTraits::Point_3;
  using Vector_3 = typename GeomTraits::Vector_3;
  using Plane_3 = typename GeomTraits::Plane_3;

  using Compute_x_3 = typename GeomTraits::Compute_x_3;
  using Compute_y_3 = typename GeomTraits::Compute_y_3;
  using Compute_z_3 = typename GeomTraits::Compute_z_3;
  using Construct_plane_3 = typename GeomTraits::Construct_plane_3;

  static constexpr bool has_normal_map = !std::is_same<NormalMap, CGAL::Default>::value;

  explicit Tandem_traits_3(const GeomTraits& geom_traits = GeomTraits(), const Execution& execution = Execution())
    : geom_traits_(geom_traits), execution_(execution)
  {}

  Compute_x_3 compute_x_3_object() const { return geom_traits_.compute_x_3_object(); }
  Compute_y_3 compute_y_3_object() const { return geom_traits_.compute_y_3_object(); }
  Compute_z_3 compute_z_3_object() const { return geom_traits_.compute_z_3_object(); }
  Construct_plane_3 construct_plane_3_object() const { return geom_traits_.construct_plane_3_object(); }
  const GeomTraits& geom_traits() const { return geom_traits_; }
  Backend backend() const { return execution_.backend(); }
#endif

private:
  GeomTraits geom_traits_;
  Execution execution_;
};

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TANDEM_TRAITS_3_H
