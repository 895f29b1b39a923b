// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What detect_planes --view needs to show a cloud of the comparison: FOLDER/CLOUD.ply, and FOLDER/CLOUD.options, a line
// with the task as its options.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_VIEW_FILES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_VIEW_FILES_H

#include "contestants/Contestant.h"

#include <iomanip>

namespace CGAL {
namespace Tandem {
namespace benchmark {

inline std::string program_options(const Task& t)
{
  std::ostringstream line;
  line << std::setprecision(17) << "--maximum-distance " << t.maximum_distance << " --maximum-angle "
       << t.maximum_angle_deg << " --angle-tolerance " << t.angle_tolerance_deg << " --maximum-offset " << t.offset()
       << " --minimum-region-size " << t.minimum_region_size << " --k-neighbors " << t.k_neighbors << " --cell-size "
       << t.cell_size;
  if(t.threads > 0)
    line << " --threads " << t.threads;
  return line.str();
}

// The normals are those that all contestants get.
inline void write_view_files(const std::string& folder, const std::string& name, const Ply_cloud& cloud, const Task& t)
{
  const std::string stem = folder + "/" + name;
  write_ply(stem + ".ply", {cloud.points, cloud.normals, {}, cloud.is_double});
  std::ofstream out(stem + ".options");
  out << program_options(t) << "\n";
  out.close();
  if(!out)
    throw std::runtime_error(stem + ".options: cannot be written");
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_VIEW_FILES_H
