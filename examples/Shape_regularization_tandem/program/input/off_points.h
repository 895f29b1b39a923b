// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds the points in .off files: CGAL's reader passes over any row that is no point, so that other rows follow in its
// place.

#ifndef DETECT_PLANES_OFF_POINTS_H
#define DETECT_PLANES_OFF_POINTS_H

#include "input/Input_buffer.h"

#include <istream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace program {

inline std::size_t checked_count(long long n, const char* items)
{
  if(n < 0)
    throw std::runtime_error("announces " + std::to_string(n) + ' ' + items);
  return std::size_t(n);
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
inline Point_data find_off_points(Byte_source& file)
{
  Input_buffer in(file);
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

#endif // DETECT_PLANES_OFF_POINTS_H
