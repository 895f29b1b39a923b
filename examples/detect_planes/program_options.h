// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command line of detect_planes.

#ifndef DETECT_PLANES_PROGRAM_OPTIONS_H
#define DETECT_PLANES_PROGRAM_OPTIONS_H

#include "check_options.h"

#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>

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
      "read all inputs as this format, whatever their names: ply, las, pcd, off, ptx, xyz or another of a text table");
  add(group, "columns", text_option(o.columns, "NAMES"),
      "the columns of text tables, of x y z nx ny nz r g b intensity classification, and _ for one to pass over "
      "(default: from a line of names, or from the values; the output says which)");
  add(
    group, "decimal-comma", po::bool_switch(&o.has_decimal_commas),
    "numbers of text tables have a comma in place of the point, as in 1,5;2,5;3,5: semicolons or blanks separate them");
  add(group, "classes", text_option(o.classes, "LIST"), "only the points of these classes, as 2,6 (of ",
      built.laszip ? ".las and .laz" : ".las",
      ", or of a property or column 'classification'); the others are in no output");
  add(group, "crop", text_option(o.crop, "BOX"),
      "only the points in the box XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX, where -inf and inf leave a side open; the others are "
      "in no output");
  add(group, "sample", number_option(o.sample, "N"),
      "the points are N on the faces of each mesh (.ply, .off), evenly by area and the same in each run, with the "
      "normals of the faces; 0: the corners of the faces. Without it a file with faces is refused");
  add(
    group, "viewpoint",
    parsed_option("X,Y,Z",
                  [&o](const std::string& text) { o.viewpoint = parse_three("viewpoint", text, Three::place); }),
    "the place from which all points were seen: estimated normals and outward sides of planes are those towards it; "
    "for --noise that of the sensor. An error for an input with normals, unless --estimate-normals or --noise is given "
    "(default: the VIEWPOINT of .pcd files, but 0 0 0 1 0 0 0 only for --oriented, and the place in .ptx of one scan)");
  add(group, "ignore-zeros", po::bool_switch(&o.ignores_zeros),
      "points exactly at 0 0 0, as invalid pixels of depth cameras are, have no shape and no influence");
  all.add(group);
}

// --- The options of the command line that say how far points may be from their planes.

inline void add_tolerance_options(po::options_description& group, Options& o)
{
  add(group, "maximum-distance",
      parsed_option("D",
                    [&o](const std::string& text) {
                      o.has_local_distances = text == "auto-local";
                      o.maximum_distance = parse_number(text);
                      refuse_if(!o.maximum_distance && !is_in(text, {"auto", "auto-local"}), "--maximum-distance is '",
                                text, "', must be auto, auto-local or a number, with a decimal point if any");
                    }),
      "largest distance of a point to the plane of its shape, of all points whatever their own tolerance; or auto: "
      "estimated from the points, one for each point where the noise varies for certain, but with --tolerance-column "
      "or --noise the value that nearly all tolerances do not exceed; or auto-local: estimated for each point, from "
      "the noise around it (default: auto)");
  add(
    group, "tolerance-column", text_option(o.tolerance_column, "NAME"),
    "the largest distance of each point to the plane of its shape is this property of .ply, field of .pcd, column of a "
    "text table or extra dimension of .las. Points where it is not positive have no shape");
  add(group, "noise",
      parsed_option("SUM",
                    [&o](const std::string& text) {
                      o.noise_text = text;
                      o.noise = Noise_parser(text).parse();
                    }),
      "the standard deviation of the noise along the ray, at the range r, the distance to the sensor, as in "
      "\"0.001 + 0.0028*r^2\": the tolerance of each point is ",
      std::setprecision(3), CGAL::Tandem::distance_of_noise(1),
      " times that. The sensor is at --viewpoint, or at the VIEWPOINT of .pcd files, where it is not 0 0 0 1 0 0 0, or "
      "of a .ptx file of one scan");
}

// --- The options of the command line that say which of the shapes the outputs have.

inline void add_selection_options(po::options_description& all, Options& o)
{
  po::options_description group("Selection (all outputs have only the shapes that fit all of these)");
  add(group, "largest", number_option(o.largest, "N"), "the N shapes with most points, of those that fit the others");
  add(group, "minimum-area", number_option(o.minimum_area, "A"),
      "shapes whose points cover at least this area, in squares of the unit of the input");
  add(group, "minimum-extent", number_option(o.minimum_extent, "L"),
      "shapes that are at least so long: the longer side of a rectangle around the points");
  add(group, "near-direction",
      parsed_option("DIRECTION", [&o](const std::string& text) { o.near_direction = parse_near_direction(text); }),
      "shapes with a normal within 10 degrees of X,Y,Z, of either sign; 'vertical' are walls, and 'horizontal' floors "
      "and ceilings, by the symmetry direction, or else z, as upward. An angle may follow, as in vertical,5");
  all.add(group);
}

// --- The options of the command line that name files to be written.

inline void add_cloud_options(po::options_description& group, Options& o, const Built_with& built)
{
  add(
    group, "output,o", text_option(o.output, "FILE"),
    "the cloud with the shape of each point (-1: none), the normals that were used, its intensity, classification and "
    "tolerance: .ply or .pcd (binary), .xyz, .txt or .csv (text with a line of names), ",
    built.laszip ? ".las or .laz" : ".las",
    " (the shape as extra bytes, without normals and tolerances; coordinates on the grid of the first .las input, if "
    "all points fit it, else of steps of at most 2e-4 of the maximum distance; only finite points)");
  add(
    group, "output-directory", text_option(o.output_directory, "DIR"),
    "a file as --output for each INPUT, of its name and format, in this folder, which is made if it is not there, and "
    "cannot be that of an INPUT; .ply in place of what --output does not write",
    built.gzip ? ", without .gz" : "");
  add(group, "colors", text_option(o.colors, "NAME"),
      "the colors of --output and --output-directory: shape, one for each, or input (default: input for ",
      built.laszip ? ".las and .laz" : ".las", ", else shape)");
  add(group, "label-property", text_option(o.label_property, "NAME"),
      "the name of the shape in --output and --output-directory: letters, digits and _, as in scalar_shape (default: "
      "shape)");
}

inline void add_result_options(po::options_description& group, Options& o, const Built_with& built)
{
  add(group, "labels", text_option(o.labels, "FILE"),
      "a little-endian int32 for each point of the input, -1 if it belongs to no shape");
  add(group, "planes", text_option(o.planes, "FILE"),
      "a line 'a b c d' for each shape: a x + b y + c z + d = 0, unit normal; the first line is shape 0");
  add(group, "shapes", text_option(o.shapes, "FILE"),
      "a table .csv with a line for each shape: points, plane, centroid, area, length and width, lowest and highest "
      "point, "
      "tilt, dip and azimuth, distances, by how much regularization moved the plane, its uncertainty, parallel and "
      "coplanar group. Upward is z, or --symmetry-direction");
  add(group, "by-plane", po::bool_switch(&o.is_by_plane),
      "coplanar shapes are one shape in all outputs, so that there is one for each plane");
  add(
    group, "oriented", po::bool_switch(&o.is_oriented), "the normals of the planes of --planes, --shapes",
    built.view ? ", --view" : "",
    " and --polygons (.geojson, .json) point to the outward side: that of most normals of the points, if the input has "
    "normals, else that of the viewpoint (--viewpoint). Without it, they are the same for all parallel shapes");
  add(group, "vg", text_option(o.vg, "FILE"),
      "vertex groups as text, for PolyFit, Easy3D and others: points, normals, and a group of points for each shape");
  add(
    group, "polygons", text_option(o.polygons, "FILE"),
    "the area of each shape as polygons on its plane, straight where it ends at the plane of another one: .geojson or "
    ".json (a MultiPolygon for each shape, with holes), .ply, .obj or .off (a face for each polygon, triangles for "
    "one with holes). Shapes share the vertices where they meet. A shape of very few points has no polygon");
  add(group, "crs", text_option(o.crs, "NAME"),
      "the coordinate reference system that --polygons (.geojson, .json) names, such as urn:ogc:def:crs:EPSG::25833");
  add(group, "triangulate", po::bool_switch(&o.has_triangles_only), "--polygons writes triangles only");
  add(
    group, "report", text_option(o.report, "FILE"),
    "JSON of what was done and found: warnings, parameters, counts, quality, times, memory, and parallel, coplanar and "
    "orthogonal groups of shapes, counted from 0");
}

// What the program was built without is hidden: it is known, to say so, but not offered.
inline void add_output_options(po::options_description& visible, po::options_description& hidden, Options& o,
                               const Built_with& built)
{
  po::options_description group("Output (files appear only when they are complete)");
  add_cloud_options(group, o, built);
  add_result_options(group, o, built);
  add(
    built.view ? group : hidden, "view", text_option(o.view, "FILE"),
    "a page .html or .htm that shows the result in a browser, without a network; of more than 3 million points a part");
  add(group, "mesh", text_option(o.mesh, "FILE"),
      "a closed surface made of the planes: .off, .obj or .ply; the normals need no orientation. It is made when all "
      "other files are complete");
  add(group, "mesh-planes", number_option(o.mesh_planes, "N"),
      "--mesh takes the N planes with most points: ", mesh_planes_by_default, " by default, and up to ",
      most_mesh_planes);
  visible.add(group);
  hidden.add_options()("vg-by-plane",
                       po::bool_switch(&o.has_group_for_each_plane)); // of 0.2.0: --by-plane for --vg alone
}

// ---

inline std::string usage(const Built_with& built)
{
  return text_of("usage: detect_planes INPUT... [options]\n\n"
                 "Finds the planes of a point cloud and makes parallel, orthogonal and coplanar ones exactly so.\n"
                 "INPUT is a file .ply, .las, ",
                 built.laszip ? ".laz, " : "", ".pcd, .off, .ptx\nor a text table (", table_names(), ")",
                 built.gzip ? ", also with .gz" : "", built.gzip && built.laszip ? " (but .laz)" : "", ".\n");
}

// By topic.
inline std::string long_help(const Built_with& built, const po::options_description& options)
{
  return text_of(
    usage(built),
    "Several are one cloud, in their order. Normals are estimated where the input has none, or only null ones.\n"
    "Exit code: 0 success, 1 the data cannot be read, processed or written, or the run was interrupted, 2 bad usage.\n"
    "A second Ctrl-C ends it at once.\n",
    built.mpi
      ? "mpirun -n N detect_planes INPUT... --output-directory DIR: N processes share the inputs, also on many\n"
        "machines; the result is that of one process.\n"
      : "",
    options);
}

// Fits a screen: the most used options, with the beginning and the end of what is said of them.
inline std::string short_help(const Built_with& built, const po::options_description& options)
{
  std::ostringstream out;
  out << usage(built) << "\nThe most used options (--help all has all of them, by topic):\n" << std::left;
  for(const char* name : {"output", "planes", "shapes", "polygons", "view", "mesh", "report", "maximum-distance",
                          "maximum-angle", "minimum-region-size", "simplicity", "largest", "columns", "threads"})
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
      "from 0 for details to 1 for few and large planes: what the size of a shape is worth (default: 0.04)");
  add(group, "regularity", number_option(o.regularity, "R"),
      "what a degree of freedom is worth in smallest sizes of a shape, from 0, planes that follow their points, to 10, "
      "as many relations as possible (default: 0.1)");
  add(group, "surfel-size", number_option(o.surfel_size, "R"),
      "edge of the cells whose points are taken as one while shapes grow, as a share of the maximum distance, from 0, "
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
      "parallel or orthogonal to it if their points allow it; may be given several times");
  add(group, "symmetry-direction",
      parsed_option("X,Y,Z",
                    [&o](const std::string& text) {
                      o.symmetry_direction = parse_three("symmetry-direction", text, Three::direction);
                    }),
      "the same; and shapes that make nearly the same angle with it, such as the sides of a roof, make exactly the "
      "same; for --mesh it is the direction upward");
  add(group, "planes-from", text_option(o.planes_from, "FILE"),
      "the planes of FILE, which --planes has written or a table with columns a, b, c and d, instead of a detection. "
      "Each "
      "point gets the nearest plane within the tolerances. Planes have no end; their points need not be connected");
  add(group, "estimate-normals", number_option(o.estimate_normals, "[K]"),
      "estimate the normals even if the file has some; with K by plain PCA of K neighbors, for comparisons");
  all.add(group);
}

inline void add_execution_options(po::options_description& all, Options& o, const Built_with& built)
{
  po::options_description group("Execution");
  add(group, "backend", text_option(o.backend, "NAME"), boost::join(built.backends(), ", "),
      "; all give the same result (default: auto)");
  add(group, "threads", number_option(o.threads, "N"),
      built.mpi ? "largest number of threads, of each process, up to 4096 (default: all processors; those of a machine "
                  "are shared by the processes on it)"
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

// Of an option that is not known, the ones that may be meant: for names of other detectors, or the nearest ones.
inline std::string advice_on(const po::error& e, const po::options_description& options)
{
  if(dynamic_cast<const po::validation_error*>(&e) != nullptr)
    return ": must be a number, with a decimal point if any";
  const auto* unknown = dynamic_cast<const po::unknown_option*>(&e);
  if(unknown == nullptr)
    return {};
  const std::map<std::string, std::string> of_others = {
    {"epsilon", "maximum-distance"},       {"distance-threshold", "maximum-distance"},
    {"cluster-epsilon", "k-neighbors"},    {"normal-threshold", "maximum-angle"},
    {"min-points", "minimum-region-size"}, {"minimum-points", "minimum-region-size"}};
  std::string name = boost::replace_all_copy(unknown->get_option_name(), "_", "-");
  boost::trim_left_if(name, boost::is_any_of("-"));
  name = name.substr(0, name.find('='));
  const auto known = of_others.find(name);
  std::vector<std::string> names;
  for(const auto& option : options.options()) {
    const std::string& other = option->long_name();
    const auto front = std::mismatch(name.begin(), name.end(), other.begin(), other.end()).first - name.begin();
    const auto back = std::mismatch(name.rbegin(), name.rend(), other.rbegin(), other.rend()).first - name.rbegin();
    const bool is_near = front >= 2 && front + back + 2 >= std::ptrdiff_t(name.size());
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
