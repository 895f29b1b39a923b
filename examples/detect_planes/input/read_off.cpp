// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's reader passes over any row that is no point, so that other rows follow in its place: this one refuses them.

#include "input/readers.h"

namespace program {

namespace {

// The next row that is neither empty nor a comment.
bool next_row(Text_lines& lines)
{
  while(lines.next_filled())
    if(lines.row().text[first_not_blank(lines.row().text)] != '#')
      return true;
  return false;
}

struct Off_head {
  bool has_normals; // of all points
  std::size_t points, faces;
};

// The numbers of points, faces and edges may stand beside the word OFF, or on a row of their own.
Off_head read_head(Text_lines& lines)
{
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
  if(points < 0 || faces < 0)
    throw_error("announces ", points < 0 ? points : faces, points < 0 ? " points" : " faces");
  return {word == "NOFF", std::size_t(points), std::size_t(faces)};
}

// Numbers are separated by blanks. Three may follow the coordinates, the normal. False if the row is something else.
bool parse_point(const Text_row& row, bool has_normal, Point_row& point)
{
  if(row.text.substr(0, row.text.find('#')).find(',') != row.text.npos)
    fail_at_row(row.number, "has a comma (write numbers with a decimal point, and blanks between them)");
  std::istringstream in(row.text);
  if(!(in >> point.point[0] >> point.point[1] >> point.point[2]))
    return false;
  if(in >> point.normal[0])
    return bool(in >> point.normal[1] >> point.normal[2]);
  point.normal[0] = 0;
  return !has_normal;
}

// The corners of a face, whose row begins with their number. A color may follow them.
std::vector<double> corners_of(std::size_t face, const std::string& row)
{
  const Cells cells = values_of(row, ' ');
  const auto number_at = [&](std::size_t i) {
    const std::optional<double> number = i < cells.size() ? parse_number(cells[i]) : std::nullopt;
    if(!number)
      throw_error("face ", face, " does not have the number of its corners and the corners");
    return *number;
  };
  std::vector<double> corners;
  while(double(corners.size()) < number_at(0))
    corners.push_back(number_at(corners.size() + 1));
  return corners;
}

} // namespace

void read_off(Byte_source& file, const Input_settings& settings, Point_set& points, Input_notes& notes)
{
  check_no_attributes(settings, "is OFF, whose points");
  Input_buffer in(file);
  Text_lines lines(in);
  const Off_head head = read_head(lines);
  const Input_settings of_points = settings_of_corners(head.faces, settings);
  Cloud_builder builder(points, {true, false, false, false, false}, of_points, notes);
  for(std::size_t i = 0; i < head.points; ++i) {
    Point_row row;
    if(!next_row(lines))
      throw_error("is truncated: ", head.points, " points announced, ", i, " rows found");
    if(!parse_point(lines.row(), head.has_normals, row))
      fail_after(i, head.points);
    builder.add(row);
  }
  const bool is_sampled = settings.sample.value_or(0) > 0;
  Mesh_faces faces(points);
  for(std::size_t i = 0; i < head.faces; ++i) {
    if(!next_row(lines))
      throw std::runtime_error("is truncated: less rows of faces than announced");
    if(is_sampled)
      faces.add(corners_of(i + 1, lines.row().text));
  }
  if(samples_faces(head.faces, settings, notes))
    points = faces.sample(settings, notes);
}

} // namespace program
