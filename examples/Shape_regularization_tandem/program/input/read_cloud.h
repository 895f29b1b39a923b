// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads a cloud with CGAL's readers, and reports in one line what is wrong with a file
// that they cannot read, or would misread without a word.

#ifndef DETECT_PLANES_READ_CLOUD_H
#define DETECT_PLANES_READ_CLOUD_H

#include "extension.h"
#include "input/ply_points.h"
#include "input/text_points.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Point_set_3.h>
#include <CGAL/Point_set_3/IO.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>

namespace program {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_set = CGAL::Point_set_3<Kernel::Point_3>;

// CGAL's readers report on std::cerr; their message becomes part of our one line.
class Captured_messages {
public:
  Captured_messages() : previous(std::cerr.rdbuf(text.rdbuf())) {}
  ~Captured_messages() { std::cerr.rdbuf(previous); }
  Captured_messages(const Captured_messages&) = delete;
  Captured_messages& operator=(const Captured_messages&) = delete;

  std::string first_line() const { return text.str().substr(0, text.str().find('\n')); }

private:
  std::ostringstream text;
  std::streambuf* previous;
};

inline void check_file(const std::string& path)
{
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if(status.type() == fs::file_type::not_found)
    throw std::runtime_error(path + ": no such file");
  if(status.type() == fs::file_type::directory)
    throw std::runtime_error(path + ": is a directory");
  if(status.type() != fs::file_type::regular)
    throw std::runtime_error(path + ": is not a regular file" + (error ? " (" + error.message() + ")" : ""));
  if(fs::file_size(path, error) == 0)
    throw std::runtime_error(path + ": is empty");
  errno = 0;
  if(!std::ifstream(path, std::ios::binary))
    throw std::runtime_error(path + ": cannot be opened (" + std::strerror(errno) + ")");

  const std::string extension = lower_case_extension(path);
#ifdef CGAL_LINKED_WITH_LASLIB
  const bool is_las = extension == ".las";
#else
  const bool is_las = false;
#endif
  if(extension != ".ply" && extension != ".xyz" && extension != ".pwn" && extension != ".off" && !is_las)
    throw std::runtime_error(path + ": unknown format '" + extension + "', expected .ply, .xyz, .pwn, .off" +
                             (extension == ".las" ? " (this program was built without LASlib)" : ""));
}

inline bool is_finite(const Kernel::Point_3& p)
{
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

inline bool is_usable_normal(const Kernel::Vector_3& v)
{
  return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z()) && v != CGAL::NULL_VECTOR;
}

inline void check_points(const std::string& path, Point_set& points)
{
  if(points.empty())
    throw std::runtime_error(path + ": has no points");
  if(std::none_of(points.begin(), points.end(), [&](Point_set::Index i) { return is_finite(points.point(i)); }))
    throw std::runtime_error(path + ": none of its " + std::to_string(points.size()) +
                             " points has finite coordinates");
  // Some writers fill the fields of normals that they do not have with zeros.
  if(points.has_normal_map() &&
     std::none_of(points.begin(), points.end(), [&](Point_set::Index i) { return is_usable_normal(points.normal(i)); }))
    points.remove_normal_map();
}

inline Point_data find_points(const std::string& path, const std::string& extension)
{
  if(extension == ".ply")
    return find_ply_points(path);
  if(extension == ".off")
    return find_off_points(path);
  if(extension != ".las")
    return find_xyz_points(path);
  return {};
}

inline bool read_points(const std::string& path, const Point_data& data, Point_set& points)
{
  const std::string extension = lower_case_extension(path);
  if(extension == ".las")
    return CGAL::IO::read_point_set(path, points);
  Input_buffer in(path, data.body, data.header);
  std::istream stream(&in);
  if(extension == ".off")
    return CGAL::IO::read_OFF(stream, points);
  if(extension != ".ply")
    return CGAL::IO::read_XYZ(stream, points);
  const bool is_read = CGAL::IO::read_PLY(stream, points);
  // CGAL takes what follows a number for the next one: .5 after the 1 of 1.5, where an integer is expected.
  skip_blanks(in);
  if(is_read && in.left() > 0)
    throw std::runtime_error("a value is not of the type that the header says");
  return is_read;
}

// What a signal has cut off is no fault of the file.
[[noreturn]] inline void fail_to_read(const std::string& path, const std::string& reason)
{
  if(is_interrupted())
    throw Interrupted();
  throw std::runtime_error(path + ": " + reason);
}

inline void read_cloud(const std::string& path, Point_set& points)
{
  check_file(path);
  Point_data data;
  try {
    data = find_points(path, lower_case_extension(path));
  } catch(const std::runtime_error& e) {
    fail_to_read(path, e.what());
  }
  bool is_read = false;
  std::string reason;
  try {
    const Captured_messages messages;
    is_read = read_points(path, data, points);
    reason = messages.first_line();
  } catch(const std::bad_alloc&) {
    throw;
  } catch(const std::exception& e) {
    reason = e.what();
  }
  if(!is_read || points.size() < data.count || is_interrupted())
    fail_to_read(path, "unreadable after point " + std::to_string(points.size()) +
                         (data.count > 0 ? " of " + std::to_string(data.count) : "") +
                         (reason.empty() ? "" : " (" + reason + ")"));
  if(data.count > 0 && points.size() > data.count)
    fail_to_read(path, "has " + std::to_string(points.size()) + " rows of points, " + std::to_string(data.count) +
                         " announced");
  check_points(path, points);
}

} // namespace program

#endif // DETECT_PLANES_READ_CLOUD_H
