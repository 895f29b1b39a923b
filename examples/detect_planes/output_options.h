// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options of the command line that name files to be written.

#ifndef DETECT_PLANES_OUTPUT_OPTIONS_H
#define DETECT_PLANES_OUTPUT_OPTIONS_H

#include "Built_with.h"
#include "Options.h"

#include <boost/program_options.hpp>

#include <string>

namespace program {

namespace po = boost::program_options;

inline void add_cloud_options(po::options_description& group, Options& o, const Built_with& built)
{
  const std::string las = built.laszip ? ".las or .laz" : ".las", all_las = built.laszip ? ".las and .laz" : ".las";
  const std::string output =
    "the input with the normals that were used and the shape of each point (-1: none), its intensity and "
    "classification kept, and its tolerance, where each has its own (not in .las): .ply or .pcd (binary), .xyz, .txt "
    "or .csv (text with a line of names), " +
    las +
    " (the shape as extra bytes, without normals; coordinates on the grid of the first .las input, if all points "
    "fit it, else on one of at most 2e-4 of the maximum distance; points that are not finite are left out)";
  const std::string directory =
    std::string(
      "a file as --output for each INPUT, with the points of that one: of its name and format in this folder, "
      "which is made if it is not there, and cannot be that of an INPUT; .ply in place of what --output does "
      "not write") +
    (built.gzip ? ", without .gz" : "");
  const std::string colors =
    "the colors of --output and --output-directory: shape, one for each, or input (default: input for " + all_las +
    ", else shape)";
  const char* const label =
    "the name of the shape of each point in --output and --output-directory: letters, digits and _, as in scalar_shape "
    "(default: shape)";
  auto add = group.add_options();
  add("output", po::value<std::string>(&o.output)->value_name("FILE"), output.c_str());
  add("output-directory", po::value<std::string>(&o.output_directory)->value_name("DIR"), directory.c_str());
  add("colors", po::value<std::string>(&o.colors)->value_name("NAME"), colors.c_str());
  add("label-property", po::value<std::string>(&o.label_property)->value_name("NAME"), label);
}

inline void add_result_options(po::options_description& group, Options& o, const Built_with& built)
{
  const std::string oriented =
    "the normals of the planes of --planes, --shapes" + std::string(built.view ? ", --view" : "") +
    " and --polygons (.geojson, .json) point to the outward side: that of most normals of the points, if the input has "
    "normals, else that of the viewpoint (--viewpoint). Without it, they are the same for all parallel shapes";
  auto add = group.add_options();
  add("labels", po::value<std::string>(&o.labels)->value_name("FILE"),
      "a little-endian int32 for each point of the input, -1 if it belongs to no shape");
  add("planes", po::value<std::string>(&o.planes)->value_name("FILE"),
      "a line 'a b c d' for each shape: a x + b y + c z + d = 0, unit normal; the first line is shape 0");
  add("shapes", po::value<std::string>(&o.shapes)->value_name("FILE"),
      "a table .csv with a line for each shape: points, plane, centroid, area, length and width of the smallest "
      "rectangle around the points, lowest and highest point, tilt, dip and azimuth, distances, by how much "
      "regularization moved the plane, its uncertainty, parallel and coplanar group. Upward is z, or "
      "--symmetry-direction");
  add("by-plane", po::bool_switch(&o.is_by_plane),
      "coplanar shapes are one shape in all outputs, so that there is one for each plane");
  add("oriented", po::bool_switch(&o.is_oriented), oriented.c_str());
  add("vg", po::value<std::string>(&o.vg)->value_name("FILE"),
      "vertex groups as text, for PolyFit, Easy3D and others: points, normals, and a group of points for each shape");
  add("polygons", po::value<std::string>(&o.polygons)->value_name("FILE"),
      "the area of each shape as polygons with corners on its plane, straight where it ends at the plane of another "
      "one: .geojson or .json (a MultiPolygon in the coordinates of the input for each shape, with holes), .ply, "
      ".obj or .off (a face for each polygon, triangles for one with holes). Shapes share the vertices on the lines "
      "where "
      "they meet. A shape of very few points has no polygon");
  add("crs", po::value<std::string>(&o.crs)->value_name("NAME"),
      "the name of the coordinate reference system, such as urn:ogc:def:crs:EPSG::25833, which --polygons (.geojson, "
      ".json) writes as it is given");
  add("triangulate", po::bool_switch(&o.has_triangles_only), "--polygons writes triangles only");
  add("report", po::value<std::string>(&o.report)->value_name("FILE"),
      "JSON with warnings, parameters, counts, quality, times, memory and relations: parallel and coplanar groups of "
      "shapes, orthogonal pairs of parallel groups, all counted from 0");
}

inline void add_mesh_options(po::options_description& group, Options& o)
{
  const std::string planes = "--mesh takes the N planes with most points: " + std::to_string(mesh_planes_by_default) +
                             " by default, and up to " + std::to_string(most_mesh_planes);
  auto add = group.add_options();
  add("mesh", po::value<std::string>(&o.mesh)->value_name("FILE"),
      "a closed surface made of the planes: .off, .obj or .ply; the normals need no orientation. It is made when all "
      "other files are complete");
  add("mesh-planes", po::value<long long>()->value_name("N")->notifier([&o](long long n) { o.mesh_planes = n; }),
      planes.c_str());
}

inline void add_view_option(po::options_description& group, Options& o)
{
  group.add_options()(
    "view", po::value<std::string>(&o.view)->value_name("FILE"),
    "a page .html or .htm that shows the result in a browser, without a network; of more than 3 million points a part");
}

// What the program was built without is hidden: it is known, to say so, but not offered.
inline void add_output_options(po::options_description& visible, po::options_description& hidden, Options& o,
                               const Built_with& built)
{
  po::options_description group("Output (files appear only when they are complete)");
  add_cloud_options(group, o, built);
  add_result_options(group, o, built);
  add_view_option(built.view ? group : hidden, o);
  add_mesh_options(group, o);
  visible.add(group);
  hidden.add_options()("vg-by-plane",
                       po::bool_switch(&o.has_group_for_each_plane)); // of 0.2.0: --by-plane for --vg alone
}

} // namespace program

#endif // DETECT_PLANES_OUTPUT_OPTIONS_H
