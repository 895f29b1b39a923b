// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Options.h"
#include "file_names.h"
#include "input/read_cloud.h"
#include "input/readers.h"

#include <fstream>

namespace program {

std::unique_ptr<Byte_source> open_bytes(const std::string& path)
{
  if(!is_gzip(path))
    return std::make_unique<File_source>(path);
  if constexpr(has_gzip)
    return open_gzip(path);
  throw std::runtime_error("this program was built without zlib; decompress the file with gunzip");
}

namespace {

std::string known_inputs()
{
  return std::string(".ply, .las, ") + (has_laszip ? ".laz, " : "") + ".pcd, .off, .ptx, " + table_names() +
         (has_gzip ? ", or one of these with .gz" : "");
}

// The format that the first bytes tell, or nothing.
std::string format_of_bytes(const std::string& path)
{
  std::string bytes(8, '\0');
  std::ifstream(path, std::ios::binary).read(bytes.data(), std::streamsize(bytes.size()));
  for(const auto& [beginning, format] : {std::pair<const char*, const char*>("ply\n", "ply"),
                                         {"ply\r", "ply"},
                                         {"LASF", "las"},
                                         {"# .PCD", "pcd"},
                                         {"OFF", "off"}})
    if(bytes.compare(0, std::strlen(beginning), beginning) == 0)
      return format;
  return "";
}

void check_format(const std::string& path, const std::string& given)
{
  const std::string extension = input_format(path, given);
  if(is_input_extension(extension))
    return;
  if(extension == ".e57" || extension == ".rcp")
    throw_error("files ", extension, " are not read; convert to LAS, PLY or PCD, for example with ",
                "CloudCompare or PDAL");
  if(extension == ".stl" || extension == ".obj" || extension == ".glb")
    throw_error("meshes ", extension, " are not read; convert to PLY or OFF, and give --sample N, ",
                "the number of points on its faces");
  const std::string format = format_of_bytes(path);
  throw_error("unknown format '", extension, "', expected ", known_inputs(), "; --format ",
              (format.empty() ? "NAME tells it" : format + " reads it as what its first bytes say"));
}

void check_file(const std::string& path, const Input_settings& settings)
{
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if(status.type() == fs::file_type::not_found)
    throw std::runtime_error("no such file");
  if(status.type() == fs::file_type::directory)
    throw std::runtime_error("is a directory");
  if(status.type() != fs::file_type::regular)
    throw_error("is not a regular file", (error ? " (" + error.message() + ")" : ""));
  if(fs::file_size(path, error) == 0)
    throw std::runtime_error("is empty");
  errno = 0;
  if(!std::ifstream(path, std::ios::binary))
    throw_error("cannot be opened (", std::strerror(errno), ")");
  check_format(path, settings.format);
}

void read_format(const std::string& path, const Input_settings& settings, Point_set& points, Input_notes& notes)
{
  const std::unique_ptr<Byte_source> file = open_bytes(path);
  const std::string extension = input_format(path, settings.format);
  if(is_las(extension))
    return read_las(*file, path, settings, points, notes);
  if(is_table(extension))
    return read_table(*file, extension, settings, points, notes);
  if(extension == ".pcd")
    return read_pcd(*file, settings, points, notes);
  if(extension == ".ptx")
    return read_ptx(*file, settings, points, notes);
  if(extension == ".ply")
    return read_ply(*file, settings, points, notes);
  read_off(*file, settings, points, notes);
}

// What to say of a file without points that are taken.
std::string why_no_points(const Input_settings& settings, const Input_notes& notes)
{
  if(notes.box.xmin() <= notes.box.xmax())
    return "has no points in the box of --crop" + std::string(settings.classes.empty() ? "" : " of the --classes") +
           ": its own is " + text_of(notes.box);
  return settings.classes.empty() ? "has no points" : "has no points of the --classes";
}

void check_points(Point_set& points)
{
  if(std::none_of(points.begin(), points.end(), [&](Point_set::Index i) { return is_finite(points.point(i)); }))
    throw_error("none of its ", points.size(), " points has finite coordinates");
  // Some writers fill the fields of normals that they do not have with zeros.
  if(points.has_normal_map() &&
     std::none_of(points.begin(), points.end(), [&](Point_set::Index i) { return is_usable_normal(points.normal(i)); }))
    points.remove_normal_map();
}

// Calls f with the bit of each attribute, its word, whether the points have it, and what adds or removes it.
template <class F>
void for_each_attribute(Point_set& points, F f)
{
  const auto visit_property = [&](Attributes bit, const char* word, const char* name, auto value) {
    using T = decltype(value);
    f(bit, word, points.has_property_map<T>(name), [&points, name](bool is_kept) {
      if(is_kept) {
        points.add_property_map<T>(name);
      } else {
        auto map = find_property<T>(points, name);
        points.remove_property_map(*map);
      }
    });
  };
  f(normals_bit, "normals", points.has_normal_map(), [&points](bool is_kept) {
    if(is_kept)
      points.add_normal_map();
    else
      points.remove_normal_map();
  });
  visit_property(colors_bit, "colors", color_name, Input_color());
  visit_property(intensity_bit, "intensity", intensity_name, float());
  visit_property(classification_bit, "classification", classification_name, std::uint8_t());
}

Attributes attributes_of(Point_set& points)
{
  Attributes attributes = 0;
  for_each_attribute(points,
                     [&](Attributes bit, const char*, bool is_there, auto) { attributes |= is_there ? bit : 0; });
  return attributes;
}

// Both have the same attributes then.
void reduce_attributes(Point_set& more, Input_cloud& cloud)
{
  const Attributes attributes = attributes_of(more);
  cloud.of_all &= attributes;
  cloud.of_some |= attributes;
  keep_attributes(cloud.of_all, more);
  keep_attributes(cloud.of_all, cloud.points);
}

[[noreturn]] void rethrow_with(const std::string& path, const std::runtime_error& e)
{
  check_signals(); // what a signal has cut off is no fault of the file
  throw_error(path, ": ", e.what());
}

} // namespace

std::string names_of(Attributes attributes)
{
  std::string names;
  Point_set none;
  for_each_attribute(none, [&](Attributes bit, const char* word, bool, auto) {
    if((attributes & bit) != 0)
      names += (names.empty() ? "" : ", ") + std::string(word);
  });
  return names;
}

void keep_attributes(Attributes kept, Point_set& points)
{
  for_each_attribute(points, [&](Attributes bit, const char*, bool is_there, auto set) {
    const bool is_kept = (kept & bit) != 0;
    if(is_kept != is_there && (is_there || points.empty()))
      set(is_kept);
  });
}

void read_cloud(const std::string& path, const Input_settings& settings, bool may_be_empty, Point_set& points,
                Input_notes& notes)
{
  try {
    check_file(path, settings);
    read_format(path, settings, points, notes);
    check_signals();
    if(!points.empty())
      return check_points(points);
    const std::string message = why_no_points(settings, notes);
    if(!may_be_empty)
      throw std::runtime_error(message);
    notes.warnings.push_back(message);
    points = Point_set(); // without properties
  } catch(const Interrupted&) {
    throw;
  } catch(const std::runtime_error& e) {
    rethrow_with(path, e);
  }
}

void check_inputs(const std::vector<std::string>& paths, const std::vector<std::size_t>& chosen,
                  const Input_settings& settings)
{
  for(std::size_t input : chosen) {
    try {
      check_file(paths[input], settings);
    } catch(const std::runtime_error& e) {
      rethrow_with(paths[input], e);
    }
  }
}

void read_clouds(const std::vector<std::string>& paths, const std::vector<std::size_t>& chosen,
                 const Input_settings& settings, Input_cloud& cloud)
{
  for(std::size_t input : chosen) {
    const std::string& path = paths[input];
    const std::size_t first = cloud.points.size();
    Point_set next;
    Point_set& points = first == 0 ? cloud.points : next;
    Input_notes notes;
    read_cloud(path, settings, paths.size() > 1, points, notes);
    if(!points.empty())
      reduce_attributes(points, cloud);
    for(std::string& warning : notes.warnings)
      warning.insert(0, path + ": ");
    if(first > 0)
      cloud.points.join(next);
    cloud.parts.push_back({input, first, cloud.points.size(), notes});
  }
}

} // namespace program
