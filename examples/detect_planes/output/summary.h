// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run did, as a table for people.

#ifndef DETECT_PLANES_SUMMARY_H
#define DETECT_PLANES_SUMMARY_H

#include "output/free_points.h"
#include "output/report.h"
#include "messages.h"

#include <algorithm>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>

namespace program {

// The points that cannot be in shapes.
inline void write_left_out(std::ostream& out, const CGAL::Tandem::Statistics& s, const Run& run)
{
  const std::pair<std::size_t, const char*> causes[] = {{not_finite_points(s, run), "not finite"},
                                                        {run.zeros, "at 0 0 0"},
                                                        {s.number_of_ignored_normals, "without a normal"},
                                                        {s.number_of_ignored_tolerances, "without a tolerance"},
                                                        {s.number_of_far_points, "too far away"}};
  const char* before = "; ignored: ";
  for(const auto& [count, cause] : causes) {
    if(count > 0)
      out << std::exchange(before, ", ") << count << ' ' << cause;
  }
}

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
  write_left_out(out, s, run);
  out << '\n';
  for(const auto& [word, text] : run.notes) {
    write_visible(row(word.c_str()), text);
    out << '\n';
  }
  row("parameters") << "maximum distance " << p.maximum_distance
                    << (run.tolerance.source == "estimated" ? " (estimated)" : "") << ", angle " << p.maximum_angle;
  if(run.planes_from.empty())
    out << ", angle tolerance " << p.angle_tolerance << ", offset " << p.maximum_offset << ", at least "
        << p.minimum_region_size << " points";
  out << '\n';
  if(!run.tolerance.note.empty())
    row("estimate") << run.tolerance.note << '\n';
  if(run.tolerance.is_of_each_point) {
    row("tolerances") << run.tolerance.smallest << " to " << run.tolerance.largest << ", by ";
    write_visible(out, run.tolerance.source);
    out << '\n';
  }
  if(!run.planes_from.empty()) {
    write_visible(row("known") << "planes of ", run.planes_from);
    out << ", not detected: points are within the tolerances, but shapes need not be connected\n";
  }
  if(!run.selection.empty()) {
    row("selection") << s.number_of_shapes << " of " << run.detected_shapes << " shapes, with "
                     << s.number_of_assigned_points << " of " << run.detected_points << " points (";
    write_visible(out, run.selection);
    out << ")\n";
  }
  row("shapes") << s.number_of_shapes << " in " << s.number_of_planes << " planes of " << s.number_of_directions
                << " directions, " << s.number_of_orthogonal_pairs << " orthogonal pairs of directions\n";
  row("quality") << "coverage " << 100 * s.coverage << " %, mean distance " << s.mean_distance << ", complexity "
                 << s.complexity << '\n';
  if(run.planes_from.empty())
    row("free") << free_text(s) << '\n';
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
