// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds the points in .off files: CGAL's reader passes over any row that is no point, so that other rows follow in its
// place.

#ifndef DETECT_PLANES_OFF_POINTS_H
#define DETECT_PLANES_OFF_POINTS_H

#include "input/Text_lines.h"

#include <sstream>
#include <stdexcept>
#include <string>

namespace program {

// What there is to read of a file. CGAL's reader gets a header in place of the one of the file, and the bytes of the points.
struct Off_parts {
  std::string header;
  Byte_range points, faces;
  std::size_t number_of_points, number_of_faces;
};

inline std::size_t checked_count(long long n, const char* items)
{
  if(n < 0)
    throw std::runtime_error("announces " + std::to_string(n) + ' ' + items);
  return std::size_t(n);
}

// The next row that is neither empty nor a comment.
inline bool next_row(Text_lines& lines)
{
  while(lines.next_filled())
    if(lines.row().text[first_not_blank(lines.row().text)] != '#')
      return true;
  return false;
}

inline std::size_t count_rows(Text_lines& lines, std::size_t most)
{
  std::size_t count = 0;
  while(count < most && next_row(lines))
    ++count;
  return count;
}

// Numbers are separated by blanks.
inline std::size_t count_points(Text_lines& lines, std::size_t most)
{
  std::size_t count = 0;
  for(; count < most && next_row(lines); ++count) {
    const std::string_view text = lines.row().text;
    if(text.substr(0, text.find('#')).find(',') != text.npos)
      fail_at_row(lines.row().number, "has a comma (write numbers with a decimal point, and blanks between them)");
  }
  return count;
}

// The numbers of points, faces and edges may stand beside the word OFF, or on a row of their own.
inline Off_parts find_off_parts(Byte_source& file)
{
  Input_buffer in(file);
  Text_lines lines(in);
  std::string word;
  next_row(lines);
  std::istringstream words(lines.row().text);
  if(!(words >> word) || (word != "OFF" && word != "NOFF"))
    throw std::runtime_error("the first word is not OFF or NOFF");
  if((words >> std::ws).eof()) {
    next_row(lines);
    words = std::istringstream(lines.row().text);
  }
  long long points = 0, faces = 0, edges = 0;
  if(!(words >> points >> faces >> edges))
    throw std::runtime_error("the numbers of points, faces and edges are missing");
  Off_parts parts = {word + '\n' + std::to_string(points) + " 0 0\n",
                     {in.position(), 0},
                     {0, 0},
                     checked_count(points, "points"),
                     checked_count(faces, "faces")};
  const std::size_t rows = count_points(lines, parts.number_of_points);
  parts.points.last = parts.faces.first = in.position();
  if(rows < parts.number_of_points)
    throw std::runtime_error("is truncated: " + std::to_string(parts.number_of_points) + " points announced, " +
                             std::to_string(rows) + " rows found");
  if(count_rows(lines, parts.number_of_faces) < parts.number_of_faces)
    throw std::runtime_error("is truncated: less rows of faces than announced");
  parts.faces.last = in.position();
  return parts;
}

} // namespace program

#endif // DETECT_PLANES_OFF_POINTS_H
