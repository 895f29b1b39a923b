// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options of the command line that say how the inputs are read.

#ifndef DETECT_PLANES_INPUT_OPTIONS_H
#define DETECT_PLANES_INPUT_OPTIONS_H

#include "Built_with.h"
#include "option_values.h"

#include <boost/program_options.hpp>

#include <string>

namespace program {

namespace po = boost::program_options;

inline void add_input_options(po::options_description& all, Options& o, const Built_with& built)
{
  const std::string las = built.laszip ? ".las and .laz" : ".las";
  po::options_description group("Input");
  auto add = group.add_options();
  add(
    "format", po::value<std::string>(&o.format)->value_name("NAME"),
    "read all inputs as this format, whatever their names end in: ply, las, pcd, off, ptx, xyz or another extension of "
    "a text table");
  add("columns", po::value<std::string>(&o.columns)->value_name("NAMES"),
      "the columns of text tables, of x y z nx ny nz r g b intensity classification, and _ for one to pass over "
      "(default: from a line of names, or from the values; the output says which)");
  add(
    "decimal-comma", po::bool_switch(&o.has_decimal_commas),
    "numbers of text tables have a comma in place of the point, as in 1,5;2,5;3,5: semicolons or blanks separate them");
  add("classes", po::value<std::string>(&o.classes)->value_name("LIST"),
      ("only the points of these classes, as 2,6 (of " + las +
       ", or of a property or column 'classification'); the others are in no output")
        .c_str());
  add("crop", po::value<std::string>(&o.crop)->value_name("BOX"),
      "only the points in the box XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX, in the coordinates of the input; -inf and inf leave a "
      "side open; the others are in no output");
  add("sample", po::value<long long>()->value_name("N")->notifier([&o](long long n) { o.sample = n; }),
      "the points are N on the faces of each mesh (.ply, .off), evenly by area and the same in each run, with the "
      "normals of the faces; 0: the corners of the faces. Without it a file with faces is refused");
  add(
    "viewpoint", po::value<std::string>()->value_name("X,Y,Z")->notifier([&o](const std::string& text) {
      o.viewpoint = parse_place("viewpoint", text);
    }),
    "the place from which all points were seen, in the coordinates of the input: estimated normals, and the outward "
    "sides of planes, are those towards it; for --noise the place of the sensor. It is an error for an input with "
    "normals of its own, which have a side, unless --estimate-normals or --noise is given (default: the VIEWPOINT of "
    ".pcd files, where it is not 0 0 0 1 0 0 0, which only --oriented uses, and the place in .ptx files of one scan)");
  add("ignore-zeros", po::bool_switch(&o.ignores_zeros),
      "points that are exactly at 0 0 0, as invalid pixels of depth cameras are, have no shape, and nothing depends on "
      "them");
  all.add(group);
}

} // namespace program

#endif // DETECT_PLANES_INPUT_OPTIONS_H
