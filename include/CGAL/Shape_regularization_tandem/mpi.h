// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MPI_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MPI_H

#ifndef CGAL_TANDEM_USE_MPI
#error "Mpi_tag needs the library Tandem::tandem_mpi: link it (it defines CGAL_TANDEM_USE_MPI)"
#endif

#include <CGAL/Shape_regularization_tandem/Tandem_traits_3.h>
#include <CGAL/Tandem/internal/mpi/Mpi_ranks.h>
#include <CGAL/Tandem/internal/mpi/mpi_api.h>

#include <memory>
#include <type_traits>

namespace CGAL {
namespace Tandem {

namespace internal {

template <class Tag>
struct Backend_of<Mpi_tag<Tag>> {
  static_assert(!std::is_same<Tag, Cuda_tag>::value,
                "Mpi_tag<Cuda_tag> needs the CUDA back end of many processes: link Tandem::tandem_mpi_cuda");
  using type = Mpi_backend<typename Backend_of<Tag>::type>;
};

#ifdef CGAL_TANDEM_USE_MPI_CUDA
template <>
struct Execution_of<Mpi_tag<Cuda_tag>> : Execution_on<Mpi_backend<Parallel_host>> {
  static std::unique_ptr<Detection_engine> start(Backend& backend, Import& in, const Parameters& parameters,
                                                 Progress& progress)
  {
    return make_cuda_engine(backend, in, parameters, progress);
  }
};
#endif

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemTraits

\brief The traits of many processes: the same geometry, while each process has a part of the points.

\cgalModels `TandemTraits_3`
*/
template <class GeomTraits, class PointRange, class PointMap, class NormalMap, class ExecutionTag>
class Tandem_traits_3<GeomTraits, PointRange, PointMap, NormalMap, Mpi_tag<ExecutionTag>>
  : public internal::Tandem_geometry_3<GeomTraits, PointRange, PointMap, NormalMap> {
  using Geometry = internal::Tandem_geometry_3<GeomTraits, PointRange, PointMap, NormalMap>;

public:
  /// the processes of a communicator
  using Concurrency_tag = Mpi_tag<ExecutionTag>;
  /// executes what is to be done at the border to the caller
  using Backend = typename internal::Execution_of<Concurrency_tag>::Backend;
  /// executes the method, together with the other processes
  using Execution = internal::Execution_of<Concurrency_tag>;

  /*!
  duplicates the communicator, so that no message meets one of the caller. It is called by all of its processes.

  \throw std::logic_error MPI is not initialized
  */
  explicit Tandem_traits_3(const GeomTraits& geom_traits = GeomTraits(),
                           const boost::mpi::communicator& communicator = boost::mpi::communicator())
    : Geometry(geom_traits), communicator_(std::make_shared<internal::Communicator>(communicator))
  {}

  /// a new back end
  Backend backend() const { return Backend(communicator_); }

private:
  std::shared_ptr<internal::Communicator> communicator_;
};

/*!
\ingroup PkgShapeRegularizationTandemRef

calls `f()` on all processes of a communicator, for what may fail on some of them only, as the reading of files does.
Then all processes go on, or all throw what the first one of those that failed has thrown. On the others, exceptions of the
standard library keep their type, and other ones become `std::runtime_error`. So does `detect_planes()` with `Mpi_tag`.

\return what `f` returns
*/
template <class Function>
auto together(const boost::mpi::communicator& communicator, Function f)
{
  return internal::Communicator(communicator).together(f);
}

} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MPI_H
