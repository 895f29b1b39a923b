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

#include <istream>
#include <locale>
#include <map>
#include <set>
#include <tuple>

namespace program {

// --- Values of options that are lists: directions, a place, and how clouds are read.

// Whether the text is three finite numbers with commas between them, and nothing else.
inline bool read_three(const std::string& text, std::array<double, 3>& d)
{
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  char first = 0, second = 0;
  if(!(in >> d[0] >> first >> d[1] >> second >> d[2]) || first != ',' || second != ',')
    return false;
  in >> std::ws;
  return in.eof();
}

inline std::array<double, 3> parse_direction(const std::string& option, const std::string& text)
{
  std::array<double, 3> direction = {};
  if(!read_three(text, direction) || direction == std::array<double, 3>())
    throw_error<Usage_error>("--", option, " is '", text,
                             "', must be three numbers with commas between them, not all 0, as in 0,0,1");
  return direction;
}

inline std::array<double, 3> parse_place(const std::string& option, const std::string& text)
{
  std::array<double, 3> place = {};
  if(!read_three(text, place))
    throw_error<Usage_error>("--", option, " is '", text,
                             "', must be three numbers with commas between them, as in 2.5,-1,1.6");
  return place;
}

constexpr int no_class = -1;

inline int class_of(const std::string& word)
{
  const bool is_number = !word.empty() && word.size() <= 3 && word.find_first_not_of("0123456789") == word.npos;
  return is_number && std::stoi(word) <= 255 ? std::stoi(word) : no_class;
}

// The value of --classes: numbers from 0 to 255 with commas or blanks between them.
inline std::vector<int> parse_classes(const std::string& text)
{
  std::vector<int> classes;
  std::istringstream parts(text + ','); // with a part after the last comma, too
  for(std::string part, word; std::getline(parts, part, ',');) {
    std::istringstream words(part);
    words >> word;
    classes.push_back(words ? class_of(word) : no_class);
    while(words >> word)
      classes.push_back(class_of(word));
  }
  if(std::count(classes.begin(), classes.end(), no_class) > 0)
    throw_error<Usage_error>("--classes is '", text,
                             "', must be numbers from 0 to 255 with commas between them, as in 2,6");
  return classes;
}

// The numbers with commas between them, which may be infinite; none if something else is there.
inline std::vector<double> read_numbers(const std::string& text)
{
  std::vector<double> numbers;
  std::istringstream parts(text + ','); // with a part after the last comma, too
  for(std::string part; std::getline(parts, part, ',');) {
    part.erase(std::remove(part.begin(), part.end(), ' '), part.end());
    const std::optional<double> number = parse_number(part);
    if(!number || std::isnan(*number))
      return {};
    numbers.push_back(*number);
  }
  return numbers;
}

// The value of --crop.
inline Input_box parse_box(const std::string& text)
{
  const std::vector<double> sides = read_numbers(text);
  Input_box box;
  bool is_box = sides.size() == 6;
  for(std::size_t c = 0; c < 3 && is_box; ++c) {
    box.low[c] = sides[c];
    box.high[c] = sides[c + 3];
    is_box = box.low[c] <= box.high[c];
  }
  if(!is_box)
    throw_error<Usage_error>("--crop is '", text,
                             "', must be XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX: six numbers, no minimum above its maximum");
  return box;
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
      throw_error<Usage_error>("--", name,
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
    throw_error<Usage_error>("--", name, " is '", word, "', must be ", one_of(built));
}

inline void check_format(const char* name, const std::string& path, const std::vector<std::string>& extensions)
{
  const std::string extension = lower_case_extension(path);
  if(path.empty() || std::find(extensions.begin(), extensions.end(), extension) != extensions.end())
    return;
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
  if(column_of_name(name) != Column::none || std::find(others.begin(), others.end(), plain_name(name)) != others.end())
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
  const std::tuple<bool, const char*, std::string> needs[] = {
    {!o.output.empty(), "output", ": several write them with --output-directory"},
    {!o.labels.empty(), "labels", alone},
    {!o.vg.empty(), "vg", alone},
    {!o.polygons.empty(), "polygons", alone},
    {!o.shapes.empty(), "shapes", alone},
    {!o.mesh.empty(), "mesh", alone},
    {!o.view.empty(), "view", alone},
    {o.is_by_plane, "by-plane", alone},
    {has_pca, "estimate-normals with a number", ""},
    {!o.planes_from.empty(), "planes-from", alone},
    {bool(o.minimum_area), "minimum-area", alone},
    {bool(o.minimum_extent), "minimum-extent", alone}};
  for(const auto& [is_given, name, advice] : needs)
    if(is_given)
      throw_error<Usage_error>("--", name, " needs all points in one process", advice);
  if(o.backend == "cuda" && !has_mpi_cuda)
    throw Usage_error("--backend is 'cuda', which is for one process: this program was built without "
                      "Tandem::tandem_mpi_cuda");
}

} // namespace program

#endif // DETECT_PLANES_CHECK_OPTIONS_H
