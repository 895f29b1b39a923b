// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run did, as a table for people.

#ifndef DETECT_PLANES_SUMMARY_H
#define DETECT_PLANES_SUMMARY_H

#include "output/report.h"
#include "messages.h"

#include <algorithm>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>

namespace program {

inline std::string summary(const Shapes& shapes, const Run& run)
{
  std::ostringstream out;
  const CGAL::Tandem::Statistics& s = shapes.statistics();
  const CGAL::Tandem::Parameters& p = shapes.parameters();
  const auto row = [&out](const char* name) -> std::ostream& {
    return out << "  " << std::left << std::setw(12) << name;
  };
  write_visible(out, run.short_input);
  out << '\n' << std::setprecision(4);
  row("points") << s.number_of_points << ", normals " << run.normals;
  if(s.number_of_ignored_points() > 0)
    out << "; ignored: " << s.number_of_ignored_coordinates << " not finite, " << s.number_of_ignored_normals
        << " without a normal";
  out << '\n';
  for(const auto& [word, text] : run.notes) {
    write_visible(row(word.c_str()), text);
    out << '\n';
  }
  row("parameters") << "maximum distance " << p.maximum_distance << ", angle " << p.maximum_angle
                    << ", angle tolerance " << p.angle_tolerance << ", offset " << p.maximum_offset << ", at least "
                    << p.minimum_region_size << " points\n";
  row("shapes") << s.number_of_shapes << " in " << s.number_of_planes << " planes of " << s.number_of_directions
                << " directions, " << s.number_of_orthogonal_pairs << " orthogonal pairs of directions\n";
  row("quality") << "coverage " << 100 * s.coverage << " %, mean distance " << s.mean_distance << ", complexity "
                 << s.complexity << '\n';
  row("seconds") << s.times.total + run.normal_seconds << " (normals " << s.times.normals + run.normal_seconds
                 << ", sort " << s.times.sort << ", neighbors " << s.times.neighbors << ", growth " << s.times.growth
                 << ", regularity " << s.times.regularity << ", final " << s.times.finish << "), reading "
                 << run.read_seconds << '\n';
  row("execution") << s.backend << ", " << (run.ranks == 1 ? "" : std::to_string(run.ranks) + " processes of ")
                   << run.threads << (run.threads == 1 ? " thread, " : " threads, ") << s.number_of_rounds
                   << " rounds, " << (std::max)(run.peak_bytes, peak_process_bytes()) / 1048576 << " MiB\n";
  if(!run.mesh.empty())
    row("mesh") << run.mesh << '\n';
  row("hash") << hash_text(run) << '\n';
  return out.str();
}

} // namespace program

#endif // DETECT_PLANES_SUMMARY_H
