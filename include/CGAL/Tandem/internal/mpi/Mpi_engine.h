// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engine over many processes: points go to the ranks of their leaves, the engine runs there, and labels come back.

#ifndef CGAL_TANDEM_INTERNAL_MPI_MPI_ENGINE_H
#define CGAL_TANDEM_INTERNAL_MPI_MPI_ENGINE_H

#include <CGAL/Tandem/internal/mpi/Distribution.h>
#include <CGAL/Tandem/internal/mpi/Mpi_ranks.h>
#include <CGAL/Tandem/internal/mpi/mpi_api.h>

#include <CGAL/Tandem/internal/engine/Engine.h>
#include <CGAL/Tandem/internal/engine/first_unconnected.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Each function is called by all ranks.
template <class Local>
class Mpi_engine : public Detection_engine {
  using Backend = Mpi_backend<Local>;
  using Host = Mpi_backend<Search_host<Local>>;

public:
  Mpi_engine(Host& host, Import& in, const Parameters& parameters, Progress& progress)
    : host_(host), distribution_(host_, in, parameters.cell_size), in_(take(distribution_, in)),
      backend_(host.shared_communicator()), engine_(backend_, in_, parameters, progress)
  {}

  const char* name() const override { return engine_.name(); }
  bool iterate() override { return engine_.iterate(); }
  void finish() override { engine_.finish(); }

  Engine_result result() override
  {
    Engine_result r = engine_.result();
    if(host_.communicator().sum(std::uint64_t(r.shape_of.size())) == 0)
      return r; // cancelled before the first round
    r.shape_of = distribution_.collect(r.shape_of);
    if(!in_.has_normals)
      r.normal = distribution_.collect(r.normal);
    r.points = group_points(host_, r.shape_of.data(), r.shape_of.size(), r.shapes.size());
    return r;
  }

private:
  // The caller's import keeps its numbers of points.
  static Import take(Distribution<Search_host<Local>>& distribution, Import& in)
  {
    Import own = distribution.distribute(in);
    in.coordinates = Vector_table();
    in.normals = Vector_table();
    return own;
  }

  Host& host_;
  Distribution<Search_host<Local>> distribution_;
  Import in_; // the points of this rank
  Backend backend_;
  Engine<Backend> engine_;
};

template <class Local>
std::unique_ptr<Detection_engine> make_engine(Mpi_backend<Local>& backend, Import& in, const Parameters& parameters,
                                              Progress& progress)
{
  return std::make_unique<Mpi_engine<Local>>(backend, in, parameters, progress);
}

// Connectivity is checked on the points of each rank and their ghosts.
template <class Local>
std::size_t first_unconnected(Mpi_backend<Local>& backend, Import& in, const Labeled_points& result)
{
  if(in.total.points == 0)
    return result.shapes();
  Distribution<Local> distribution(backend, in, result.parameters.cell_size);
  Import own = distribution.distribute(in);
  Labeled_points of_own = {result.parameters, result.planes, {}, {}};
  of_own.shape = distribution.distribute_values([&](std::size_t i) { return result.shape[i]; });
  if(!in.has_normals)
    of_own.normal = distribution.distribute_values([&](std::size_t i) { return result.normal[i]; });
  return first_unconnected_here(backend, own, of_own);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_MPI_ENGINE_H
