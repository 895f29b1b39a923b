// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds what is wrong with the options before any work: ranges that the library does not know, formats that cannot be
// written, files that are named twice, and what needs all points in one process.

#ifndef DETECT_PLANES_CHECK_OPTIONS_H
#define DETECT_PLANES_CHECK_OPTIONS_H

#include "Options.h"
#include "file_names.h"
#include "input/Input_buffer.h"
#include "input/input_settings.h"

#include <CGAL/Tandem/check_parameters.h>

#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>
#include <boost/algorithm/string/trim.hpp>

#include <map>
#include <set>
#include <tuple>

namespace program {

// --- Values of options that are lists: directions, a place, and how clouds are read.

// What is between the commas of a text, without blanks around it.
inline std::vector<std::string> parts_of(const std::string& text)
{
  std::vector<std::string> parts;
  boost::split(parts, text, boost::is_any_of(","));
  for(std::string& part : parts)
    boost::trim(part);
  return parts;
}

// The numbers with commas between them, which may be infinite; none if something else is there.
inline std::vector<double> read_numbers(const std::string& text)
{
  std::vector<double> numbers;
  for(const std::string& part : parts_of(text)) {
    const std::optional<double> number = parse_number(part);
    if(!number || std::isnan(*number))
      return {};
    numbers.push_back(*number);
  }
  return numbers;
}

// Whether these are three finite numbers first.
inline bool begin_with_three(const std::vector<double>& numbers, std::array<double, 3>& d)
{
  if(numbers.size() < 3 ||
     !std::all_of(numbers.begin(), numbers.begin() + 3, [](double x) { return std::isfinite(x); }))
    return false;
  std::copy_n(numbers.begin(), 3, d.begin());
  return true;
}

enum class Three { direction, place };

inline std::array<double, 3> parse_three(const char* option, const std::string& text, Three kind)
{
  const std::vector<double> numbers = read_numbers(text);
  std::array<double, 3> d = {};
  const bool is_direction = kind == Three::direction;
  if(numbers.size() != 3 || !begin_with_three(numbers, d) || (is_direction && d == std::array<double, 3>()))
    throw_error<Usage_error>("--", option, " is '", text, "', must be three numbers with commas between them, ",
                             is_direction ? "not all 0, as in 0,0,1" : "as in 2.5,-1,1.6");
  return d;
}

// The value of --near-direction.
inline Direction_choice parse_near_direction(const std::string& text)
{
  const std::string word = text.substr(0, text.find(','));
  Direction_choice choice;
  choice.text = text;
  choice.of = word == "vertical"     ? Direction_choice::vertical
              : word == "horizontal" ? Direction_choice::horizontal
                                     : Direction_choice::direction;
  const bool is_named = choice.of != Direction_choice::direction;
  const std::vector<double> numbers = read_numbers(is_named ? "0,0,1" + text.substr(word.size()) : text);
  bool is_right = begin_with_three(numbers, choice.normal) && choice.normal != std::array<double, 3>();
  if(is_right && numbers.size() > 3) {
    choice.degrees = numbers[3];
    is_right = numbers.size() == 4 && numbers[3] >= 0 && numbers[3] <= 90;
  }
  if(!is_right)
    throw_error<Usage_error>(
      "--near-direction is '", text,
      "', must be X,Y,Z, not all 0, vertical or horizontal, or one of these with ,DEG from 0 to 90");
  return choice;
}

// The value of --classes: numbers from 0 to 255 with commas or blanks between them.
inline std::vector<int> parse_classes(const std::string& text)
{
  std::vector<int> classes;
  std::vector<std::string> words;
  for(const std::string& part : parts_of(text))
    for(const std::string& word : boost::split(words, part, boost::is_space(), boost::token_compress_on)) {
      const bool is_number = !word.empty() && word.size() <= 3 && std::all_of(word.begin(), word.end(), is_digit);
      if(!is_number || std::stoi(word) > 255)
        throw_error<Usage_error>("--classes is '", text,
                                 "', must be numbers from 0 to 255 with commas between them, as in 2,6");
      classes.push_back(std::stoi(word));
    }
  return classes;
}

// The value of --crop.
inline Box parse_box(const std::string& text)
{
  const std::vector<double> sides = read_numbers(text);
  if(sides.size() != 6 || sides[0] > sides[3] || sides[1] > sides[4] || sides[2] > sides[5])
    throw_error<Usage_error>("--crop is '", text,
                             "', must be XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX: six numbers, no minimum above its maximum");
  return Box(sides[0], sides[1], sides[2], sides[3], sides[4], sides[5]);
}

// The value of --format, as an extension.
inline std::string parse_format(const std::string& text)
{
  std::string extension = "." + text;
  if(!is_input_extension(extension))
    throw_error<Usage_error>("--format is '", text, "', must be ply, las, laz, pcd, off, ptx or that of a text table (",
                             table_names(), ") without the point");
  return extension;
}

// Throws std::invalid_argument where the options are wrong, or cannot be meant.
inline Input_settings input_settings(const Options& o)
{
  Input_settings settings;
  settings.tolerance = o.tolerance_column;
  settings.has_decimal_commas = o.has_decimal_commas;
  if(!o.columns.empty())
    settings.columns = parse_columns(o.columns, o.tolerance_column);
  if(!o.format.empty())
    settings.format = parse_format(o.format);
  const auto has_input_of = [&](auto is_right) {
    return std::any_of(o.inputs.begin(), o.inputs.end(),
                       [&](const std::string& path) { return is_right(input_format(path, settings.format)); });
  };
  if(!o.columns.empty() && !has_input_of(is_table))
    throw_error<Usage_error>("--columns is for text tables (", table_names(), ")");
  if(o.has_decimal_commas && !has_input_of([](const std::string& f) { return is_table(f) || f == ".ptx"; }))
    throw_error<Usage_error>("--decimal-comma is for text tables (", table_names(), ") and .ptx");
  if(o.sample && !has_input_of([](const std::string& f) { return f == ".ply" || f == ".off"; }))
    throw Usage_error("--sample is for meshes (.ply, .off)");
  if(o.sample)
    settings.sample = std::size_t(*o.sample);
  if(!o.classes.empty())
    settings.classes = parse_classes(o.classes);
  if(!o.crop.empty())
    settings.crop = parse_box(o.crop);
  return settings;
}

// ---

// An option that names a file that is written.
struct Output_option {
  const char* name;
  std::string Options::*path;
  bool needs_all_points;               // in one process
  std::vector<std::string> extensions; // that it may have; none: any
};

inline const std::vector<Output_option>& output_options()
{
  static const std::vector<Output_option> options = {
    {"output", &Options::output, true, {}},
    {"labels", &Options::labels, true, {}},
    {"planes", &Options::planes, false, {}},
    {"report", &Options::report, false, {}},
    {"vg", &Options::vg, true, {}},
    {"polygons", &Options::polygons, true, {".geojson", ".json", ".ply", ".obj", ".off"}},
    {"shapes", &Options::shapes, true, {".csv"}},
    {"mesh", &Options::mesh, true, {".off", ".obj", ".ply"}},
    {"view", &Options::view, true, {".html", ".htm"}}};
  return options;
}

// The same file under two names is found as well; devices and pipes may serve twice.
inline void check_files(const Options& o)
{
  namespace fs = std::filesystem;
  std::set<fs::path> files;
  std::vector<std::string> names = o.inputs;
  if(!o.output_directory.empty())
    for(const std::string& input : o.inputs)
      names.push_back(output_of_input(o.output_directory, input));
  names.push_back(o.planes_from);
  for(const Output_option& option : output_options())
    names.push_back(o.*option.path);
  for(const std::string& name : names) {
    std::error_code error;
    const fs::file_status status = fs::status(name, error);
    if(name.empty() || (fs::exists(status) && !fs::is_regular_file(status)))
      continue;
    if(!files.insert(unique_name(name)).second)
      throw_error<Usage_error>("the file ", name, " is named twice");
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
        throw_error<Usage_error>("--output-directory is the folder of ", input, "; take another folder");
    const auto [place, is_new] = input_of.emplace(output, input);
    if(!is_new && unique_name(place->second) != unique_name(input))
      throw_error<Usage_error>("--output-directory: ", place->second, " and ", input, " would both become ", output);
  }
}

// A file of that name would surprise those who know - as standard input or output.
inline void check_dashes(const Options& o)
{
  if(std::count(o.inputs.begin(), o.inputs.end(), "-") > 0)
    throw Usage_error("INPUT is '-', must be the name of a file");
  if(o.output_directory == "-")
    throw Usage_error("--output-directory is '-', must be the name of a folder");
  for(const Output_option& option : output_options())
    if(option.extensions.empty() && o.*option.path == "-")
      throw_error<Usage_error>("--", option.name,
                               " is '-', must be the name of a file (that of standard output is /dev/stdout)");
}

inline void check_count(const char* name, const std::optional<long long>& value, long long smallest, long long largest)
{
  if(value && (*value < smallest || *value > largest))
    throw_error<Usage_error>("--", name, " is ", *value, ", must be in [", smallest, ", ", largest, "]");
}

// Written so that NaN is refused.
inline void check_positive(const char* name, const std::optional<double>& value)
{
  if(value && !(*value > 0 && *value <= CGAL::Tandem::largest_length))
    throw_error<Usage_error>("--", name, " is ", CGAL::Tandem::to_text(*value), ", must be positive, and at most ",
                             CGAL::Tandem::to_text(CGAL::Tandem::largest_length));
}

inline bool is_one_of(const std::string& word, const std::vector<std::string>& words)
{
  return std::find(words.begin(), words.end(), word) != words.end();
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
  if(!word.empty() && !built.empty() && !is_one_of(word, known))
    throw_error<Usage_error>("--", name, " is '", word, "', must be ", one_of(built));
}

inline void check_format(const char* name, const std::string& path, const std::vector<std::string>& extensions)
{
  if(!path.empty() && !is_one_of(lower_case_extension(path), extensions))
    throw_error<Usage_error>("--", name, " is '", path, "', must end in ", one_of(extensions));
}

// A name that every format can have, and that no reader takes for something else.
inline void check_label_property(const std::string& name)
{
  constexpr std::size_t largest_size = 32; // of LAS
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_right = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  if(!is_letter(name[0]) || !std::all_of(name.begin(), name.end(), is_right) || name.size() > largest_size)
    throw_error<Usage_error>("--label-property is '", name,
                             "', must be letters, digits and _, a letter first, at most ", largest_size);
  const std::vector<std::string> others = {"tolerance",         "rgb",       "rgba",        "alpha",
                                           "returnnumber",      "gpstime",   "userdata",    "numberofreturns",
                                           "pointsourceid",     "keypoint",  "scanangle",   "scananglerank",
                                           "scandirectionflag", "synthetic", "withheld",    "edgeofflightline",
                                           "scannerchannel",    "overlap",   "pointformat", "nearinfrared"};
  if(column_of_name(name) != Column::none || is_one_of(plain_name(name), others))
    throw_error<Usage_error>("--label-property is '", name, "', which is the name of something else in clouds");
}

// A point has one tolerance.
inline void check_tolerances(const Options& o)
{
  const bool has_column = !o.tolerance_column.empty();
  if(has_column && o.noise)
    throw Usage_error("--tolerance-column and --noise both give the tolerance of each point; take one of them");
  if(o.has_local_distances && (has_column || o.noise))
    throw_error<Usage_error>("--maximum-distance auto-local and ", (has_column ? "--tolerance-column" : "--noise"),
                             " both give the tolerance of each point; take one of them");
  const auto may_have_viewpoint = [&o](const std::string& path) {
    const std::string format = input_format(path, o.format.empty() ? "" : "." + o.format);
    return format == ".pcd" || format == ".ptx";
  };
  if(o.noise && !o.viewpoint && std::none_of(o.inputs.begin(), o.inputs.end(), may_have_viewpoint))
    throw Usage_error("--noise needs the place of the sensor: --viewpoint X,Y,Z (0,0,0 if it is the origin)");
}

inline void check_formats(const Options& o, const Built_with& built)
{
  for(const Output_option& option : output_options())
    if(!option.extensions.empty())
      check_format(option.name, o.*option.path, option.extensions);
  if(!is_known_output(o.output)) {
    std::vector<std::string> outputs(output_extensions.begin(), output_extensions.end());
    if(!built.laszip)
      outputs.erase(std::find(outputs.begin(), outputs.end(), ".laz"));
    check_format("output", o.output, outputs);
  }
  if(!o.colors.empty() && o.colors != "shape" && o.colors != "input")
    throw_error<Usage_error>("--colors is '", o.colors, "', must be shape or input");
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
  const bool has_no_polygons = o.polygons.empty();
  const std::pair<bool, const char*> alone[] = {
    {o.has_group_for_each_plane && o.vg.empty(), "--vg-by-plane needs --vg"},
    {o.has_triangles_only && has_no_polygons, "--triangulate needs --polygons"},
    {!o.crs.empty() && !is_geojson(o.polygons), "--crs needs --polygons with a name that ends in .geojson or .json"},
    {o.is_oriented && o.planes.empty() && o.shapes.empty() && o.view.empty() && has_no_polygons,
     "--oriented needs --planes, --shapes, --view or --polygons"},
    {o.mesh_planes && o.mesh.empty(), "--mesh-planes needs --mesh"}};
  for(const auto& [is_alone, message] : alone)
    if(is_alone)
      throw Usage_error(message);
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
  const bool has_pca = o.estimate_normals && *o.estimate_normals != by_library;
  const std::string alone = ": run it without mpirun";
  std::vector<std::tuple<bool, const char*, std::string>> needs = {
    {!o.output.empty(), "output", ": several write them with --output-directory"},
    {o.is_by_plane, "by-plane", alone},
    {has_pca, "estimate-normals with a number", ""},
    {!o.planes_from.empty(), "planes-from", alone},
    {bool(o.minimum_area), "minimum-area", alone},
    {bool(o.minimum_extent), "minimum-extent", alone}};
  for(const Output_option& option : output_options())
    needs.emplace_back(option.needs_all_points && !(o.*option.path).empty(), option.name, alone);
  for(const auto& [is_given, name, advice] : needs)
    if(is_given)
      throw_error<Usage_error>("--", name, " needs all points in one process", advice);
  if(o.backend == "cuda" && !has_mpi_cuda)
    throw Usage_error(
      "--backend is 'cuda', which is for one process: this program was built without Tandem::tandem_mpi_cuda");
}

} // namespace program

#endif // DETECT_PLANES_CHECK_OPTIONS_H
