// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts that may be missing in a build. CMake finds out which there are.

#ifndef DETECT_PLANES_BUILT_WITH_H
#define DETECT_PLANES_BUILT_WITH_H

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#ifndef DETECT_PLANES_PARTS // what compiles some of the sources only has none
#define DETECT_PLANES_PARTS ""
#endif

namespace program {

constexpr bool has_part(std::string_view name)
{
  return std::string_view(" " DETECT_PLANES_PARTS " ").find(name) != std::string_view::npos;
}

constexpr bool has_tbb = has_part(" tbb "), has_cuda = has_part(" cuda "), has_gzip = has_part(" gzip ");
constexpr bool has_laszip = has_part(" laszip "), has_view = has_part(" view "), has_mpi = has_part(" mpi ");
constexpr bool has_mpi_cuda = has_part(" mpi_cuda "), has_kinetic_mesh = has_part(" kinetic ");
constexpr bool has_polygonal_mesh = has_part(" polygonal "), has_time_limit = has_part(" time_limit ");

// A method of --mesh, with its numbers of planes: more take minutes, and those not even Ctrl-C ends soon.
struct Mesh_method {
  const char* name;
  std::size_t by_default, on_demand;
  bool is_built;
  const char* needs;
};
constexpr Mesh_method cells_method = {"cells", 200, 1000, true, ""};
constexpr Mesh_method kinetic_method = {"kinetic", 100, 1000, has_kinetic_mesh, "CGAL 6 and Eigen 3"};
constexpr Mesh_method polygonal_method = {"polygonal", 16, 60, has_polygonal_mesh,
                                          "Eigen 3, and the solver GLPK or SCIP"};

inline std::string limits_of(const Mesh_method& method)
{
  return std::string("the method ") + method.name + " takes " + std::to_string(method.by_default) +
         " by default, and up to " + std::to_string(method.on_demand) + " by --mesh-planes";
}

// What a program was built with. Its help does not offer what needs the rest.
struct Built_with {
  bool tbb = true, cuda = true, mpi = true, gzip = true, laszip = true, view = true;
  bool kinetic_mesh = true, polygonal_mesh = true, mesh_seconds = true;

  std::vector<std::string> backends() const
  {
    std::vector<std::string> names = {"auto", "sequential"};
    if(tbb)
      names.emplace_back("parallel");
    if(cuda)
      names.emplace_back("cuda");
    return names;
  }

  std::vector<std::string> mesh_methods() const
  {
    std::vector<std::string> names = {cells_method.name};
    if(kinetic_mesh)
      names.emplace_back(kinetic_method.name);
    if(polygonal_mesh)
      names.emplace_back(polygonal_method.name);
    return names;
  }

  // How many planes the methods take.
  std::string mesh_planes() const
  {
    return limits_of(cells_method) + (kinetic_mesh ? "; " + limits_of(kinetic_method) : "") +
           (polygonal_mesh ? "; " + limits_of(polygonal_method) : "");
  }
};

// Of this program.
inline Built_with built_with()
{
  Built_with built;
  built.tbb = has_tbb;
  built.cuda = has_cuda;
  built.mpi = has_mpi;
  built.gzip = has_gzip;
  built.laszip = has_laszip;
  built.view = has_view;
  built.kinetic_mesh = has_kinetic_mesh;
  built.polygonal_mesh = has_polygonal_mesh;
  built.mesh_seconds = has_time_limit;
  return built;
}

} // namespace program

#endif // DETECT_PLANES_BUILT_WITH_H
