// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The columns of text tables, by name or by their values.

#ifndef DETECT_PLANES_TABLE_COLUMNS_H
#define DETECT_PLANES_TABLE_COLUMNS_H

#include "input/find_name.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace program {

// `tolerance` is that of --tolerance-column, `none` is passed over.
enum class Column { x, y, z, nx, ny, nz, red, green, blue, intensity, classification, tolerance, none };

constexpr std::array<const char*, 13> column_names = {
  "x", "y", "z", "nx", "ny", "nz", "r", "g", "b", "intensity", "classification", "tolerance", "_"};

// The values of a row, by column.
using Row_values = std::array<double, std::size_t(Column::none)>;

inline const char* name_of(Column c) { return column_names[std::size_t(c)]; }

inline bool is_in(std::string_view name, std::initializer_list<const char*> names)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

inline bool is_separator(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == ',' || c == ';'; }

// Names as CloudCompare, PCL, PDAL and others write them; `none` for any other.
inline Column column_of_name(std::string_view text)
{
  std::string name;
  for(unsigned char c : text)
    if(c != '"' && c != '\'' && c != '_' && !is_separator(char(c)))
      name += char(std::tolower(c));
  if(name.compare(0, 6, "scalar") == 0)
    name.erase(0, 6);
  static const std::array<std::initializer_list<const char*>, 11> known = {{{"x"},
                                                                            {"y"},
                                                                            {"z"},
                                                                            {"nx", "normalx"},
                                                                            {"ny", "normaly"},
                                                                            {"nz", "normalz"},
                                                                            {"r", "red", "diffusered"},
                                                                            {"g", "green", "diffusegreen"},
                                                                            {"b", "blue", "diffuseblue"},
                                                                            {"i", "intensity"},
                                                                            {"class", "classification"}}};
  for(std::size_t c = 0; c < known.size(); ++c)
    if(is_in(name, known[c]))
      return Column(c);
  return Column::none;
}

inline bool has_column(const std::vector<Column>& columns, Column c)
{
  return std::find(columns.begin(), columns.end(), c) != columns.end();
}

inline bool has_coordinates(const std::vector<Column>& columns)
{
  return has_column(columns, Column::x) && has_column(columns, Column::y) && has_column(columns, Column::z);
}

inline std::string names_of(const std::vector<Column>& columns)
{
  std::string names;
  for(Column c : columns)
    names += (names.empty() ? "" : " ") + std::string(name_of(c));
  return names;
}

// Normals and colors have three columns, or none: an incomplete triple is passed over.
inline bool remove_incomplete(std::vector<Column>& columns)
{
  bool is_changed = false;
  for(Column first : {Column::nx, Column::red}) {
    const auto is_in_triple = [first](Column c) { return c >= first && int(c) < int(first) + 3; };
    const auto count = std::count_if(columns.begin(), columns.end(), is_in_triple);
    is_changed = is_changed || (count != 0 && count != 3);
    if(count != 3)
      std::replace_if(columns.begin(), columns.end(), is_in_triple, Column::none);
  }
  return is_changed;
}

// The value of --columns; tolerance: that of --tolerance-column.
inline std::vector<Column> parse_columns(const std::string& text, const std::string& tolerance = "")
{
  std::vector<Column> columns;
  for(auto first = text.begin(); first != text.end();) {
    const auto last = std::find_if(first, text.end(), is_separator);
    const std::string name(first, last);
    first = std::find_if_not(last, text.end(), is_separator);
    if(name.empty())
      continue;
    const Column c = mean_the_same(name, tolerance) ? Column::tolerance : column_of_name(name);
    if(c == Column::none && !is_no_name(name))
      throw std::invalid_argument("--columns has '" + name +
                                  "', must be of x y z nx ny nz r g b intensity classification, or _ for a column to "
                                  "pass over");
    if(c != Column::none && has_column(columns, c))
      throw std::invalid_argument("--columns has '" + name + "' twice");
    columns.push_back(c);
  }
  if(!has_coordinates(columns))
    throw std::invalid_argument("--columns must have x, y and z");
  if(remove_incomplete(columns))
    throw std::invalid_argument("--columns must have all three of nx ny nz or of r g b, or none");
  if(!tolerance.empty() && !has_column(columns, Column::tolerance))
    throw std::invalid_argument("--columns has no '" + tolerance + "', which --tolerance-column names");
  return columns;
}

// The first rows of a table, all with as many values; NaN for what is no number.
using Sample = std::vector<std::vector<double>>;

constexpr double largest_error_of_length = .1; // of a normal, which should have length 1

// Most of the normals in the columns from `first` on have length 1.
bool are_normals(const Sample& rows, std::size_t first);

// Channels from 0 to 1, at least one of which is between.
bool are_real_colors(const Sample& rows, std::size_t first);

// The words of a line of names.
std::vector<std::string> names_of_header(std::string_view line);

// The columns of these names, or none if they do not name x, y and z.
std::vector<Column> columns_of_names(const std::vector<std::string>& names);

// The same for names of maps, such as Easting, Northing and Elevation. A unit in parentheses may follow them.
std::vector<Column> map_columns_of_names(const std::vector<std::string>& names);

// The same for longitude, latitude and height.
std::vector<Column> geographic_columns_of_names(const std::vector<std::string>& names);

// The first column has integers that rise by one from row to row, and three at least follow it. Not where the second one
// has always the same value: then both may be the coordinates of a raster.
bool counts_rows(const Sample& rows);

// The columns of a table without a line of names; one that counts the rows is passed over. In a .pts file the intensity
// comes before the colors; files .pwn and .xyzn have normals, those of .xyzrgb colors.
std::vector<Column> recognize_columns(const Sample& rows, const std::string& extension);

} // namespace program

#endif // DETECT_PLANES_TABLE_COLUMNS_H
