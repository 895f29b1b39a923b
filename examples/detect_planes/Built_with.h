// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts that may be missing in a build. CMake finds out which there are.

#ifndef DETECT_PLANES_BUILT_WITH_H
#define DETECT_PLANES_BUILT_WITH_H

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
constexpr bool has_mpi_cuda = has_part(" mpi_cuda ");

// What a program was built with. Its help does not offer what needs the rest.
struct Built_with {
  bool tbb = true, cuda = true, mpi = true, gzip = true, laszip = true, view = true;

  std::vector<std::string> backends() const
  {
    std::vector<std::string> names = {"auto", "sequential"};
    if(tbb)
      names.emplace_back("parallel");
    if(cuda)
      names.emplace_back("cuda");
    return names;
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
  return built;
}

} // namespace program

#endif // DETECT_PLANES_BUILT_WITH_H
