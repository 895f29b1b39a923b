// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The back end of many processes: that of one process, and a communicator. Loops over surfels and cells are over those
// of the rank; what goes on between ranks is in Mpi_ranks.h.

#ifndef CGAL_TANDEM_INTERNAL_MPI_MPI_BACKEND_H
#define CGAL_TANDEM_INTERNAL_MPI_MPI_BACKEND_H

#include <CGAL/Tandem/internal/backend/Parallel_host.h>
#include <CGAL/Tandem/internal/backend/Stage_overrides.h>
#include <CGAL/Tandem/internal/mpi/messages/Communicator.h>

#include <memory>
#include <type_traits>
#include <utility>

namespace CGAL::Tandem::internal {

template <class Local>
class Mpi_backend : public Local {
public:
  explicit Mpi_backend(std::shared_ptr<Communicator> communicator) : communicator_(std::move(communicator)) {}

  Communicator& communicator() const { return *communicator_; }
  const std::shared_ptr<Communicator>& shared_communicator() const { return communicator_; }

private:
  std::shared_ptr<Communicator> communicator_;
};

// A rank replaces the stages that its device replaces.
template <class Local>
struct Stage_overrides<Mpi_backend<Local>> : Stage_overrides<Local> {};

// What executes on the host of a rank: a device has no memory of the host.
template <class Local>
using Search_host = typename std::conditional<std::is_base_of<Host_memory, Local>::value, Local, Parallel_host>::type;

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_MPI_MPI_BACKEND_H
