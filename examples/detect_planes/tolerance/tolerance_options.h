// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options of the command line that say how far points may be from their planes.

#ifndef DETECT_PLANES_TOLERANCE_OPTIONS_H
#define DETECT_PLANES_TOLERANCE_OPTIONS_H

#include "tolerance/Noise_model.h"
#include "Options.h"
#include "file_names.h"
#include "input/table_values.h"

#include <CGAL/Shape_regularization_tandem/distance_of_noise.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <optional>
#include <sstream>
#include <string>

namespace program {

namespace po = boost::program_options;

// The value of --maximum-distance.
inline void set_maximum_distance(const std::string& text, Options& o)
{
  o.has_local_distances = text == "auto-local";
  if(text == "auto" || text == "auto-local")
    return;
  o.maximum_distance = parse_number(text);
  if(!o.maximum_distance)
    throw Usage_error("--maximum-distance is '" + text + "', must be a number, auto or auto-local");
}

inline void add_tolerance_options(po::options_description& group, Options& o)
{
  std::ostringstream noise;
  noise.precision(3);
  noise
    << "the standard deviation of the noise along the ray, at the range r, the distance to the sensor, as in \"0.001 + "
       "0.0028*r^2\": "
       "the tolerance of each point is "
    << CGAL::Tandem::distance_of_noise(1)
    << " times that. The sensor is at --viewpoint, or at the VIEWPOINT of .pcd files, where it is not 0 0 0 1 0 0 0, "
       "or of a .ptx file of one scan";
  auto add = group.add_options();
  add("maximum-distance",
      po::value<std::string>()->value_name("D")->notifier([&o](const std::string& s) { set_maximum_distance(s, o); }),
      "largest distance of a point to the plane of its shape, of all points whatever their own tolerance; or auto: "
      "estimated from the points, one for each point where the noise varies for certain, but with --tolerance-column "
      "or --noise the value that nearly all tolerances do "
      "not exceed; or auto-local: estimated for each point, from the noise around it (default: auto)");
  add("tolerance-column", po::value<std::string>(&o.tolerance_column)->value_name("NAME"),
      "the largest distance of each point to the plane of its shape is that property of .ply, field of .pcd, column of "
      "a text table (of its line of names or of --columns) or extra dimension of .las. Points where it is not positive "
      "have no shape");
  add("noise", po::value<std::string>()->value_name("SUM")->notifier([&o](const std::string& text) {
    o.noise_text = text;
    o.noise = parse_noise(text);
  }),
      noise.str().c_str());
}

// A point has one tolerance.
inline void check_tolerances(const Options& o)
{
  const bool has_column = !o.tolerance_column.empty();
  if(has_column && o.noise)
    throw Usage_error("--tolerance-column and --noise both give the tolerance of each point; take one of them");
  if(o.has_local_distances && (has_column || o.noise))
    throw Usage_error(std::string("--maximum-distance auto-local and ") +
                      (has_column ? "--tolerance-column" : "--noise") +
                      " both give the tolerance of each point; take one of them");
  const auto may_have_viewpoint = [&o](const std::string& path) {
    const std::string format = input_format(path, o.format.empty() ? "" : "." + o.format);
    return format == ".pcd" || format == ".ptx";
  };
  if(o.noise && !o.viewpoint && std::none_of(o.inputs.begin(), o.inputs.end(), may_have_viewpoint))
    throw Usage_error("--noise needs the place of the sensor: --viewpoint X,Y,Z (0,0,0 if it is the origin)");
}

} // namespace program

#endif // DETECT_PLANES_TOLERANCE_OPTIONS_H
