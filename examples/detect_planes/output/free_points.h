// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Why points are in no shape, in words, and the option that would change it.

#ifndef DETECT_PLANES_FREE_POINTS_H
#define DETECT_PLANES_FREE_POINTS_H

#include <CGAL/Tandem/Statistics.h>

#include <algorithm>
#include <cstddef>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

namespace program {

struct Free_reason {
  std::size_t points;
  const char* name;   // they are ...
  const char* advice; // what to change
};

// Those that points have, the most frequent first.
inline std::vector<Free_reason> free_reasons(const CGAL::Tandem::Free_points& f)
{
  std::vector<Free_reason> reasons = {
    {f.without_normal, "without a normal",
     "their neighbors are on a line, or --maximum-distance is larger than what is there: a larger --k-neighbors, or a "
     "smaller distance"},
    {f.misfit, "just beyond the tolerances of a shape",
     "a larger --maximum-distance or --maximum-angle takes more of them"},
    {f.without_neighbors, "alone",
     "they are outliers, or --maximum-distance or --maximum-angle is too small for their noise"},
    {f.in_small_regions, "in small regions", "a smaller --minimum-region-size takes more of them"},
    {f.clutter, "in clutter",
     "they are on no surface, or --maximum-distance or --maximum-angle is too small for their noise"},
    {f.unselected, "of shapes that were not selected", "the options of the selection leave them out"}};
  std::stable_sort(reasons.begin(), reasons.end(),
                   [](const Free_reason& a, const Free_reason& b) { return a.points > b.points; });
  while(!reasons.empty() && reasons.back().points == 0)
    reasons.pop_back();
  return reasons;
}

// The shares of all points, and what to change for the largest one.
inline std::string free_text(const CGAL::Tandem::Statistics& s)
{
  std::ostringstream text;
  text << std::setprecision(3);
  const auto percent = [&](std::size_t points) { return 100 * double(points) / double(s.number_of_points); };
  const std::vector<Free_reason> reasons = free_reasons(s.free_points);
  if(reasons.empty())
    return "none";
  text << percent(s.free_points.total()) << " %: ";
  for(const Free_reason& r : reasons)
    text << (&r == reasons.data() ? "" : ", ") << percent(r.points) << " % " << r.name;
  text << "; " << reasons[0].advice;
  return text.str();
}

} // namespace program

#endif // DETECT_PLANES_FREE_POINTS_H
