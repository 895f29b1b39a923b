// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_BUILT_WITH_H
#define DETECT_PLANES_BUILT_WITH_H

#include <string>
#include <vector>

namespace program {

// The parts that may be missing in a build. Its help does not offer what needs them.
struct Built_with {
  bool tbb = true, cuda = true, mpi = true, gzip = true, laszip = true, view = true;
  bool kinetic_mesh = true, polygonal_mesh = true, mesh_seconds = true;
  std::string mesh_planes = "..."; // how many the methods take

  bool mesh() const { return kinetic_mesh || polygonal_mesh; }

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
    std::vector<std::string> names;
    if(kinetic_mesh)
      names.emplace_back("kinetic");
    if(polygonal_mesh)
      names.emplace_back("polygonal");
    return names;
  }
};

// Of this program.
Built_with built_with();

} // namespace program

#endif // DETECT_PLANES_BUILT_WITH_H
