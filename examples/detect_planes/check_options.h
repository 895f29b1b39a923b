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
#include "input/read_cloud.h"

#include <CGAL/Tandem/Parameters.h>

#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>
#include <boost/algorithm/string/trim.hpp>

#include <map>
#include <set>

namespace program {

template <class... Words>
void refuse_if(bool is_wrong, const Words&... words)
{
  if(is_wrong)
    throw_error<Usage_error>(words...);
}

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
  refuse_if(numbers.size() != 3 || !begin_with_three(numbers, d) || (is_direction && d == std::array<double, 3>()),
            "--", option, " is '", text, "', must be three numbers with commas between them, ",
            is_direction ? "not all 0, as in 0,0,1" : "as in 2.5,-1,1.6",
            std::string_view(option) == "up" ? ", or auto" : "");
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
  refuse_if(!is_right, "--near-direction is '", text,
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
      refuse_if(!is_number || std::stoi(word) > 255, "--classes is '", text,
                "', must be numbers from 0 to 255 with commas between them, as in 2,6");
      classes.push_back(std::stoi(word));
    }
  return classes;
}

// The value of --class: names of classes with commas between them.
inline std::vector<std::string> parse_shape_classes(const std::string& text)
{
  const std::vector<std::string> known = {"floor", "ceiling", "wall", "roof", "ground", "slanted"};
  const std::vector<std::string> names = parts_of(text);
  for(const std::string& name : names)
    refuse_if(!is_in(name, known), "--class is '", text, "', must be names with commas between them: any of ",
              boost::join(known, ", "));
  return names;
}

// The value of --crop.
inline Box parse_box(const std::string& text)
{
  const std::vector<double> sides = read_numbers(text);
  refuse_if(sides.size() != 6 || sides[0] > sides[3] || sides[1] > sides[4] || sides[2] > sides[5], "--crop is '", text,
            "', must be XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX: six numbers, no minimum above its maximum");
  return Box(sides[0], sides[1], sides[2], sides[3], sides[4], sides[5]);
}

// Throws std::invalid_argument where the options are wrong, or cannot be meant.
inline Input_settings input_settings(const Options& o, const Built_with& built = built_with())
{
  Input_settings settings;
  settings.tolerance = o.tolerance_column;
  settings.has_decimal_commas = o.has_decimal_commas;
  if(!o.columns.empty())
    settings.columns = parse_columns(o.columns, o.tolerance_column);
  if(!o.format.empty())
    settings.format = "." + o.format;
  refuse_if(!o.format.empty() && !is_input_extension(settings.format), "--format is '", o.format,
            "', must be ply, las, ", built.laszip ? "laz, " : "", "pcd, off, ptx or that of a text table (",
            table_names(), ") without the point");
  const auto has_input_of = [&](auto is_right) {
    return std::any_of(o.inputs.begin(), o.inputs.end(),
                       [&](const std::string& path) { return is_right(input_format(path, settings.format)); });
  };
  refuse_if(!o.columns.empty() && !has_input_of(is_table), "--columns is for text tables (", table_names(), ")");
  refuse_if(o.has_decimal_commas && !has_input_of([](const std::string& f) { return is_table(f) || f == ".ptx"; }),
            "--decimal-comma is for text tables (", table_names(), ") and .ptx");
  refuse_if(o.sample && !has_input_of([](const std::string& f) {
              return is_in(f, {".ply", ".off"});
            }),
            "--sample is for meshes (.ply, .off)");
  if(o.sample)
    settings.sample = std::size_t(*o.sample);
  settings.label = o.label_property;
  settings.replaces_colors = o.colors == "shape";
  settings.replaces_normals = o.estimate_normals.has_value();
  settings.keeps_records = [output = o.output, directory = o.output_directory,
                            format = settings.format](const auto& path) {
    const std::string of_input = input_format(path, format);
    return is_same_format(of_input, output_extension(output)) ||
           (!directory.empty() && is_same_format(of_input, lower_case_extension(output_of_input(directory, path))));
  };
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
    {"lines", &Options::lines, true, {".geojson", ".json", ".dxf", ".obj"}},
    {"shapes", &Options::shapes, true, {".csv"}},
    {"mesh", &Options::mesh, true, {".off", ".obj", ".ply", city_json}},
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
      refuse_if(is_same_folder(o.output_directory, path.parent_path()), "--output-directory is the folder of ", input,
                "; name another folder");
    const auto [place, is_new] = input_of.emplace(output, input);
    refuse_if(!is_new && unique_name(place->second) != unique_name(input), "--output-directory: ", place->second,
              " and ", input, " would both become ", output);
  }
}

inline void check_count(const char* name, const std::optional<long long>& value, long long smallest, long long largest)
{
  const long long count = value.value_or(smallest);
  refuse_if(count < smallest || count > largest, "--", name, " is ", count, ", allowed is [", smallest, ", ", largest,
            "]");
}

// Written so that NaN is refused.
inline void check_positive(const char* name, const std::optional<double>& value)
{
  const double number = value.value_or(1);
  refuse_if(!(number > 0 && number <= 1e270), "--", name, " is ", number, ", must be positive, and at most 1e270");
}

// As in: auto, sequential or parallel.
inline std::string one_of(const std::vector<std::string>& words)
{
  const std::vector<std::string> first(words.begin(), words.end() - 1);
  return boost::join(first, ", ") + (first.empty() ? "" : " or ") + words.back();
}

inline void check_format(const char* name, const std::string& path, const std::vector<std::string>& extensions)
{
  const bool is_right = std::any_of(extensions.begin(), extensions.end(),
                                    [&](const std::string& extension) { return ends_in(path, extension); });
  refuse_if(!path.empty() && !is_right, "--", name, " is '", path, "', must end in ", one_of(extensions));
}

// A name that every format can have, and that no reader takes for something else.
inline void check_label_property(const std::string& name)
{
  constexpr std::size_t largest_size = 32; // of LAS
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_right = [&](char c) { return is_letter(c) || is_digit(c) || c == '_'; };
  refuse_if(!is_letter(name[0]) || !std::all_of(name.begin(), name.end(), is_right) || name.size() > largest_size,
            "--label-property is '", name, "', must be letters, digits and _, a letter first, at most ", largest_size);
  const auto others = {"tolerance",         "rgb",       "rgba",        "alpha",
                       "returnnumber",      "gpstime",   "userdata",    "numberofreturns",
                       "pointsourceid",     "keypoint",  "scanangle",   "scananglerank",
                       "scandirectionflag", "synthetic", "withheld",    "edgeofflightline",
                       "scannerchannel",    "overlap",   "pointformat", "nearinfrared"};
  refuse_if(column_of_name(name) != Column::none || is_in(plain_name(name), others), "--label-property is '", name,
            "', a name that clouds use for other data");
}

// A point has one tolerance.
inline void check_tolerances(const Options& o)
{
  const bool has_column = !o.tolerance_column.empty();
  const char* both = " both give the tolerance of each point; pass only one of them";
  refuse_if(has_column && o.noise, "--tolerance-column and --noise", both);
  refuse_if(o.has_local_distances && (has_column || o.noise), "--maximum-distance auto-local and ",
            has_column ? "--tolerance-column" : "--noise", both);
  const auto may_have_viewpoint = [&o](const std::string& path) {
    return is_in(input_format(path, o.format.empty() ? "" : "." + o.format), {".pcd", ".ptx"});
  };
  refuse_if(o.noise && !o.viewpoint && std::none_of(o.inputs.begin(), o.inputs.end(), may_have_viewpoint),
            "--noise needs the place of the sensor: pass --viewpoint X,Y,Z (0,0,0 if it is the origin)");
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
  const bool has_no_cloud = o.output.empty() && o.output_directory.empty();
  refuse_if(!is_in(o.colors, {"", "shape", "input"}), "--colors is '", o.colors, "', must be shape or input");
  refuse_if(!o.colors.empty() && has_no_cloud, "--colors needs --output or --output-directory");
  refuse_if(o.label_property != Options().label_property && has_no_cloud,
            "--label-property needs --output or --output-directory");
  check_label_property(o.label_property);
  input_settings(o, built);
}

// Ranges that the library does not know; parameters_of() checks the others.
inline void check(const Options& o, const Built_with& built)
{
  const bool has_library_normals = o.estimate_normals == by_library, detects = o.planes_from.empty();
  refuse_if(o.inputs.empty() || is_in("", o.inputs), "no INPUT given");
  // What is known, but not built, is refused later, with the reason.
  refuse_if(!is_in(o.backend, Built_with().backends()), "--backend is '", o.backend, "', must be ",
            one_of(built.backends()));
  check_count("threads", o.threads, 1, 4096);
  check_count("sample", o.sample, 0, 1000000000);
  if(!has_library_normals)
    check_count("estimate-normals", o.estimate_normals, 3, 1000);
  refuse_if(o.has_group_for_each_plane && o.vg.empty(), "--vg-by-plane needs --vg");
  refuse_if(o.has_triangles_only && o.polygons.empty(), "--triangulate needs --polygons");
  const bool has_city = ends_in(o.mesh, city_json);
  refuse_if(!o.crs.empty() && !is_geojson(o.polygons) && !is_geojson(o.lines) && !has_city,
            "--crs needs --polygons or --lines with a name that ends in .geojson or .json, or --mesh with ", city_json);
  refuse_if(!o.crs.empty() && has_city && url_of_crs(o.crs).empty(), "--crs is '", o.crs,
            "', which CityJSON cannot name; write it like EPSG:25833 or urn:ogc:def:crs:EPSG::25833");
  refuse_if(o.is_oriented && o.planes.empty() && o.shapes.empty() && o.view.empty() && o.polygons.empty(),
            "--oriented needs --planes, --shapes, --view or --polygons");
  refuse_if(o.mesh_planes && o.mesh.empty(), "--mesh-planes needs --mesh");
  refuse_if((o.base_height || o.is_base_ground) && o.mesh.empty(), "--base needs --mesh");
  refuse_if(!o.footprint.empty() && o.mesh.empty(), "--footprint needs --mesh");
  refuse_if(!o.footprint.empty() && o.up && *o.up != std::array<double, 3>{0, 0, 1},
            "--footprint is seen along z, so --up must be 0,0,1");
  refuse_if(o.mesh_seconds && o.mesh.empty(), "--mesh-seconds needs --mesh");
  refuse_if(o.mesh_components && o.mesh.empty(), "--mesh-components needs --mesh");
  check_count("mesh-planes", o.mesh_planes, fewest_mesh_planes, (std::numeric_limits<int>::max)());
  check_count("largest", o.largest, 1, 1LL << 31);
  refuse_if(!detects && has_library_normals,
            "--planes-from with --estimate-normals needs a number K of neighbors: --estimate-normals K");
  refuse_if(!detects && o.backend == "cuda",
            "--backend is 'cuda', but --planes-from detects nothing: pass only one of them");
  check_positive("mesh-seconds", o.mesh_seconds);
  refuse_if(!detects && o.is_upright,
            "--upright is for detected planes, but --planes-from detects nothing: pass only one of them");
  check_positive("minimum-area", o.minimum_area);
  check_positive("minimum-extent", o.minimum_extent);
  check_positive("minimum-width", o.minimum_width);
  check_tolerances(o);
  // A file of that name would surprise those who know - as standard input or output.
  refuse_if(is_in("-", o.inputs), "INPUT is '-', must be the name of a file");
  refuse_if(o.output_directory == "-", "--output-directory is '-', must be the name of a folder");
  for(const Output_option& option : output_options())
    refuse_if(option.extensions.empty() && o.*option.path == "-", "--", option.name,
              " is '-', must be the name of a file (that of standard output is /dev/stdout)");
  check_formats(o, built);
  check_directory(o);
  check_files(o);
}

// Finds options that need all points in one process, where there are several.
inline void check_ranks(const Options& o)
{
  const auto needs_all = [](bool is_given, const char* name, const char* advice = ": run it without mpirun") {
    refuse_if(is_given, "--", name, " needs all points in one process", advice);
  };
  needs_all(!o.output.empty(), "output", ": with several, use --output-directory");
  needs_all(o.is_by_plane, "by-plane");
  needs_all(o.estimate_normals.value_or(by_library) != by_library, "estimate-normals with a number", "");
  needs_all(!o.planes_from.empty(), "planes-from");
  needs_all(o.minimum_area.has_value(), "minimum-area");
  needs_all(o.minimum_extent.has_value(), "minimum-extent");
  needs_all(o.minimum_width.has_value(), "minimum-width");
  needs_all(o.is_flat_only, "flat-only");
  needs_all(!o.shape_classes.empty(), "class");
  for(const Output_option& option : output_options())
    needs_all(option.needs_all_points && !(o.*option.path).empty(), option.name);
  refuse_if(o.backend == "cuda" && !has_mpi_cuda,
            "--backend is 'cuda', but in several processes this needs a program built with Tandem::tandem_mpi_cuda");
}

} // namespace program

#endif // DETECT_PLANES_CHECK_OPTIONS_H
