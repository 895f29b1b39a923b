// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the public headers call of the method, which does not depend on kernel and range. The library
// Tandem::tandem_engine has compiled the functions for the back ends of the host.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_ENGINE_API_H
#define CGAL_TANDEM_INTERNAL_ENGINE_ENGINE_API_H

#include <CGAL/Tandem/Plane_relations.h>
#include <CGAL/Tandem/internal/base/Progress.h>
#include <CGAL/Tandem/internal/base/tuning/growth.h>
#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/regularity/relations.h>
#include <CGAL/Tandem/internal/result/Engine_result.h>
#include <CGAL/Tandem/internal/result/Shapes_data.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace CGAL::Tandem::internal {

// --- What a detection knows of the engine that runs it: the same for all back ends, libraries and numbers of processes.

// One detection. The caller repeats iterate() until it is false, then calls finish(). The results of all engines are
// the same bits.
class Detection_engine {
public:
  Detection_engine() = default;
  Detection_engine(const Detection_engine&) = delete;
  Detection_engine& operator=(const Detection_engine&) = delete;
  virtual ~Detection_engine() = default;

  // The name of the back end that runs the method.
  virtual const char* name() const = 0;

  // Runs one round. Returns false when few points got a shape (tuning::loop), the rounds are used up, or the callback has
  // cancelled.
  virtual bool iterate() = 0;

  // Runs the end game. Afterwards result() is final and keeps the guarantees.
  virtual void finish() = 0;

  // What has been found so far, between rounds. Its points are checked, but its planes are not final.
  virtual Engine_result result() = 0;
};

// Prepares the first round. The back end, the import and the progress have to stay as long as the engine. What the
// callback throws passes through. Defined in Engine.h, and compiled once in the library Tandem::tandem_engine. Other
// libraries have functions of their own: see cuda/interface/cuda_api.h and mpi/mpi_api.h.
template <class Backend>
std::unique_ptr<Detection_engine> make_engine(Backend& backend, Import& in, const Parameters& parameters,
                                              Progress& progress);

// --- Functions of the method.

// Besides make_engine():

template <class Backend>
Distance_estimate complete_parameters(Backend& backend, const Import& in, bool has_offset, Parameters& p);

template <class Backend>
std::string set_scale(Backend& backend, Import& in, bool has_offset, Parameters& p);

template <class Backend>
void find_neighbors(Backend& backend, const Grid_point* point, std::uint32_t n, int k, std::uint32_t* neighbor);

template <class Backend>
Shapes_data export_shapes(Backend& backend, const Import& in, const Parameters& parameters,
                          const Engine_result& result);

template <class Backend>
Point_groups group_points(Backend& backend, const std::int32_t* shape_of, std::size_t n, std::size_t shapes);

template <class Backend>
Plane_relations relate_planes(Backend& backend, Import& in, const std::vector<int>& plane_of, Parameters p,
                              std::vector<Coefficients>& planes);

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ENGINE_ENGINE_API_H
