// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds the points in .xyz and .off files: CGAL's readers pass over a first row of an .xyz file that is no point, and
// over any row of an .off file that is none, so that other rows follow in its place.

#ifndef DETECT_PLANES_TEXT_POINTS_H
#define DETECT_PLANES_TEXT_POINTS_H

#include "input/Input_buffer.h"

#include <CGAL/IO/io.h>

#include <istream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace program {

inline bool is_point(const std::string& row)
{
  std::istringstream in(row);
  double x, y, z;
  return bool(in >> CGAL::IO::iformat(x) >> CGAL::IO::iformat(y) >> CGAL::IO::iformat(z));
}

inline std::size_t checked_count(long long n, const char* items)
{
  if(n < 0)
    throw std::runtime_error("announces " + std::to_string(n) + ' ' + items);
  return std::size_t(n);
}

// The first row may be the number of points, which CGAL passes over.
inline Point_data find_xyz_points(const std::string& path)
{
  Input_buffer in(path);
  const Byte_range whole = {0, in.left()};
  std::istream stream(&in);
  std::string row;
  std::getline(stream, row);
  const bool is_empty = row.find_first_not_of(' ') == std::string::npos;
  if(is_empty || row[0] == '#' || is_point(row))
    return {"", whole, 0};
  std::istringstream words(row);
  long long count = 0;
  std::string more;
  if(!(words >> count) || words >> more)
    throw std::runtime_error("row 1 is neither a point nor the number of points (comments begin with #)");
  return {"", whole, checked_count(count, "points")};
}

// The next row that is neither empty nor a comment.
inline bool next_row(std::istream& in, std::string& row)
{
  while(std::getline(in, row)) {
    const std::size_t first = row.find_first_not_of(" \t\r\v\f");
    if(first != std::string::npos && row[first] != '#')
      return true;
  }
  return false;
}

inline std::size_t count_rows(std::istream& in, std::size_t most)
{
  std::string row;
  std::size_t count = 0;
  while(count < most && next_row(in, row))
    ++count;
  return count;
}

// The numbers of points, faces and edges may stand beside the word OFF, or on a row of their own.
inline Point_data find_off_points(const std::string& path)
{
  Input_buffer in(path);
  std::istream stream(&in);
  std::string row, word;
  next_row(stream, row);
  std::istringstream words(row);
  if(!(words >> word) || (word != "OFF" && word != "NOFF"))
    throw std::runtime_error("the first word is not OFF or NOFF");
  if((words >> std::ws).eof()) {
    next_row(stream, row);
    words = std::istringstream(row);
  }
  long long points = 0, faces = 0, edges = 0;
  if(!(words >> points >> faces >> edges))
    throw std::runtime_error("the numbers of points, faces and edges are missing");
  Point_data data{word + '\n' + std::to_string(points) + " 0 0\n", {in.position(), 0}, checked_count(points, "points")};
  const std::size_t rows = count_rows(stream, data.count);
  data.body.last = in.position();
  if(rows < data.count)
    throw std::runtime_error("is truncated: " + std::to_string(data.count) + " points announced, " +
                             std::to_string(rows) + " rows found");
  if(count_rows(stream, checked_count(faces, "faces")) < std::size_t(faces))
    throw std::runtime_error("is truncated: less rows of faces than announced");
  return data;
}

} // namespace program

#endif // DETECT_PLANES_TEXT_POINTS_H
