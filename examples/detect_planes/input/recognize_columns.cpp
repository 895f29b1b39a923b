// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/table_columns.h"

#include "input/table_values.h"

#include <cmath>

namespace program {

namespace {

// Of the rows that have values there: some scanners write NaN where nothing came back.
template <class Is_right>
bool all_values(const Sample& rows, std::size_t first, Is_right is_right)
{
  std::size_t count = 0;
  for(const std::vector<double>& row : rows) {
    const double values[3] = {row[first], row[first + 1], row[first + 2]};
    if(std::any_of(values, values + 3, [](double x) { return std::isnan(x); }))
      continue;
    if(!std::all_of(values, values + 3, is_right))
      return false;
    ++count;
  }
  return count > 0;
}

bool are_integer_colors(const Sample& rows, std::size_t first)
{
  return all_values(rows, first, [](double x) { return x >= 0 && x <= 65535 && x == std::floor(x); });
}

bool is_number(const Sample& rows, std::size_t column)
{
  return std::none_of(rows.begin(), rows.end(), [=](const auto& row) { return std::isnan(row[column]); });
}

// Each but for the first of a kind is passed over.
template <class Column_of>
std::vector<Column> columns_by(const std::vector<std::string>& names, Column_of column_of)
{
  std::vector<Column> columns;
  for(const std::string& name : names) {
    const Column c = column_of(name);
    columns.push_back(has_column(columns, c) ? Column::none : c);
  }
  remove_incomplete(columns);
  return has_coordinates(columns) ? columns : std::vector<Column>();
}

// Without a unit in parentheses.
std::string map_name(const std::string& text)
{
  const std::string name = plain_name(text);
  return name.substr(0, name.find_first_of("(["));
}

Column column_of_map_name(const std::string& text)
{
  const std::string name = map_name(text);
  if(is_in(name, {"easting", "east", "e", "x"}))
    return Column::x;
  if(is_in(name, {"northing", "north", "n", "y"}))
    return Column::y;
  return is_in(name, {"elevation", "elev", "height", "h", "altitude", "alt", "z"}) ? Column::z : column_of_name(text);
}

Column column_of_geographic_name(const std::string& text)
{
  const std::string name = map_name(text);
  if(is_in(name, {"lon", "long", "longitude"}))
    return Column::x;
  if(is_in(name, {"lat", "latitude"}))
    return Column::y;
  return is_in(name, {"height", "h", "altitude", "alt", "elevation"}) ? Column::z : column_of_name(text);
}

void place(std::vector<Column>& columns, std::size_t first, Column name)
{
  for(int i = 0; i < 3; ++i)
    columns[first + std::size_t(i)] = Column(int(name) + i);
}

} // namespace

bool are_normals(const Sample& rows, std::size_t first)
{
  std::size_t unit = 0, other = 0;
  for(const std::vector<double>& row : rows) {
    const double length =
      std::sqrt(row[first] * row[first] + row[first + 1] * row[first + 1] + row[first + 2] * row[first + 2]);
    const bool is_unit = std::fabs(length - 1) <= largest_error_of_length;
    unit += is_unit ? 1 : 0;
    other += !is_unit && length > 0 ? 1 : 0;
  }
  return unit > 9 * other;
}

bool are_real_colors(const Sample& rows, std::size_t first)
{
  return all_values(rows, first, [](double x) { return x >= 0 && x <= 1; }) && !are_integer_colors(rows, first);
}

std::vector<std::string> names_of_header(std::string_view line)
{
  line.remove_prefix((std::min)(line.find_first_not_of(" \t#/"), line.size()));
  Table_values rest(line);
  std::vector<std::string> names;
  for(std::string_view name; rest.next(name);)
    names.emplace_back(name);
  return names;
}

std::vector<Column> columns_of_names(const std::vector<std::string>& names)
{
  return columns_by(names, column_of_name);
}

std::vector<Column> map_columns_of_names(const std::vector<std::string>& names)
{
  return columns_by(names, column_of_map_name);
}

std::vector<Column> geographic_columns_of_names(const std::vector<std::string>& names)
{
  return columns_by(names, column_of_geographic_name);
}

namespace {

// Of a table whose first column does not count the rows.
std::vector<Column> recognize_others(const Sample& rows, const std::string& extension)
{
  const std::size_t count = rows.empty() ? 0 : rows.front().size();
  if(count < 3)
    return {};
  std::vector<Column> columns(count, Column::none);
  place(columns, 0, Column::x);
  std::size_t c = 3;
  if(extension == ".pts" && (count == 4 || count == 7))
    columns[c++] = Column::intensity;
  const bool has_normals = extension == ".pwn" || extension == ".xyzn";
  if((has_normals || extension == ".xyzrgb") && count >= 6) {
    place(columns, c, has_normals ? Column::nx : Column::red);
    c += 3;
  }
  while(c + 3 <= count) {
    const bool is_normal = !has_column(columns, Column::nx) && are_normals(rows, c);
    const bool is_color =
      !is_normal && !has_column(columns, Column::red) && (are_integer_colors(rows, c) || are_real_colors(rows, c));
    if(is_normal || is_color)
      place(columns, c, is_normal ? Column::nx : Column::red);
    c += is_normal || is_color ? 3 : 1;
  }
  // A single number that is left is the intensity.
  const auto is_left = [](Column column) { return column == Column::none; };
  const auto left = std::find_if(columns.begin(), columns.end(), is_left);
  if(std::count_if(columns.begin(), columns.end(), is_left) == 1 && !has_column(columns, Column::intensity) &&
     is_number(rows, std::size_t(left - columns.begin())))
    *left = Column::intensity;
  return columns;
}

} // namespace

bool counts_rows(const Sample& rows)
{
  constexpr std::size_t fewest_rows = 10, fewest_columns = 4;
  if(rows.size() < fewest_rows || rows.front().size() < fewest_columns || std::floor(rows[0][0]) != rows[0][0])
    return false;
  bool is_second_constant = true;
  for(std::size_t i = 1; i < rows.size(); ++i) {
    if(rows[i][0] != rows[i - 1][0] + 1)
      return false;
    is_second_constant = is_second_constant && rows[i][1] == rows[0][1];
  }
  return !is_second_constant;
}

std::vector<Column> recognize_columns(const Sample& rows, const std::string& extension)
{
  if(counts_rows(rows)) {
    Sample others = rows;
    for(std::vector<double>& row : others)
      row.erase(row.begin());
    std::vector<Column> columns = recognize_others(others, extension);
    columns.insert(columns.begin(), Column::none);
    return columns;
  }
  return recognize_others(rows, extension);
}

} // namespace program
