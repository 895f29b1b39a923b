// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds what is wrong with the options before any work: ranges that the library does not know, formats that cannot be
// written, files that are named twice, and what needs all points in one process.

#ifndef DETECT_PLANES_CHECK_OPTIONS_H
#define DETECT_PLANES_CHECK_OPTIONS_H

#include "Built_with.h"
#include "Options.h"
#include "file_names.h"
#include "option_values.h"
#include "tolerance/tolerance_options.h"

#include <CGAL/Tandem/check_parameters.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace program {

// The same file under two names is found as well; devices and pipes may serve twice.
inline void check_files(const Options& o)
{
  namespace fs = std::filesystem;
  std::set<fs::path> files;
  std::vector<std::string> names = o.inputs;
  if(!o.output_directory.empty())
    for(const std::string& input : o.inputs)
      names.push_back(output_of_input(o.output_directory, input));
  names.insert(names.end(),
               {o.output, o.planes_from, o.labels, o.planes, o.report, o.vg, o.polygons, o.shapes, o.mesh, o.view});
  for(const std::string& name : names) {
    std::error_code error;
    const fs::file_status status = fs::status(name, error);
    if(name.empty() || (fs::exists(status) && !fs::is_regular_file(status)))
      continue;
    if(!files.insert(unique_name(name)).second)
      throw Usage_error("the file " + name + " is named twice");
  }
}

// By whatever names, also where a link or a mount leads to one of them.
inline bool is_same_folder(const std::filesystem::path& a, const std::filesystem::path& b)
{
  std::error_code error;
  const std::filesystem::path name = unique_name(a), other = unique_name(b);
  return name == other || std::filesystem::equivalent(name, other, error);
}

// Each input needs an output of its own, and nothing that is beside an input is replaced.
inline void check_directory(const Options& o)
{
  std::map<std::string, std::string> input_of;
  if(o.output_directory.empty())
    return;
  for(const std::string& input : o.inputs) {
    const std::string output = output_of_input(o.output_directory, input);
    for(const std::filesystem::path& path : {std::filesystem::absolute(input), unique_name(input)})
      if(is_same_folder(o.output_directory, path.parent_path()))
        throw Usage_error("--output-directory is the folder of " + input + "; take another folder");
    const auto [place, is_new] = input_of.emplace(output, input);
    if(!is_new && unique_name(place->second) != unique_name(input))
      throw Usage_error("--output-directory: " + place->second + " and " + input + " would both become " + output);
  }
}

// A file of that name would surprise those who know - as standard input or output. The other outputs have formats.
inline void check_dashes(const Options& o)
{
  for(const std::string& path : o.inputs)
    if(path == "-")
      throw Usage_error("INPUT is '-', must be the name of a file");
  const std::pair<const char*, std::string> outputs[] = {
    {"output", o.output}, {"labels", o.labels}, {"planes", o.planes}, {"vg", o.vg}, {"report", o.report}};
  if(o.output_directory == "-")
    throw Usage_error("--output-directory is '-', must be the name of a folder");
  for(const auto& [name, path] : outputs)
    if(path == "-")
      throw Usage_error(std::string("--") + name +
                        " is '-', must be the name of a file (that of standard output is /dev/stdout)");
}

inline void check_count(const char* name, const std::optional<long long>& value, long long smallest, long long largest)
{
  if(value && (*value < smallest || *value > largest))
    throw Usage_error(std::string("--") + name + " is " + std::to_string(*value) + ", must be in [" +
                      std::to_string(smallest) + ", " + std::to_string(largest) + "]");
}

// Written so that NaN is refused.
inline void check_positive(const char* name, const std::optional<double>& value)
{
  if(value && !(*value > 0 && *value <= CGAL::Tandem::largest_length))
    throw Usage_error(std::string("--") + name + " is " + CGAL::Tandem::to_text(*value) +
                      ", must be positive, and at most " + CGAL::Tandem::to_text(CGAL::Tandem::largest_length));
}

// As in: auto, sequential or parallel.
inline std::string one_of(const std::vector<std::string>& words)
{
  std::string text = words[0];
  for(std::size_t i = 1; i < words.size(); ++i)
    text += (i + 1 < words.size() ? ", " : " or ") + words[i];
  return text;
}

// What is known, but not built, is refused later, with the reason.
inline void check_word(const char* name, const std::string& word, const std::vector<std::string>& known,
                       const std::vector<std::string>& built)
{
  if(!word.empty() && !built.empty() && std::find(known.begin(), known.end(), word) == known.end())
    throw Usage_error(std::string("--") + name + " is '" + word + "', must be " + one_of(built));
}

inline void check_format(const char* name, const std::string& path, const std::vector<std::string>& extensions)
{
  const std::string extension = lower_case_extension(path);
  if(path.empty() || std::find(extensions.begin(), extensions.end(), extension) != extensions.end())
    return;
  throw Usage_error(std::string("--") + name + " is '" + path + "', must end in " + one_of(extensions));
}

// A name that every format can have, and that no reader takes for something else.
inline void check_label_property(const std::string& name)
{
  constexpr std::size_t largest_size = 32; // of LAS
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_right = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  if(!is_letter(name[0]) || !std::all_of(name.begin(), name.end(), is_right) || name.size() > largest_size)
    throw Usage_error("--label-property is '" + name + "', must be letters, digits and _, a letter first, at most " +
                      std::to_string(largest_size));
  const std::vector<std::string> others = {"tolerance",         "rgb",       "rgba",        "alpha",
                                           "returnnumber",      "gpstime",   "userdata",    "numberofreturns",
                                           "pointsourceid",     "keypoint",  "scanangle",   "scananglerank",
                                           "scandirectionflag", "synthetic", "withheld",    "edgeofflightline",
                                           "scannerchannel",    "overlap",   "pointformat", "nearinfrared"};
  if(column_of_name(name) != Column::none || std::find(others.begin(), others.end(), plain_name(name)) != others.end())
    throw Usage_error("--label-property is '" + name + "', which is the name of something else in clouds");
}

inline void check_formats(const Options& o, const Built_with& built)
{
  check_format("shapes", o.shapes, {".csv"});
  check_format("polygons", o.polygons, {".geojson", ".json", ".ply", ".obj", ".off"});
  check_format("mesh", o.mesh, {".off", ".obj", ".ply"});
  check_format("view", o.view, {".html", ".htm"});
  if(!is_known_output(o.output)) {
    std::vector<std::string> outputs(output_extensions.begin(), output_extensions.end());
    if(!built.laszip)
      outputs.erase(std::find(outputs.begin(), outputs.end(), ".laz"));
    check_format("output", o.output, outputs);
  }
  if(!o.colors.empty() && o.colors != "shape" && o.colors != "input")
    throw Usage_error("--colors is '" + o.colors + "', must be shape or input");
  if(!o.colors.empty() && o.output.empty() && o.output_directory.empty())
    throw Usage_error("--colors needs --output or --output-directory");
  if(o.label_property != Options().label_property && o.output.empty() && o.output_directory.empty())
    throw Usage_error("--label-property needs --output or --output-directory");
  check_label_property(o.label_property);
  input_settings(o);
}

// Ranges that the library does not know; parameters_of() checks the others.
inline void check(const Options& o, const Built_with& built)
{
  if(o.inputs.empty() || std::count(o.inputs.begin(), o.inputs.end(), "") > 0)
    throw Usage_error("no INPUT given");
  check_word("backend", o.backend, Built_with().backends(), built.backends());
  check_count("threads", o.threads, 1, 4096);
  check_count("sample", o.sample, 0, 1000000000);
  if(o.estimate_normals && *o.estimate_normals != by_library)
    check_count("estimate-normals", o.estimate_normals, 3, 1000);
  if(o.has_group_for_each_plane && o.vg.empty())
    throw Usage_error("--vg-by-plane needs --vg");
  if(o.has_triangles_only && o.polygons.empty())
    throw Usage_error("--triangulate needs --polygons");
  if(!o.crs.empty() && !is_geojson(o.polygons))
    throw Usage_error("--crs needs --polygons with a name that ends in .geojson or .json");
  if(o.is_oriented && o.planes.empty() && o.shapes.empty() && o.view.empty() && o.polygons.empty())
    throw Usage_error("--oriented needs --planes, --shapes, --view or --polygons");
  if(o.mesh_planes && o.mesh.empty())
    throw Usage_error("--mesh-planes needs --mesh");
  check_count("mesh-planes", o.mesh_planes, fewest_mesh_planes, most_mesh_planes);
  check_count("largest", o.largest, 1, CGAL::Tandem::maximum_number_of_points);
  if(!o.planes_from.empty() && o.estimate_normals && *o.estimate_normals == by_library)
    throw Usage_error(
      "--planes-from takes normals of the input, or by --estimate-normals K: the detection estimates others");
  if(!o.planes_from.empty() && o.backend == "cuda")
    throw Usage_error("--backend is 'cuda', but --planes-from detects nothing: leave one of them out");
  check_positive("minimum-area", o.minimum_area);
  check_positive("minimum-extent", o.minimum_extent);
  check_tolerances(o);
  check_dashes(o);
  check_formats(o, built);
  check_directory(o);
  check_files(o);
}

// Finds options that need all points in one process, where there are several.
inline void check_ranks(const Options& o)
{
  const std::pair<const char*, std::string> outputs[] = {
    {"output", o.output}, {"labels", o.labels}, {"vg", o.vg},    {"polygons", o.polygons},
    {"shapes", o.shapes}, {"mesh", o.mesh},     {"view", o.view}};
  for(const auto& [name, path] : outputs)
    if(!path.empty())
      throw Usage_error(
        std::string("--") + name + " needs all points in one process: " +
        (std::string(name) == "output" ? "several write them with --output-directory" : "run it without mpirun"));
  if(o.is_by_plane)
    throw Usage_error("--by-plane needs all points in one process: run it without mpirun");
  if(o.estimate_normals && *o.estimate_normals != by_library)
    throw Usage_error("--estimate-normals with a number needs all points in one process");
  if(!o.planes_from.empty())
    throw Usage_error("--planes-from needs all points in one process: run it without mpirun");
  if(o.minimum_area || o.minimum_extent)
    throw Usage_error(std::string(o.minimum_area ? "--minimum-area" : "--minimum-extent") +
                      " needs all points in one process: run it without mpirun");
  if(o.backend == "cuda" && !has_mpi_cuda)
    throw Usage_error("--backend is 'cuda', which is for one process: this program was built without "
                      "Tandem::tandem_mpi_cuda");
}

} // namespace program

#endif // DETECT_PLANES_CHECK_OPTIONS_H
