// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the library Tandem::tandem_mpi has compiled; see engine/compiled_engine.h.

#ifndef CGAL_TANDEM_INTERNAL_MPI_COMPILED_MPI_ENGINE_H
#define CGAL_TANDEM_INTERNAL_MPI_COMPILED_MPI_ENGINE_H

#include <CGAL/Tandem/internal/base/Progress.h>
#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/finish/Engine_result.h>
#include <CGAL/Tandem/internal/mpi/Mpi_backend.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

template <class Local>
class Mpi_engine;

// Mpi_engine<Local> of the library.
template <class Local>
class Compiled_mpi_engine {
public:
  using Upload = No_upload;

  Compiled_mpi_engine(Mpi_backend<Local>& backend, Import& in, const Parameters& parameters, Progress& progress);
  ~Compiled_mpi_engine();

  static const char* name() { return Mpi_backend<Local>::name(); }
  bool iterate();
  void finish();
  Engine_result result();

private:
  std::unique_ptr<Mpi_engine<Local>> engine_;
};

// The one of engine/first_unconnected.h for a result over many ranks, in the library as well.
template <class Local>
std::size_t first_unconnected(Mpi_backend<Local>& backend, const Import& in, const std::vector<std::int32_t>& labels,
                              std::size_t k, std::size_t shapes);

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_COMPILED_MPI_ENGINE_H
