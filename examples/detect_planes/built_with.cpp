// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Built_with.h"

#include "mesh/mesh_methods.h"
#include "mesh/write_mesh.h"
#include "ranks/Ranks.h"
#include "view/write_view.h"

namespace program {

Built_with built_with()
{
  Built_with built;
#ifndef CGAL_LINKED_WITH_TBB
  built.tbb = false;
#endif
#ifndef CGAL_TANDEM_USE_CUDA
  built.cuda = false;
#endif
#ifndef DETECT_PLANES_WITH_ZLIB
  built.gzip = false;
#endif
#ifndef DETECT_PLANES_WITH_LASZIP
  built.laszip = false;
#endif
  built.mpi = has_mpi();
  built.view = has_view();
  built.kinetic_mesh = missing_for_kinetic_mesh().empty();
  built.polygonal_mesh = missing_for_polygonal_mesh().empty();
  built.mesh_seconds = has_time_limit();
  built.mesh_planes = limits_of_planes();
  return built;
}

} // namespace program
