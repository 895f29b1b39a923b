// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/read_cloud.h"
#include "Captured_messages.h"

#include "formats.h"
#include "input/off_points.h"
#include "input/ply_attributes.h"
#include "input/ply_points.h"
#include "input/read_las.h"
#include "input/read_pcd.h"
#include "input/read_table.h"

#include <CGAL/Point_set_3/IO.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <new>
#include <sstream>
#include <stdexcept>

namespace program {

namespace {

void check_format(const std::string& path)
{
  const std::string extension = input_extension(path);
  if(extension == ".e57")
    throw std::runtime_error("E57 is not read; convert it to LAS, PLY or PCD with CloudCompare or PDAL, for example");
  if(!is_cloud(path))
    throw std::runtime_error("unknown format '" + extension + "', expected " + known_inputs +
                             ", or one of these with .gz");
}

void check_file(const std::string& path)
{
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if(status.type() == fs::file_type::not_found)
    throw std::runtime_error("no such file");
  if(status.type() == fs::file_type::directory)
    throw std::runtime_error("is a directory");
  if(status.type() != fs::file_type::regular)
    throw std::runtime_error("is not a regular file" + (error ? " (" + error.message() + ")" : ""));
  if(fs::file_size(path, error) == 0)
    throw std::runtime_error("is empty");
  errno = 0;
  if(!std::ifstream(path, std::ios::binary))
    throw std::runtime_error(std::string("cannot be opened (") + std::strerror(errno) + ")");
  check_format(path);
}

bool read_by_cgal(Byte_source& file, const Point_data& data, bool is_off, Point_set& points)
{
  Input_buffer in(file, data.body, data.header);
  std::istream stream(&in);
  if(is_off)
    return CGAL::IO::read_OFF(stream, points);
  const bool is_read = CGAL::IO::read_PLY(stream, points);
  // CGAL takes what follows a number for the next one: .5 after the 1 of 1.5, where an integer is expected.
  skip_blanks(in);
  if(is_read && in.left() > 0)
    throw std::runtime_error("a value is not of the type that the header says");
  return is_read;
}

void read_ply_or_off(Byte_source& file, bool is_off, Point_set& points)
{
  const Point_data data = is_off ? find_off_points(file) : find_ply_points(file);
  bool is_read = false;
  std::string reason;
  try {
    const Captured_messages messages;
    is_read = read_by_cgal(file, data, is_off, points);
    reason = messages.first_line();
  } catch(const std::bad_alloc&) {
    throw;
  } catch(const std::exception& e) {
    reason = e.what();
  }
  if(!is_read || points.size() < data.count)
    throw std::runtime_error("unreadable after point " + std::to_string(points.size()) +
                             (data.count > 0 ? " of " + std::to_string(data.count) : "") +
                             (reason.empty() ? "" : " (" + reason + ")"));
  if(data.count > 0 && points.size() > data.count)
    throw std::runtime_error("has " + std::to_string(points.size()) + " rows of points, " + std::to_string(data.count) +
                             " announced");
}

// The points of the classes, in their order.
void keep_classes(const std::vector<int>& classes, Point_set& points)
{
  const auto classification = find_property<std::uint8_t>(points, classification_name);
  if(!classification)
    throw std::runtime_error("has no property 'classification', which --classes needs");
  Point_set kept;
  kept.copy_properties(points);
  for(Point_set::Index i : points)
    if(std::find(classes.begin(), classes.end(), int((*classification)[i])) != classes.end())
      kept.insert(points, i);
  points = kept;
}

void read_format(const std::string& path, const Input_settings& settings, Point_set& points, Input_notes& notes)
{
  const std::unique_ptr<Byte_source> file = open_bytes(path);
  const std::string extension = input_extension(path);
  if(is_las(path))
    return read_las(*file, path, settings, points, notes);
  if(is_table(path))
    return read_table(*file, path, settings, points, notes);
  if(extension == ".pcd")
    return read_pcd(*file, settings, points);
  read_ply_or_off(*file, extension == ".off", points);
  convert_attributes(points);
  if(!settings.classes.empty())
    keep_classes(settings.classes, points);
}

void check_points(const Input_settings& settings, Point_set& points)
{
  if(points.empty())
    throw std::runtime_error(settings.classes.empty() ? "has no points" : "has no points of the --classes");
  if(std::none_of(points.begin(), points.end(), [&](Point_set::Index i) { return is_finite(points.point(i)); }))
    throw std::runtime_error("none of its " + std::to_string(points.size()) + " points has finite coordinates");
  // Some writers fill the fields of normals that they do not have with zeros.
  if(points.has_normal_map() &&
     std::none_of(points.begin(), points.end(), [&](Point_set::Index i) { return is_usable_normal(points.normal(i)); }))
    points.remove_normal_map();
}

template <class T>
void remove_named(Point_set& points, const char* name)
{
  auto map = find_property<T>(points, name);
  if(map)
    points.remove_property_map(*map);
}

// Removes what only one of the clouds has, and tells the word for it.
template <class T>
void remove_different(Point_set& a, Point_set& b, const char* name, const char* word, std::string& words)
{
  if(a.has_property_map<T>(name) == b.has_property_map<T>(name))
    return;
  remove_named<T>(a, name);
  remove_named<T>(b, name);
  words += (words.empty() ? "" : ", ") + std::string(word);
}

void append(Point_set& points, Point_set& more, std::string& removed)
{
  if(points.has_normal_map() != more.has_normal_map()) {
    points.remove_normal_map();
    more.remove_normal_map();
    removed += removed.empty() ? "normals" : ", normals";
  }
  remove_different<Input_color>(points, more, color_name, "colors", removed);
  remove_different<float>(points, more, intensity_name, "intensity", removed);
  remove_different<std::uint8_t>(points, more, classification_name, "classification", removed);
  points.join(more);
}

} // namespace

void read_cloud(const std::string& path, const Input_settings& settings, Point_set& points, Input_notes& notes)
{
  try {
    check_file(path);
    read_format(path, settings, points, notes);
    if(is_interrupted())
      throw Interrupted();
    check_points(settings, points);
  } catch(const Interrupted&) {
    throw;
  } catch(const std::runtime_error& e) {
    if(is_interrupted()) // what a signal has cut off is no fault of the file
      throw Interrupted();
    throw std::runtime_error(path + ": " + e.what());
  }
}

Input_notes read_clouds(const std::vector<std::string>& paths, const Input_settings& settings, Point_set& points)
{
  Input_notes notes;
  std::string removed;
  for(const std::string& path : paths) {
    const bool is_first = points.empty();
    Point_set next;
    Input_notes of_file;
    read_cloud(path, settings, is_first ? points : next, of_file);
    for(const auto& [word, text] : of_file.lines)
      notes.lines.emplace_back(word, text + (paths.size() > 1 ? " (" + path + ")" : ""));
    for(const std::string& warning : of_file.warnings)
      notes.warnings.push_back(path + ": " + warning);
    if(!notes.las_frame)
      notes.las_frame = of_file.las_frame;
    if(!is_first)
      append(points, next, removed);
  }
  if(!removed.empty())
    notes.lines.emplace_back("left out", removed + ": not all of the inputs have them");
  return notes;
}

} // namespace program
