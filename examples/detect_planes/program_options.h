// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command line of detect_planes.

#ifndef DETECT_PLANES_PROGRAM_OPTIONS_H
#define DETECT_PLANES_PROGRAM_OPTIONS_H

#include "check_options.h"

#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <boost/program_options.hpp>

namespace program {

namespace po = boost::program_options;

// Options with a value; what was not given stays empty.
inline auto text_option(std::string& target, const char* name)
{
  return po::value<std::string>(&target)->value_name(name);
}

// Its value goes to use(text).
template <class Use>
auto parsed_option(const char* name, const Use& use)
{
  return po::value<std::string>()->value_name(name)->notifier(use);
}

template <class... Words>
void add(po::options_description& group, const char* name, const po::value_semantic* value, const Words&... help)
{
  group.add_options()(name, value, text_of(help...).c_str());
}

template <class Number>
auto number_option(std::optional<Number>& target, const char* name)
{
  return po::value<Number>()->value_name(name)->notifier([&target](Number x) { target = x; });
}

// --- The options of the command line that say how the inputs are read.

inline void add_input_options(po::options_description& all, Options& o, const Built_with& built)
{
  po::options_description group("Input");
  add(group, "format", text_option(o.format, "NAME"),
      "the format of all inputs, whatever their names: ply, las, pcd, off, ptx, xyz or that of another text table");
  add(group, "columns", text_option(o.columns, "NAMES"),
      "the columns of text tables: any of x y z nx ny nz r g b intensity classification, and _ for a column to skip "
      "(default: from a line of names, or guessed from the values; the program prints them)");
  add(group, "decimal-comma", po::bool_switch(&o.has_decimal_commas),
      "numbers of text tables have a decimal comma, as in 1,5;2,5;3,5; semicolons or blanks separate the numbers");
  add(group, "classes", text_option(o.classes, "LIST"), "use only the points of these classes, such as 2,6 (of ",
      built.laszip ? ".las and .laz" : ".las",
      ", or of a property or column 'classification'); other points are in no output");
  add(group, "crop", text_option(o.crop, "BOX"),
      "use only the points in the box XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX, where -inf and inf leave a side open; other "
      "points are in no output");
  add(group, "sample", number_option(o.sample, "N"),
      "put N points on the faces of each mesh (.ply, .off), evenly by area and the same in each run, with the normals "
      "of the faces; 0: take the corners of the faces. Without this option, the program refuses a file with faces");
  add(
    group, "viewpoint",
    parsed_option("X,Y,Z",
                  [&o](const std::string& text) { o.viewpoint = parse_three("viewpoint", text, Three::place); }),
    "the place of the sensor, from which all points were seen: estimated normals and, with them, outward sides of "
    "planes are towards it, and --noise measures distances from it. Unless it is farther away than the points extend, "
    "points of shapes that it cannot have measured become free, and --shapes tells which ones it saw behind others "
    "(default: the VIEWPOINT of .pcd files, but 0 0 0 1 0 0 0 only for --oriented, "
    "and the place of each scan in .ptx)");
  add(group, "ignore-zeros", po::bool_switch(&o.ignores_zeros),
      "ignore points exactly at 0 0 0, such as invalid pixels of depth cameras, also where they are few or near other "
      "points: they get no shape");
  all.add(group);
}

// --- The options of the command line that say how far points may be from their planes.

inline void add_tolerance_options(po::options_description& group, Options& o)
{
  add(
    group, "maximum-distance",
    parsed_option("D",
                  [&o](const std::string& text) {
                    o.has_local_distances = text == "auto-local";
                    o.maximum_distance = parse_number(text);
                    refuse_if(!o.maximum_distance && !is_in(text, {"auto", "auto-local"}), "--maximum-distance is '",
                              text, "', must be auto, auto-local or a number; write decimals with a decimal point");
                  }),
    "largest distance of a point to the plane of its shape, also if its own tolerance is larger; auto: estimated, and "
    "for each point if the noise varies for certain, but with --tolerance-column or --noise the value that nearly "
    "all tolerances do not exceed; auto-local: estimated for each point, from the noise around the point (default: "
    "auto)");
  add(group, "tolerance-column", text_option(o.tolerance_column, "NAME"),
      "take the largest distance of each point to the plane of its shape from this property of .ply, field of .pcd, "
      "column of a text table or extra dimension of .las. Points without a positive value get no shape");
  add(group, "noise",
      parsed_option("SUM",
                    [&o](const std::string& text) {
                      o.noise_text = text;
                      o.noise = Noise_parser(text).parse();
                    }),
      "the standard deviation of the noise along the ray, at the distance r from the sensor, as in "
      "\"0.001 + 0.0028*r^2\": the tolerance of each point is ",
      std::setprecision(3), CGAL::Tandem::distance_of_noise(1),
      " times that. The sensor is at --viewpoint, or at the VIEWPOINT of a .pcd file, unless that is 0 0 0 1 0 0 0, or "
      "at the place of the scan in a .ptx file");
}

// --- The options of the command line that say which of the shapes the outputs have.

inline void add_selection_options(po::options_description& all, Options& o)
{
  po::options_description group("Selection (outputs have only the shapes that fit all these options)");
  add(group, "largest", number_option(o.largest, "N"), "the N shapes with most points, of those that fit the others");
  add(group, "minimum-area", number_option(o.minimum_area, "A"),
      "shapes whose points cover at least this area, in squared units of the input");
  add(group, "minimum-extent", number_option(o.minimum_extent, "L"),
      "shapes of at least this length: the longer side of the smallest rectangle around points and outline");
  add(group, "minimum-width", number_option(o.minimum_width, "L"), "shapes of at least this width: the shorter side");
  add(group, "flat-only", po::bool_switch(&o.is_flat_only),
      "faces only: no shapes that are facets of a curved surface, whose value 'curved' is above 0.5");
  add(group, "class",
      parsed_option("NAMES", [&o](const std::string& text) { o.shape_classes = parse_shape_classes(text); }),
      "shapes of these classes, with commas between them: floor, ceiling, wall, roof, ground, slanted. Upward is --up");
  add(group, "near-direction",
      parsed_option("DIRECTION", [&o](const std::string& text) { o.near_direction = parse_near_direction(text); }),
      "shapes with a normal within 10 degrees of X,Y,Z or its opposite; 'vertical': walls; 'horizontal': floors and "
      "ceilings, where upward is --up. Another angle may follow, as in vertical,5");
  all.add(group);
}

// --- The options of the command line that name files to be written.

inline void add_cloud_options(po::options_description& group, Options& o, const Built_with& built)
{
  add(
    group, "output,o", text_option(o.output, "FILE"),
    "the cloud with the shape of each point (-1: none): .ply, .pcd, .xyz, .txt or .csv (text with a line of names), ",
    built.laszip ? ".las or .laz" : ".las",
    " (the shape as extra bytes; only finite points). In the format of the input it keeps all fields of the points, in "
    "their types, and the rest of the file. In another format it has coordinates, colors, intensity and "
    "classification. "
    "But for LAS, it has the normals that were used, and tolerances if points have their own. Coordinates of .las keep "
    "the grid of the first .las input if all points fit it, otherwise steps are at most 2e-4 of the maximum distance");
  add(group, "output-directory", text_option(o.output_directory, "DIR"),
      "a file like that of --output for each INPUT, with its name and format, in this folder; the program makes the "
      "folder if it is missing. No INPUT may be in it. Formats that --output does not write become .ply",
      built.gzip ? ", without .gz" : "");
  add(group, "colors", text_option(o.colors, "NAME"),
      "the colors of --output and --output-directory: shape, a color for each, or input (default); an input without "
      "colors gets those of the shapes, but in ",
      built.laszip ? ".las and .laz" : ".las", " none");
  add(group, "label-property", text_option(o.label_property, "NAME"),
      "the name of the property that has the shape in --output and --output-directory: letters, digits and _ (default: "
      "shape)");
}

inline void add_result_options(po::options_description& group, Options& o, const Built_with& built)
{
  add(group, "labels", text_option(o.labels, "FILE"),
      "the shape of each point of the input, as a little-endian int32; -1: none");
  add(group, "planes", text_option(o.planes, "FILE"),
      "a line 'a b c d' for each shape: a x + b y + c z + d = 0, with a unit normal; the first line is shape 0");
  add(group, "shapes", text_option(o.shapes, "FILE"),
      "a table .csv with a line for each shape: points, plane, centroid, area, length and width, lowest and highest "
      "point, "
      "tilt, dip and azimuth, distances, how far the plane is from the fit of the points, whether the shape is a facet "
      "of a curved surface, uncertainty, parallel and coplanar group, and class. What a shape has not is blank. Upward "
      "is --up");
  add(group, "by-plane", po::bool_switch(&o.is_by_plane),
      "join coplanar shapes: all outputs have one shape for each plane");
  add(
    group, "oriented", po::bool_switch(&o.is_oriented), "the normals of the planes of --planes, --shapes",
    built.view ? ", --view" : "",
    " and --polygons (.geojson, .json) point to the outward side: the side of most normals of the points, if the input "
    "has normals, otherwise the side of --viewpoint. Without this option, all parallel shapes have the same normal");
  add(group, "vg", text_option(o.vg, "FILE"),
      "vertex groups as text, for PolyFit, Easy3D and others: points, normals, and a group of points for each shape");
  add(
    group, "polygons", text_option(o.polygons, "FILE"),
    "the area of each shape as polygons on its plane, straight where it meets the plane of another shape: .geojson or "
    ".json (a MultiPolygon for each shape, with holes), .ply, .obj or .off (a face for each polygon, triangles for "
    "polygons with holes). Shapes that meet share vertices. A shape of very few points has no polygon");
  add(group, "lines", text_option(o.lines, "FILE"),
      "the lines at which two shapes meet, and the corners at which three do: .geojson or .json (a LineString for each "
      "line, a Point for each corner), .dxf or .obj");
  add(
    group, "crs", text_option(o.crs, "NAME"),
    "the coordinate reference system that --polygons, --lines (.geojson, .json) and --mesh (.city.json) name, such as "
    "urn:ogc:def:crs:EPSG::25833");
  add(group, "triangulate", po::bool_switch(&o.has_triangles_only), "--polygons writes triangles only");
  add(
    group, "report", text_option(o.report, "FILE"),
    "the figures of the run as JSON: warnings, parameters, counts, quality, times, memory, and parallel, coplanar and "
    "orthogonal groups of shapes, counted from 0");
}

// What the program was built without is hidden: it is known, to say so, but not offered.
inline void add_output_options(po::options_description& visible, po::options_description& hidden, Options& o,
                               const Built_with& built)
{
  po::options_description group("Output (files appear only when they are complete)");
  add_cloud_options(group, o, built);
  add_result_options(group, o, built);
  add(built.view ? group : hidden, "view", text_option(o.view, "FILE"),
      "a page .html or .htm that shows the result in a browser, without a network; it shows at most 3 million points");
  add(group, "mesh", text_option(o.mesh, "FILE"),
      "a closed surface made of the planes: .off, .obj, .ply or .city.json (CityJSON 2.0 with a building for each "
      "component, and roofs, walls and ground); the normals need no orientation. The program makes the "
      "surface after all other files");
  add(group, "mesh-components",
      parsed_option("N",
                    [&o](const std::string& text) {
                      constexpr long long all = 1000000;
                      const std::optional<double> number = parse_number(text);
                      refuse_if(text != "all" &&
                                  !(number && *number >= 1 && *number <= all && *number == std::floor(*number)),
                                "--mesh-components is '", text, "', must be all or a whole number from 1 to ", all);
                      o.mesh_components = number ? (long long)(*number) : all;
                    }),
      "--mesh keeps the N components with the largest areas, or all; without this option all that have at least a "
      "hundredth "
      "of the area of the largest");
  add(group, "mesh-planes", number_option(o.mesh_planes, "N"), "--mesh uses only the N planes with most points");
  add(
    group, "base",
    parsed_option("HEIGHT",
                  [&o](const std::string& text) {
                    o.is_base_ground = text == "ground";
                    o.base_height = parse_number(text);
                    refuse_if(!o.is_base_ground && !(o.base_height && std::isfinite(*o.base_height)), "--base is '",
                              text, "', must be a height or ground");
                  }),
    "--mesh closes roofs down to this height, below which nothing is inside; ground: that of the lowest point of class "
    "2, or, where no point has that class, of a shape. What is as low as the base, and shapes of class 2, are no part "
    "of "
    "the mesh");
  add(group, "footprint", text_option(o.footprint, "FILE"),
      "--mesh makes one solid for each polygon of this GeoJSON file, of the points in it, with walls on its edges, "
      "down to "
      "--base, or to the lowest point of a shape near");
  add(group, "mesh-seconds", number_option(o.mesh_seconds, "S"),
      "--mesh takes at most about S seconds: if all planes take longer than half of what the outlines leave, a quarter "
      "of "
      "them is used, those with most points, and so on. What is left out then depends on the machine");
  visible.add(group);
  hidden.add_options()("vg-by-plane",
                       po::bool_switch(&o.has_group_for_each_plane)); // of 0.2.0: --by-plane for --vg alone
}

// ---

inline std::string usage(const Built_with& built)
{
  return text_of(
    "usage: detect_planes INPUT... [options]\n\n"
    "Finds the planes of a point cloud. Nearly parallel, orthogonal or coplanar planes become exactly so.\n"
    "INPUT is a file .ply, .las, ",
    built.laszip ? ".laz, " : "", ".pcd, .off, .ptx\nor a text table (", table_names(), ")",
    built.gzip ? ", also with .gz" : "", built.gzip && built.laszip ? " (not .laz)" : "", ".\n");
}

// By topic.
inline std::string long_help(const Built_with& built, const po::options_description& options)
{
  return text_of(
    usage(built),
    "Several inputs are one cloud, in their order. The program estimates normals if the input has none, or only null\n"
    "vectors. Exit code: 0: success; 1: the data cannot be read, processed or written, or the run was interrupted;\n"
    "2: bad usage. A second Ctrl-C ends the run at once.\n",
    built.mpi
      ? "mpirun -n N detect_planes INPUT... --output-directory DIR: N processes share the inputs, also on many\n"
        "machines; the result is the same as that of one process, but for veils (--viewpoint).\n"
      : "",
    options);
}

// Fits a screen: the most used options, with the beginning and the end of what is said of them.
inline std::string short_help(const Built_with& built, const po::options_description& options)
{
  std::ostringstream out;
  out << usage(built) << "\nThe most used options (--help all has all of them, by topic):\n" << std::left;
  for(const char* name :
      {"output", "planes", "shapes", "polygons", "view", "mesh", "report", "maximum-distance", "maximum-angle",
       "minimum-region-size", "upright", "simplicity", "largest", "columns", "threads"})
    if(const po::option_description* option = options.find_nothrow(name, false)) {
      const std::string& text = option->description();
      const std::size_t end = text.rfind(" (default");
      out << "  " << std::setw(26) << option->format_name() + ' ' + option->format_parameter()
          << boost::trim_copy(text.substr(0, text.find_first_of(",;:(")))
          << (end == text.npos ? "" : text.substr(end, text.find_first_of(",;)", end) - end) + ")") << '\n';
    }
  out << "\nExample: detect_planes cloud.ply --output shapes.ply --planes planes.txt\n";
  return out.str();
}

// --- The options of the command line that say what is upward.

inline std::array<double, 3> unit_vector(const std::array<double, 3>& v)
{
  const double length = std::hypot(v[0], v[1], v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

inline void add_up_options(po::options_description& group, Options& o)
{
  add(group, "up",
      parsed_option("X,Y,Z",
                    [&o](const std::string& text) {
                      if(text != "auto")
                        o.up = unit_vector(parse_three("up", text, Three::direction));
                    }),
      "the direction upward, for dip, azimuth, heights, 'vertical' and 'horizontal', --upright, the page and the walls "
      "of --mesh; auto: z, or away from the earth in geocentric coordinates (ECEF, in meters), unless most points are "
      "level or upright to another direction only, as from a camera. The program prints it (default: "
      "--symmetry-direction, or auto)");
  add(
    group, "upright", po::bool_switch(&o.is_upright),
    "make walls exactly upright, floors exactly level and the sides of roofs equally steep, within the angle "
    "tolerance and if their points allow this: --up becomes --fixed-direction and --symmetry-direction, and relations "
    "to it have the worth of --regularity 2. If auto finds that neither z nor away from the earth is upward, this "
    "takes three detections");
}

inline void add_detection_options(po::options_description& all, Options& o)
{
  po::options_description group("Detection (lengths in the units of the input, angles in degrees)");
  add_tolerance_options(group, o);
  const auto off = [](bool& target) {
    return po::bool_switch()->notifier([&target](bool is_given) { target = !is_given; });
  };
  add(group, "maximum-angle", number_option(o.maximum_angle, "DEG"),
      "largest angle between the normals of a point and its shape, from 0.05 to below 90 (default: 25)");
  add(group, "angle-tolerance", number_option(o.angle_tolerance, "DEG"),
      "angle within which shapes are made parallel or orthogonal if their points allow it, below 45 (default: 8)");
  add(
    group, "maximum-offset", number_option(o.maximum_offset, "D"),
    "distance within which parallel planes are made coplanar if their points allow it (default: the maximum distance)");
  add(group, "minimum-region-size", number_option(o.minimum_region_size, "N"),
      "smallest number of points of a shape, at least 3 (default: estimated)");
  add(group, "simplicity", number_option(o.simplicity, "MU"),
      "from 0 for details to 1 for few and large planes: what the size of a shape is worth (default: 0.08)");
  add(group, "regularity", number_option(o.regularity, "R"),
      "from 0 for planes that follow their points to 10 for as many relations as possible: what a degree of freedom is "
      "worth (default: 0.1)");
  add(
    group, "surfel-size", number_option(o.surfel_size, "R"),
    "width of the cubes whose points are taken as one while shapes grow, divided by the maximum distance: from 0, for "
    "each point by itself, to 0.55 (default: 0.55)");
  add(group, "k-neighbors", number_option(o.k_neighbors, "K"),
      "number of neighbors of a point, from 3 to 64 (default: 12)");
  add(group, "cell-size", number_option(o.cell_size, "N"),
      "largest number of points of an octree cell, from 64 to 65536 (default: 8192)");
  add(group, "no-parallelism", off(o.regularize_parallelism), "do not make shapes parallel");
  add(group, "no-orthogonality", off(o.regularize_orthogonality), "do not make shapes orthogonal");
  add(group, "no-coplanarity", off(o.regularize_coplanarity), "do not make shapes coplanar");
  add(group, "fixed-direction",
      po::value<std::vector<std::string>>()->value_name("X,Y,Z")->notifier([&o](const std::vector<std::string>& texts) {
        for(const std::string& text : texts)
          o.fixed_directions.push_back(parse_three("fixed-direction", text, Three::direction));
      }),
      "a direction known beforehand, such as the vertical 0,0,1: shapes within the angle tolerance become exactly "
      "parallel or orthogonal to it if their points allow this; you may pass this option several times");
  add(group, "symmetry-direction",
      parsed_option("X,Y,Z",
                    [&o](const std::string& text) {
                      o.symmetry_direction = parse_three("symmetry-direction", text, Three::direction);
                    }),
      "like a fixed direction; also, shapes that make nearly the same angle with it, such as the sides of a roof, then "
      "make exactly the same angle");
  add_up_options(group, o);
  add(group, "planes-from", text_option(o.planes_from, "FILE"),
      "detect nothing, but use the planes of FILE: a file of --planes, or a table with columns a, b, c and d. "
      "Each "
      "point gets the nearest plane within the tolerances. Planes are unbounded; their points need not be connected");
  add(group, "estimate-normals", number_option(o.estimate_normals, "[K]"),
      "estimate the normals even if the input has some; with K: by plain PCA of K neighbors, for comparisons");
  all.add(group);
}

inline void add_execution_options(po::options_description& all, Options& o, const Built_with& built)
{
  po::options_description group("Execution");
  add(group, "backend", text_option(o.backend, "NAME"), boost::join(built.backends(), ", "),
      "; all give the same result (default: auto)");
  add(group, "threads", number_option(o.threads, "N"),
      built.mpi ? "largest number of threads of each process, up to 4096 (default: all processors; processes on one "
                  "machine share them)"
                : "largest number of threads, up to 4096 (default: all processors)");
  add(group, "quiet", po::bool_switch(&o.is_quiet), "print nothing but warnings and errors");
  add(group, "help,h", po::bool_switch(&o.wants_help), "print the most used options; --help all: this text");
  add(group, "version", po::bool_switch(&o.wants_version), "print the version");
  all.add(group);
}

// Boost would take the word after an option with an optional value for that value,
// even if it is the INPUT.
inline std::vector<std::string> join_optional_value(int argc, const char* const argv[])
{
  std::vector<std::string> words(argv + 1, argv + argc);
  for(std::size_t i = 0; i < words.size(); ++i) {
    if(words[i] != "--estimate-normals")
      continue;
    const bool is_followed_by_number = i + 1 < words.size() && !words[i + 1].empty() &&
                                       words[i + 1].find_first_not_of("0123456789") == std::string::npos;
    words[i] += "=" + (is_followed_by_number ? words[i + 1] : std::to_string(by_library));
    if(is_followed_by_number)
      words.erase(words.begin() + std::ptrdiff_t(i) + 1);
  }
  return words;
}

struct Command_line {
  Options options;
  std::string help;
};

// Whether each word of a name is the beginning of a word of the other one, as in max-dist and maximum-distance.
inline bool is_short_for(const std::string& name, const std::string& other)
{
  std::vector<std::string> own, words;
  boost::split(own, name, boost::is_any_of("-"));
  boost::split(words, other, boost::is_any_of("-"));
  return std::all_of(own.begin(), own.end(), [&](const std::string& start) {
    return start.size() >= 3 && std::any_of(words.begin(), words.end(),
                                            [&](const std::string& word) { return boost::starts_with(word, start); });
  });
}

// Of an option that is not known, the ones that may be meant: for names of other detectors, or the nearest ones.
inline std::string advice_on(const po::error& e, const po::options_description& options)
{
  if(dynamic_cast<const po::validation_error*>(&e) != nullptr)
    return ": must be a number: a whole one for counts, otherwise with a decimal point";
  const auto* unknown = dynamic_cast<const po::unknown_option*>(&e);
  if(unknown == nullptr)
    return {};
  const std::map<std::string, std::string> of_others = {{"epsilon", "maximum-distance"},
                                                        {"distance-threshold", "maximum-distance"},
                                                        {"tolerance", "maximum-distance"},
                                                        {"normal-threshold", "maximum-angle"},
                                                        {"min-points", "minimum-region-size"},
                                                        {"minimum-points", "minimum-region-size"},
                                                        {"cores", "threads"},
                                                        {"gpu", "backend"}};
  std::string name = boost::replace_all_copy(unknown->get_option_name(), "_", "-");
  boost::trim_left_if(name, boost::is_any_of("-"));
  name = name.substr(0, name.find('='));
  const auto known = std::find_if(of_others.begin(), of_others.end(),
                                  [&](const auto& other) { return is_short_for(name, other.first); });
  std::vector<std::string> names;
  for(const auto& option : options.options()) {
    const std::string& other = option->long_name();
    const auto front = std::mismatch(name.begin(), name.end(), other.begin(), other.end()).first - name.begin();
    const auto back = std::mismatch(name.rbegin(), name.rend(), other.rbegin(), other.rend()).first - name.rbegin();
    const bool is_near = (front >= 2 && front + back + 2 >= std::ptrdiff_t(name.size())) || is_short_for(name, other);
    if(known != of_others.end() ? known->second == other : is_near)
      names.push_back("--" + other);
  }
  return names.empty() ? "" : ": did you mean " + one_of(names) + "?";
}

// Boost puts names and values in place of %canonical_option%, %value% and others in its message until none is left:
// for ever, if they contain one themselves.
inline std::string message_of(const po::error& e, const po::options_description& options, int argc,
                              const char* const argv[])
{
  const auto word = std::find_if(argv + 1, argv + argc, [](const char* word) { return std::strchr(word, '%'); });
  if(word == argv + argc)
    return e.what() + advice_on(e, options);
  return std::string("an option is not known, or its value is wrong; maybe in '") + *word + "'";
}

inline Command_line parse(int argc, const char* const argv[], const Built_with& built = Built_with())
{
  Command_line result;
  Options& o = result.options;
  po::options_description visible, hidden, all;
  add_input_options(visible, o, built);
  add_detection_options(visible, o);
  add_selection_options(visible, o);
  add_execution_options(visible, o, built);
  add_output_options(visible, hidden, o, built);
  all.add(visible).add(hidden).add_options()("input", po::value<std::vector<std::string>>(&o.inputs), "");
  po::positional_options_description positional;
  positional.add("input", -1);
  try {
    namespace style = po::command_line_style;
    po::variables_map map;
    po::store(po::command_line_parser(join_optional_value(argc, argv))
                .options(all)
                .positional(positional)
                .style(style::unix_style & ~style::allow_guessing) // "--max 3" must not pass for one of three options
                .run(),
              map);
    // An unset variable of a script is no wish for the default.
    for(const auto& [name, value] : map)
      if(const auto* text = boost::any_cast<std::string>(&value.value()))
        refuse_if(text->empty(), "--", name, " is empty");
    po::notify(map);
    o.up = o.up || map.count("up") > 0 ? o.up : o.symmetry_direction;
  } catch(const po::error& e) {
    throw Usage_error(message_of(e, visible, argc, argv));
  }
  result.help = is_in("all", o.inputs) ? long_help(built, visible) : short_help(built, visible);
  if(!o.wants_help && !o.wants_version)
    check(o, built);
  return result;
}

} // namespace program

#endif // DETECT_PLANES_PROGRAM_OPTIONS_H
