// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command line of detect_planes.

#ifndef DETECT_PLANES_PROGRAM_OPTIONS_H
#define DETECT_PLANES_PROGRAM_OPTIONS_H

#include "check_options.h"
#include "input/input_options.h"
#include "option_values.h"
#include "output_options.h"
#include "selection_options.h"
#include "tolerance/tolerance_options.h"

#include <boost/program_options.hpp>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace program {

inline std::string usage(const Built_with& built)
{
  std::string text = "usage: detect_planes INPUT... [options]\n\n"
                     "Finds the planes of a point cloud and makes parallel, orthogonal and coplanar ones exactly so.\n"
                     "INPUT is a file .ply, .las, " +
                     std::string(built.laszip ? ".laz, " : "") + ".pcd, .off, .ptx or a text table (" + table_names() +
                     ")";
  if(built.gzip)
    text += std::string(",\nalso with .gz behind") + (built.laszip ? " (but .laz)" : "");
  text +=
    ".\nSeveral are one cloud, in their order. Normals are estimated where the input has none, or only null ones.\n"
    "Exit code: 0 success, 1 the data cannot be read, processed or written, or the run was interrupted, 2 bad usage.\n"
    "A second Ctrl-C ends it at once.\n";
  if(built.mpi)
    text += "mpirun -n N detect_planes INPUT... --output-directory DIR: N processes share the inputs, also on many\n"
            "machines; the result is that of one process.\n";
  return text;
}

namespace po = boost::program_options;

inline void add_detection_options(po::options_description& all, Options& o)
{
  po::options_description group("Detection (lengths in the units of the input, angles in degrees)");
  add_tolerance_options(group, o);
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
  add("maximum-angle", number(o.maximum_angle)->value_name("DEG"),
      "largest angle between the normal of a point and that of its shape, from 0.05 to below 90 (default: 25)");
  add("angle-tolerance", number(o.angle_tolerance)->value_name("DEG"),
      "angle within which shapes are made parallel or orthogonal if their points allow it, below 45 (default: 8)");
  add(
    "maximum-offset", number(o.maximum_offset)->value_name("D"),
    "distance within which parallel planes are made coplanar if their points allow it (default: the maximum distance)");
  add("minimum-region-size", count(o.minimum_region_size)->value_name("N"),
      "smallest number of points of a shape, at least 3 (default: estimated from the number of points)");
  add("simplicity", number(o.simplicity)->value_name("MU"),
      "what the size of a shape is worth, from 0, more layers and details, to 1, few and large planes (default: 0.04)");
  add("regularity", number(o.regularity)->value_name("R"),
      "what a degree of freedom is worth in smallest sizes of a shape, from 0, planes that follow their points, to 10, "
      "as many relations as possible (default: 0.1)");
  add("surfel-size", number(o.surfel_size)->value_name("R"),
      "edge of the cells whose points are taken as one while shapes grow, as a share of the maximum distance, from 0, "
      "each point by itself, to 0.55 (default: 0.55)");
  add("k-neighbors", count(o.k_neighbors)->value_name("K"),
      "number of neighbors of a point, from 3 to 64 (default: 12)");
  add("cell-size", count(o.cell_size)->value_name("N"),
      "largest number of points of an octree cell, from 64 to 65536 (default: 8192)");
  add("no-parallelism", off(o.regularize_parallelism), "do not make shapes parallel");
  add("no-orthogonality", off(o.regularize_orthogonality), "do not make shapes orthogonal");
  add("no-coplanarity", off(o.regularize_coplanarity), "do not make shapes coplanar");
  add("fixed-direction",
      po::value<std::vector<std::string>>()->value_name("X,Y,Z")->notifier([&o](const std::vector<std::string>& texts) {
        for(const std::string& text : texts)
          o.fixed_directions.push_back(parse_direction("fixed-direction", text));
      }),
      "a direction known beforehand, such as the vertical 0,0,1: shapes within the angle tolerance become exactly "
      "parallel or orthogonal to it if their points allow it; may be given several times");
  add(
    "symmetry-direction", po::value<std::string>()->value_name("X,Y,Z")->notifier([&o](const std::string& text) {
      o.symmetry_direction = parse_direction("symmetry-direction", text);
    }),
    "the same; and shapes that make nearly the same angle with it, such as the sides of a roof, make exactly the same; "
    "for --mesh it is the direction upward");
  add(
    "planes-from", po::value<std::string>(&o.planes_from)->value_name("FILE"),
    "the planes of FILE instead of a detection: lines 'a b c d' as --planes writes them, or a table with columns a, b, "
    "c and d. Each point gets the nearest plane within the maximum distance and, where the input has normals, the "
    "maximum angle. Planes have no end, and their points need not be connected");
  add("estimate-normals", count(o.estimate_normals)->value_name("[K]"),
      "estimate the normals even if the file has some; with K by plain PCA of K neighbors, for comparisons");
  all.add(group);
}

inline void add_execution_options(po::options_description& all, Options& o, const Built_with& built)
{
  std::string backends;
  for(const std::string& name : built.backends())
    backends += (backends.empty() ? "" : ", ") + name;
  po::options_description group("Execution");
  auto add = group.add_options();
  add("backend", po::value<std::string>(&o.backend)->value_name("NAME"),
      (backends + "; all give the same result (default: auto)").c_str());
  add("threads", po::value<long long>()->value_name("N")->notifier([&o](long long n) { o.threads = n; }),
      built.mpi ? "largest number of threads, of each process, up to 4096 (default: all processors; those of a machine "
                  "are shared by the processes on it)"
                : "largest number of threads, up to 4096 (default: all processors)");
  add("quiet", po::bool_switch(&o.is_quiet), "print nothing but warnings and errors");
  add("help", po::bool_switch(&o.wants_help), "print this text");
  add("version", po::bool_switch(&o.wants_version), "print the version");
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

// An unset variable of a script is no wish for the default.
inline void check_values(const po::variables_map& map)
{
  for(const auto& [name, value] : map) {
    const auto* text = boost::any_cast<std::string>(&value.value());
    if(text != nullptr && text->empty())
      throw Usage_error("--" + name + " is empty");
  }
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
    check_values(map);
    po::notify(map);
  } catch(const po::error& e) {
    throw Usage_error(message_of(e, argc, argv));
  }
  std::ostringstream help;
  help << usage(built) << visible;
  result.help = help.str();
  if(!o.wants_help && !o.wants_version)
    check(o, built);
  return result;
}

} // namespace program

#endif // DETECT_PLANES_PROGRAM_OPTIONS_H
