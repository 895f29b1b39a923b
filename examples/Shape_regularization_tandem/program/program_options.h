// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command line of detect_planes.

#ifndef DETECT_PLANES_PROGRAM_OPTIONS_H
#define DETECT_PLANES_PROGRAM_OPTIONS_H

#include "links.h"

#include <boost/program_options.hpp>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace program {

// Bad usage: exit code 2. Every other exception is exit code 1.
struct Usage_error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr long long by_library = 0; // of estimate_normals: no PCA of a given number of neighbors

// What was not given is left to the library.
struct Options {
  std::string input, output, labels, planes, report, vg, polygons, view;
  std::optional<double> maximum_distance, maximum_angle, angle_tolerance, maximum_offset;
  std::optional<long long> minimum_region_size, k_neighbors, cell_size, threads, estimate_normals;
  bool regularize_parallelism = true, regularize_orthogonality = true, regularize_coplanarity = true;
  std::string backend = "auto";
  bool has_group_for_each_plane = false, is_quiet = false, wants_help = false;
};

inline std::string usage()
{
  return "usage: detect_planes INPUT [options]\n\n"
         "Finds the planes of a point cloud and makes parallel, orthogonal and coplanar ones exactly so.\n"
         "INPUT is a file .ply, .xyz, .pwn, .off (or .las, if CGAL was built with LASlib). Normals are\n"
         "estimated where the file has none, or only null ones. Exit code: 0 success, 1 the data cannot be read, "
         "processed\n"
         "or written, or the run was interrupted, 2 bad usage.\n";
}

namespace po = boost::program_options;

inline void add_detection_options(po::options_description& all, Options& o)
{
  po::options_description group("Detection (lengths in the units of the input, angles in degrees)");
  const auto number = [](std::optional<double>& target) {
    return po::value<double>()->notifier([&target](double x) { target = x; });
  };
  const auto count = [](std::optional<long long>& target) {
    return po::value<long long>()->notifier([&target](long long x) { target = x; });
  };
  const auto off = [](bool& target) {
    return po::bool_switch()->notifier([&target](bool is_given) { target = !is_given; });
  };
  auto add = group.add_options();
  add("maximum-distance", number(o.maximum_distance)->value_name("D"),
      "largest distance of a point to the plane of its shape (default: estimated from noise and spacing)");
  add("maximum-angle", number(o.maximum_angle)->value_name("DEG"),
      "largest angle between the normal of a point and that of its shape, from 0.05 to below 90 (default: 25)");
  add("angle-tolerance", number(o.angle_tolerance)->value_name("DEG"),
      "angle within which shapes are made parallel or orthogonal if their points allow it, below 45 (default: 8)");
  add(
    "maximum-offset", number(o.maximum_offset)->value_name("D"),
    "distance within which parallel planes are made coplanar if their points allow it (default: the maximum distance)");
  add("minimum-region-size", count(o.minimum_region_size)->value_name("N"),
      "smallest number of points of a shape (default: estimated from the number of points)");
  add("k-neighbors", count(o.k_neighbors)->value_name("K"), "number of neighbors of a point (default: 12)");
  add("cell-size", count(o.cell_size)->value_name("N"), "largest number of points of an octree cell (default: 8192)");
  add("no-parallelism", off(o.regularize_parallelism), "do not make shapes parallel");
  add("no-orthogonality", off(o.regularize_orthogonality), "do not make shapes orthogonal");
  add("no-coplanarity", off(o.regularize_coplanarity), "do not make shapes coplanar");
  add("estimate-normals", count(o.estimate_normals)->value_name("[K]"),
      "estimate the normals even if the file has some; with K by plain PCA of K neighbors, for comparisons");
  all.add(group);
}

inline void add_execution_options(po::options_description& all, Options& o)
{
  po::options_description group("Execution");
  auto add = group.add_options();
  add("backend", po::value<std::string>(&o.backend)->value_name("NAME"),
      "auto, sequential, parallel or cuda; all give the same result (default: auto)");
  add("threads", po::value<long long>()->value_name("N")->notifier([&o](long long n) { o.threads = n; }),
      "largest number of threads (default: all processors)");
  add("quiet", po::bool_switch(&o.is_quiet), "print nothing but errors");
  add("help", po::bool_switch(&o.wants_help), "print this text");
  all.add(group);
}

inline void add_output_options(po::options_description& all, Options& o)
{
  po::options_description group("Output (files appear only when they are complete)");
  auto add = group.add_options();
  add("output", po::value<std::string>(&o.output)->value_name("FILE"),
      "binary PLY of the input with the normals that were used, a color for each shape and an int property 'shape'");
  add("labels", po::value<std::string>(&o.labels)->value_name("FILE"),
      "a little-endian int32 for each point of the input, -1 if it belongs to no shape");
  add("planes", po::value<std::string>(&o.planes)->value_name("FILE"),
      "a line 'a b c d' for each shape: a x + b y + c z + d = 0, unit normal; the first line is shape 0");
  add("vg", po::value<std::string>(&o.vg)->value_name("FILE"),
      "vertex groups as text, for PolyFit, Easy3D and others: points, normals, and a group of points for each shape");
  add("vg-by-plane", po::bool_switch(&o.has_group_for_each_plane),
      "a group of --vg for each plane: coplanar shapes in one");
  add("polygons", po::value<std::string>(&o.polygons)->value_name("FILE"),
      "the area of each shape as a mesh of triangles with corners on its plane, .ply or .obj");
  add("view", po::value<std::string>(&o.view)->value_name("FILE"),
      "a page that shows the result in 3D: one .html file, which a browser opens without a network");
  add("report", po::value<std::string>(&o.report)->value_name("FILE"),
      "JSON with parameters, counts, quality, times, memory and relations: parallel and coplanar groups of shapes, "
      "orthogonal pairs of parallel groups, all counted from 0");
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
    const bool is_followed_by_number =
      i + 1 < words.size() && !words[i + 1].empty() &&
      std::all_of(words[i + 1].begin(), words[i + 1].end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    words[i] += "=" + (is_followed_by_number ? words[i + 1] : std::to_string(by_library));
    if(is_followed_by_number)
      words.erase(words.begin() + std::ptrdiff_t(i) + 1);
  }
  return words;
}

// The same file under two names is found as well; devices and pipes may serve twice.
inline void check_files(const Options& o)
{
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  for(const std::string& name : {o.input, o.output, o.labels, o.planes, o.report, o.vg, o.polygons, o.view}) {
    std::error_code error;
    const fs::file_status status = fs::status(name, error);
    if(name.empty() || (fs::exists(status) && !fs::is_regular_file(status)))
      continue;
    files.push_back(unique_name(name));
    if(std::count(files.begin(), files.end(), files.back()) > 1)
      throw Usage_error("the file " + name + " is named twice");
  }
}

inline void check_count(const char* name, const std::optional<long long>& value, long long smallest, long long largest)
{
  if(value && (*value < smallest || *value > largest))
    throw Usage_error(std::string("--") + name + " is " + std::to_string(*value) + ", must be in [" +
                      std::to_string(smallest) + ", " + std::to_string(largest) + "]");
}

inline void check_mesh_format(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  if(!path.empty() && extension != ".ply" && extension != ".obj")
    throw Usage_error("--polygons is '" + path + "', must end in .ply or .obj");
}

// Ranges that the library does not know, and negative numbers, which would wrap around.
inline void check(const Options& o)
{
  if(o.input.empty())
    throw Usage_error("no INPUT given");
  if(o.backend != "auto" && o.backend != "sequential" && o.backend != "parallel" && o.backend != "cuda")
    throw Usage_error("--backend is '" + o.backend + "', must be auto, sequential, parallel or cuda");
  constexpr long long largest = 1LL << 31;
  check_count("threads", o.threads, 1, 4096);
  check_count("minimum-region-size", o.minimum_region_size, 0, largest);
  check_count("k-neighbors", o.k_neighbors, 0, largest);
  check_count("cell-size", o.cell_size, 0, largest);
  if(o.estimate_normals && *o.estimate_normals != by_library)
    check_count("estimate-normals", o.estimate_normals, 3, 1000);
  if(o.has_group_for_each_plane && o.vg.empty())
    throw Usage_error("--vg-by-plane needs --vg");
  check_mesh_format(o.polygons);
  check_files(o);
}

struct Command_line {
  Options options;
  std::string help;
};

// Boost puts names and values in place of %canonical_option%, %value% and others in its message until none is left:
// for ever, if they contain one themselves.
inline std::string message_of(const po::error& e, int argc, const char* const argv[])
{
  const auto word = std::find_if(argv + 1, argv + argc, [](const char* word) { return std::strchr(word, '%'); });
  if(word == argv + argc)
    return e.what();
  return std::string("an option is not known, or its value is wrong; maybe in '") + *word + "'";
}

inline Command_line parse(int argc, const char* const argv[])
{
  Command_line result;
  Options& o = result.options;
  po::options_description visible, all;
  add_detection_options(visible, o);
  add_execution_options(visible, o);
  add_output_options(visible, o);
  all.add(visible).add_options()("input", po::value<std::string>(&o.input), "");
  po::positional_options_description positional;
  positional.add("input", 1);
  try {
    namespace style = po::command_line_style;
    po::variables_map map;
    po::store(po::command_line_parser(join_optional_value(argc, argv))
                .options(all)
                .positional(positional)
                .style(style::unix_style & ~style::allow_guessing) // "--max 3" must not pass for one of three options
                .run(),
              map);
    po::notify(map);
  } catch(const po::error& e) {
    throw Usage_error(message_of(e, argc, argv));
  }
  std::ostringstream help;
  help << usage() << visible;
  result.help = help.str();
  if(!o.wants_help)
    check(o);
  return result;
}

} // namespace program

#endif // DETECT_PLANES_PROGRAM_OPTIONS_H
