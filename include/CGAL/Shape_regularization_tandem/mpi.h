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

namespace CGAL::Tandem {

namespace internal {

// The method on all ranks of a communicator, which is duplicated, so that no message meets one of the caller.
template <class Local>
class Execution_on_ranks : public Execution_on<Mpi_backend<Local>> {
public:
  Execution_on_ranks(const boost::mpi::communicator& communicator = boost::mpi::communicator())
    : communicator_(std::make_shared<Communicator>(communicator))
  {}

  Mpi_backend<Local> backend() const { return Mpi_backend<Local>(communicator_); }

private:
  std::shared_ptr<Communicator> communicator_;
};

template <class Tag>
struct Execution_of<Mpi_tag<Tag>> : Execution_on_ranks<typename Backend_of<Tag>::type> {
  static_assert(!std::is_same<Tag, Cuda_tag>::value,
                "Mpi_tag<Cuda_tag> needs the CUDA back end of many processes: link Tandem::tandem_mpi_cuda");
  using Execution_on_ranks<typename Backend_of<Tag>::type>::Execution_on_ranks;
};

#ifdef CGAL_TANDEM_USE_MPI_CUDA
template <>
struct Execution_of<Mpi_tag<Cuda_tag>> : Execution_on_ranks<Parallel_host> {
  using Execution_on_ranks<Parallel_host>::Execution_on_ranks;

  static std::unique_ptr<Detection_engine> start(Backend& backend, Import& in, const Parameters& parameters,
                                                 Progress& progress)
  {
    return make_cuda_engine(backend, in, parameters, progress);
  }
};
#endif

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemRef

calls `f()` on all processes of a communicator. Use it for work that may fail on some of them only, such as reading
files. If `f()` throws on some processes, all processes throw the exception of the first of these. On the others,
`Parameter_error`, `std::invalid_argument`, `std::length_error`, `std::range_error`, `std::logic_error` and
`std::bad_alloc` keep their type, and other ones become `std::runtime_error`. `detect_planes()` with `Mpi_tag` does the
same.

\return what `f` returns
*/
template <class Function>
auto together(const boost::mpi::communicator& communicator, Function f)
{
  return internal::Communicator(communicator).together(f);
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MPI_H
