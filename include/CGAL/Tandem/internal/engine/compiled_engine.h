// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the library Tandem::tandem_engine has compiled: all of the method that does not depend on kernel and range.
// Programs that link it have CGAL_TANDEM_USE_ENGINE defined, and include this instead of the headers of the method.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_COMPILED_ENGINE_H
#define CGAL_TANDEM_INTERNAL_ENGINE_COMPILED_ENGINE_H

#include <CGAL/Shape_regularization_tandem/Plane_relations.h>
#include <CGAL/Tandem/internal/base/Progress.h>
#include <CGAL/Tandem/internal/cloud/import_cloud.h>
#include <CGAL/Tandem/internal/finish/Shapes_data.h>
#include <CGAL/Tandem/internal/regularity/relations.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

template <class Backend>
class Engine;

// Engine<Backend> of the library.
template <class Backend>
class Compiled_engine {
public:
  using Upload = No_upload;

  Compiled_engine(Backend& backend, Import& in, const Parameters& parameters, Progress& progress);
  ~Compiled_engine();
  Compiled_engine(const Compiled_engine&) = delete;
  Compiled_engine& operator=(const Compiled_engine&) = delete;

  static const char* name() { return Backend::name(); }

  bool iterate();
  void finish();
  Engine_result result();

private:
  std::unique_ptr<Engine<Backend>> engine_;
};

// For the back ends of the host.

template <class Backend>
void complete_parameters(Backend& backend, const Import& in, bool has_offset, Parameters& p);

template <class Backend>
void set_scale(Backend& backend, Import& in, bool has_offset, Parameters& p);

template <class Backend>
void find_neighbors(Backend& backend, const Grid_point* point, std::uint32_t n, int k, std::uint32_t* neighbor);

template <class Backend>
Shapes_data export_shapes(Backend& backend, const Import& in, const Parameters& parameters,
                          const Engine_result& result);

template <class Backend>
Point_groups group_points(Backend& backend, const std::int32_t* shape_of, std::size_t n, std::size_t shapes);

template <class Backend>
Plane_relations relate_planes(Backend& backend, Import& in, const std::vector<int>& plane_of,
                              Regularity_options options, std::vector<Coefficients>& planes);

// For the number types of Item_reader.

extern template void start_import<float>(Import&, std::size_t, bool);
extern template void start_import<double>(Import&, std::size_t, bool);
extern template bool inspect_points(const Values<float>&, std::size_t, Coordinate_box&);
extern template bool inspect_points(const Values<double>&, std::size_t, Coordinate_box&);
extern template void drop_invalid<float>(Import&);
extern template void drop_invalid<double>(Import&);

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ENGINE_COMPILED_ENGINE_H
