// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shapes that the outputs have: all, or one for each plane, and of those the ones that fit the options of the selection.

#ifndef DETECT_PLANES_SELECTION_H
#define DETECT_PLANES_SELECTION_H

#include "Options.h"
#include "input/point_set.h"
#include "output/report.h"
#include "output/shape_areas.h"
#include "output/write_results.h"
#include "sentence.h"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace program {

// The options that say which shapes the outputs have.
inline std::string selection_of(const Options& o)
{
  std::ostringstream text;
  const auto add = [&text](const char* option, const auto& value) {
    if(value)
      write_shortest(text << option << ' ', *value, ' ');
  };
  text << (o.is_by_plane ? "--by-plane " : "");
  add("--largest", o.largest);
  add("--minimum-area", o.minimum_area);
  add("--minimum-extent", o.minimum_extent);
  if(o.near_direction)
    text << "--near-direction " << o.near_direction->text << ' ';
  return text.str().substr(0, (std::max)(text.str().size(), std::size_t(1)) - 1);
}

// Those of the shapes that fit: of the points of this rank and others, the same on all ranks.
Shapes selected_shapes(const Shapes& shapes, const Point_set& points, const Options& o);

// Notes in the run how many there were; a warning where none is left.
inline void select(const Point_set& points, const Options& o, Run& run, Shapes& shapes,
                   std::vector<std::string>& warnings)
{
  run.selection = selection_of(o);
  if(run.selection.empty())
    return;
  run.detected_shapes = shapes.number_of_shapes();
  run.detected_points = shapes.statistics().number_of_assigned_points;
  if(o.is_by_plane)
    shapes = joined_shapes(points, shapes);
  shapes = selected_shapes(shapes, points, o);
  if(shapes.number_of_shapes() == 0 && run.detected_shapes > 0)
    warnings.push_back(
      sentence("none of the ", run.detected_shapes, " shapes fits ", run.selection, ": the outputs have none"));
}

} // namespace program

#endif // DETECT_PLANES_SELECTION_H
