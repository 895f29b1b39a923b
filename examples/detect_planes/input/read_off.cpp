// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/readers.h"

#include "input/Mesh_faces.h"
#include "input/off_points.h"
#include "input/table_values.h"
#include "messages.h"

#include <CGAL/Point_set_3/IO/OFF.h>

#include <istream>
#include <new>
#include <optional>
#include <stdexcept>
#include <vector>

namespace program {

namespace {

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
    throw std::runtime_error("unreadable after point " + std::to_string(points.size()) + " of " +
                             std::to_string(parts.number_of_points) + (reason.empty() ? "" : " (" + reason + ")"));
  if(points.size() > parts.number_of_points)
    throw std::runtime_error("has " + std::to_string(points.size()) + " rows of points, " +
                             std::to_string(parts.number_of_points) + " announced");
}

// The corners of a face, whose row begins with their number. A color may follow them.
std::vector<double> corners_of(std::size_t face, const std::string& row)
{
  Table_values values(row, ' ');
  std::string_view text;
  const auto next = [&] {
    const std::optional<double> number = values.next(text) ? parse_number(text) : std::nullopt;
    if(!number)
      throw std::runtime_error("face " + std::to_string(face) + " is not the number of its corners, and the corners");
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
