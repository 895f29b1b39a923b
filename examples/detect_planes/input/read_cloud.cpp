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

void check_format(const std::string& path, const std::string& given)
{
  const std::string extension = input_format(path, given);
  if(is_input_extension(extension))
    return;
  if(is_in(extension, {".e57", ".rcp"}))
    throw_error("this program does not read ", extension, "; convert the file to LAS, PLY or PCD, for example with ",
                "CloudCompare or PDAL");
  if(is_in(extension, {".npy", ".npz"}))
    throw_error("this program does not read ", extension,
                "; write the array as text by numpy.savetxt('cloud.xyz', array), ", "or use the Python module");
  if(is_in(extension, {".vtk", ".vtp", ".vtu", ".splat"}))
    throw_error("this program does not read ", extension, "; convert the file to PLY, for example with ",
                (extension == ".splat" ? "SuperSplat" : "ParaView or meshio"));
  if(is_in(extension, {".stl", ".obj", ".glb"}))
    throw_error("this program does not read ", extension, "; convert the mesh to PLY or OFF, and pass --sample N, ",
                "the number of points on its faces");
  std::string bytes(8, '\0'), format; // that the first bytes tell, or nothing
  std::ifstream(path, std::ios::binary).read(bytes.data(), std::streamsize(bytes.size()));
  const std::pair<const char*, const char*> beginnings[] = {
    {"ply\n", "ply"}, {"ply\r", "ply"}, {"LASF", "las"}, {"# .PCD", "pcd"}, {"OFF", "off"}};
  for(const auto& [beginning, name] : beginnings)
    if(bytes.compare(0, std::strlen(beginning), beginning) == 0)
      format = name;
  throw_error("unknown format '", extension, "', expected .ply, .las, ", has_laszip ? ".laz, " : "",
              ".pcd, .off, .ptx, ", table_names(), has_gzip ? ", or one of these with .gz" : "", "; --format ",
              (format.empty() ? "NAME names the format" : format + " reads the file as what its first bytes say"));
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
  if(settings.keeps_records && settings.keeps_records(path)) {
    notes.records = std::make_shared<Input_records>();
    notes.records->format = extension;
  }
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

void check_points(Point_set& points)
{
  if(std::none_of(points.begin(), points.end(), [&](Point_set::Index i) { return is_finite(points.point(i)); }))
    throw_error("none of its ", points.size(), " points has finite coordinates");
  // Some writers fill the fields of normals that they do not have with zeros.
  if(points.has_normal_map() &&
     std::none_of(points.begin(), points.end(), [&](Point_set::Index i) { return is_usable_normal(points.normal(i)); }))
    points.remove_normal_map();
}

Attributes attributes_of(const Point_set& points)
{
  return (points.has_normal_map() ? normals_bit : 0) |
         (points.has_property_map<Input_color>(color_name) ? colors_bit : 0) |
         (points.has_property_map<float>(intensity_name) ? intensity_bit : 0) |
         (points.has_property_map<std::uint8_t>(classification_name) ? classification_bit : 0);
}

template <class T>
void keep_property(bool is_kept, const char* name, Point_set& points)
{
  if(is_kept && points.empty())
    points.add_property_map<T>(name);
  if(auto map = find_property<T>(points, name); map && !is_kept)
    points.remove_property_map(*map);
}

// f(), whose errors get the name of the file. What a signal has cut off is no fault of the file.
template <class F>
void name_file(const std::string& path, const F& f)
try {
  f();
} catch(const std::runtime_error& e) {
  check_signals();
  throw_error(path, ": ", e.what());
}

} // namespace

std::string names_of(Attributes attributes)
{
  std::string names;
  for(const auto& [bit, word] :
      {std::pair(normals_bit, "normals"), std::pair(colors_bit, "colors"), std::pair(intensity_bit, "intensity"),
       std::pair(classification_bit, "classification")})
    if((attributes & bit) != 0)
      names += (names.empty() ? "" : ", ") + std::string(word);
  return names;
}

void keep_attributes(Attributes kept, Point_set& points)
{
  if((kept & normals_bit) == 0)
    points.remove_normal_map();
  else if(points.empty())
    points.add_normal_map();
  keep_property<Input_color>((kept & colors_bit) != 0, color_name, points);
  keep_property<float>((kept & intensity_bit) != 0, intensity_name, points);
  keep_property<std::uint8_t>((kept & classification_bit) != 0, classification_name, points);
}

void read_cloud(const std::string& path, const Input_settings& settings, bool may_be_empty, Point_set& points,
                Input_notes& notes)
{
  name_file(path, [&] {
    check_file(path, settings);
    read_format(path, settings, points, notes);
    check_signals();
    if(!points.empty())
      return check_points(points);
    const bool is_cropped = notes.box.xmin() <= notes.box.xmax();
    const std::string message = text_of("has no points", is_cropped ? " in the box of --crop" : "",
                                        settings.classes.empty() ? "" : " of the --classes",
                                        is_cropped ? ": the box of its points is " + text_of(notes.box) : "");
    if(!may_be_empty)
      throw std::runtime_error(message);
    notes.warnings.push_back(message);
    points = Point_set(); // without properties
  });
}

void check_inputs(const std::vector<std::string>& paths, const std::vector<std::size_t>& chosen,
                  const Input_settings& settings)
{
  for(std::size_t input : chosen)
    name_file(paths[input], [&] { check_file(paths[input], settings); });
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
    if(!points.empty()) {
      cloud.of_all &= attributes_of(points);
      cloud.of_some |= attributes_of(points);
      for(Point_set* part : {&points, &cloud.points})
        keep_attributes(cloud.of_all, *part);
    }
    for(std::string& warning : notes.warnings)
      warning.insert(0, path + ": ");
    if(first > 0)
      cloud.points.join(next);
    cloud.parts.push_back({input, first, cloud.points.size(), notes});
  }
}

} // namespace program
