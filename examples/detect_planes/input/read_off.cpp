// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/readers.h"
#include "messages.h"

#include <CGAL/Point_set_3/IO/OFF.h>

#include <istream>
#include <new>

namespace program {

namespace {

// --- Finds the points in .off files: CGAL's reader passes over any row that is no point, so that other rows follow in its
// place.

// What there is to read of a file. CGAL's reader gets a header in place of the one of the file, and the bytes of the points.
struct Off_parts {
  std::string header;
  Byte_range points, faces;
  std::size_t number_of_points, number_of_faces;
};

std::size_t checked_count(long long n, const char* items)
{
  if(n < 0)
    throw_error("announces ", n, ' ', items);
  return std::size_t(n);
}

// The next row that is neither empty nor a comment.
bool next_row(Text_lines& lines)
{
  while(lines.next_filled())
    if(lines.row().text[first_not_blank(lines.row().text)] != '#')
      return true;
  return false;
}

std::size_t count_rows(Text_lines& lines, std::size_t most)
{
  std::size_t count = 0;
  while(count < most && next_row(lines))
    ++count;
  return count;
}

// Numbers are separated by blanks.
std::size_t count_points(Text_lines& lines, std::size_t most)
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
Off_parts find_off_parts(Byte_source& file)
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
    throw_error("is truncated: ", parts.number_of_points, " points announced, ", rows, " rows found");
  if(count_rows(lines, parts.number_of_faces) < parts.number_of_faces)
    throw std::runtime_error("is truncated: less rows of faces than announced");
  parts.faces.last = in.position();
  return parts;
}

// ---

void read_points(Byte_source& file, const Off_parts& parts, Point_set& points)
{
  bool is_read = false;
  std::string reason;
  try {
    const Captured_messages messages;
    Input_buffer in(file, parts.points, parts.header);
    std::istream stream(&in);
    is_read = CGAL::IO::read_OFF(stream, points);
    reason = messages.first_line();
  } catch(const std::bad_alloc&) {
    throw;
  } catch(const std::exception& e) {
    reason = e.what();
  }
  if(!is_read || points.size() < parts.number_of_points)
    throw_error("unreadable after point ", points.size(), " of ", parts.number_of_points,
                (reason.empty() ? "" : " (" + reason + ")"));
  if(points.size() > parts.number_of_points)
    throw_error("has ", points.size(), " rows of points, ", parts.number_of_points, " announced");
}

// The corners of a face, whose row begins with their number. A color may follow them.
std::vector<double> corners_of(std::size_t face, const std::string& row)
{
  Table_values values(row, ' ');
  std::string_view text;
  const auto next = [&] {
    const std::optional<double> number = values.next(text) ? parse_number(text) : std::nullopt;
    if(!number)
      throw_error("face ", face, " is not the number of its corners, and the corners");
    return *number;
  };
  std::vector<double> corners;
  for(double count = next(); double(corners.size()) < count;)
    corners.push_back(next());
  return corners;
}

// In place of the corners.
void sample_faces(Byte_source& file, const Off_parts& parts, std::size_t number, Point_set& points)
{
  Mesh_faces faces(points);
  Input_buffer in(file, parts.faces, "");
  Text_lines lines(in);
  for(std::size_t i = 0; i < parts.number_of_faces && next_row(lines); ++i)
    faces.add(corners_of(i + 1, lines.row().text));
  points = faces.sample(number);
}

} // namespace

void read_off(Byte_source& file, const Input_settings& settings, Point_set& points, Input_notes& notes)
{
  check_no_attributes(settings, "is OFF, whose points");
  const Off_parts parts = find_off_parts(file);
  const bool is_sampled = samples_faces(parts.number_of_faces, settings, notes);
  read_points(file, parts, points);
  if(is_sampled)
    sample_faces(file, parts, *settings.sample, points);
}

} // namespace program
