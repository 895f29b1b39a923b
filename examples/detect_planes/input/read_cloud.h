// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads clouds, and reports in one line what is wrong with a file that cannot be read, or would be misread without a
// word.

#ifndef DETECT_PLANES_READ_CLOUD_H
#define DETECT_PLANES_READ_CLOUD_H

#include "errors.h"
#include "file_names.h"
#include "input/point_set.h"

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace program {

// --- The values of a file that an option names.

inline bool is_separator(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == ',' || c == ';'; }

// What names differ by that mean the same: case, blanks and underscores, and the word that CloudCompare puts before.
inline std::string plain_name(std::string_view text)
{
  std::string name;
  for(char c : text)
    if(c != '"' && c != '\'' && c != '_' && !is_separator(c))
      name += char(std::tolower((unsigned char)(c)));
  return name.compare(0, 6, "scalar") == 0 && name.size() > 6 ? name.substr(6) : name;
}

// Names of what is passed over.
inline bool is_no_name(const std::string& name) { return plain_name(name).empty() || name == "-"; }

inline bool mean_the_same(const std::string& a, const std::string& b)
{
  return !is_no_name(a) && plain_name(a) == plain_name(b);
}

// The place of a name of --tolerance-column: the name itself, else the first that means the same.
// kind: what has these names, for the message.
inline std::size_t find_name(const std::vector<std::string>& names, const std::string& wanted, const std::string& kind)
{
  auto found = is_no_name(wanted) ? names.end() : std::find(names.begin(), names.end(), wanted);
  if(found == names.end())
    found = std::find_if(names.begin(), names.end(), [&](const auto& name) { return mean_the_same(name, wanted); });
  if(found != names.end())
    return std::size_t(found - names.begin());
  std::string all;
  for(const std::string& name : names)
    if(!is_no_name(name))
      all += (all.empty() ? "" : ", ") + name;
  throw_error("has no ", kind, " '", wanted, "', which --tolerance-column names; it has ",
              (all.empty() ? "none" : all));
}

// A box in the coordinates of the inputs, with its sides. It starts empty.
using Box = CGAL::Bbox_3;

// No point that is not finite is within, also where a side is open.
inline bool is_within(const double (&p)[3], const Box& box)
{
  for(int c = 0; c < 3; ++c)
    if(!(p[c] >= box.min(c) && p[c] <= box.max(c) && std::isfinite(p[c])))
      return false;
  return true;
}

// As the option --crop takes it.
inline std::string text_of(const Box& box)
{
  return text_of(std::setprecision(10), box.xmin(), ',', box.ymin(), ',', box.zmin(), ',', box.xmax(), ',', box.ymax(),
                 ',', box.zmax());
}

// --- The columns of text tables, by name or by their values.

// `tolerance` is that of --tolerance-column, `none` is passed over.
enum class Column { x, y, z, nx, ny, nz, red, green, blue, intensity, classification, tolerance, none };

constexpr std::array<const char*, 13> column_names = {
  "x", "y", "z", "nx", "ny", "nz", "r", "g", "b", "intensity", "classification", "tolerance", "_"};

// The values of a row, by column.
using Row_values = std::array<double, std::size_t(Column::none)>;

inline const char* name_of(Column c) { return column_names[std::size_t(c)]; }

// Names as CloudCompare, PCL, PDAL and others write them; `none` for any other.
inline Column column_of_name(std::string_view text)
{
  const std::string name = plain_name(text);
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

inline bool has_column(const std::vector<Column>& columns, Column c) { return is_in(c, columns); }

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
      throw_error<Usage_error>(
        "--columns has '", name,
        "', must be one of x y z nx ny nz r g b intensity classification, or _ for a column to skip");
    if(c != Column::none && has_column(columns, c))
      throw_error<Usage_error>("--columns has '", name, "' twice");
    columns.push_back(c);
  }
  if(!has_coordinates(columns))
    throw std::invalid_argument("--columns must have x, y and z");
  if(remove_incomplete(columns))
    throw std::invalid_argument("--columns must have all three of nx ny nz or of r g b, or none");
  if(!tolerance.empty() && !has_column(columns, Column::tolerance))
    throw_error<Usage_error>("--columns has no '", tolerance, "', which --tolerance-column names");
  return columns;
}

constexpr double largest_error_of_length = .1; // of a normal, which should have length 1

// ---

// How inputs are read.
struct Input_settings {
  std::vector<Column> columns; // of text tables; empty: recognized
  std::vector<int> classes;    // only these points; empty: all
  std::optional<Box> crop;     // only the points in it
  std::string tolerance;       // the column, property or field that has the tolerance of each point; empty: none has
  std::string format;          // the extension that tells the format; empty: that of each file
  bool has_decimal_commas = false;   // numbers of text tables
  std::optional<std::size_t> sample; // points to put on the faces of a mesh; 0: their corners
  // Whether an output has the format of this input, and so gets its records.
  std::function<bool(const std::string& path)> keeps_records;
  std::string label;                                      // of the shape: the records of points are kept without it,
  bool replaces_normals = false, replaces_colors = false; // and without what else the output has in its place
};

// `what` ends in the word that has no attributes but those of its format, as "is OFF, whose points".
inline void check_no_attributes(const Input_settings& settings, const std::string& what)
{
  if(!settings.classes.empty())
    throw_error(what, " have no 'classification', which --classes needs");
  if(!settings.tolerance.empty())
    throw_error(what, " have no '", settings.tolerance, "', which --tolerance-column names");
}

// How a LAS file describes its coordinate system.
enum class Projection { none, geotiff, wkt };

// The coordinates of a LAS file are integers times a scale, plus an offset.
struct Las_frame {
  std::array<double, 3> scale, offset;
  std::vector<std::string> records; // of the coordinate system, with their headers
  Projection projection = Projection::none;
};

// How the numbers of a record are written.
enum class Encoding { little_endian, big_endian, text };

constexpr char end_of_value = '\n'; // in records of texts, where no row has it

// The points of a file as they are there: an output of the same format gets them again.
struct Input_records {
  std::string format;                   // as an extension
  std::string layout;                   // of records that can be in one file
  bool is_whole = false;                // the file has more than points: those of others cannot be added
  bool has_others = false;              // than the fields that outputs of all formats have
  std::vector<std::string> head;        // what stands before the points, in parts, which the writer of the format tells
  std::string tail;                     // what stands behind them
  std::optional<std::size_t> waveforms; // of LAS: their place in the tail
  std::vector<std::string> names;       // of the fields of a point
  bool has_normals = false, has_colors = false;
  Encoding encoding = Encoding::little_endian;
  std::size_t real_size = 4; // of the coordinates, in bytes
  std::string bytes;         // of all points; of a text values, with end_of_value behind each
  std::vector<std::size_t> ends;

  void add(std::string_view record)
  {
    bytes += record;
    ends.push_back(bytes.size());
  }

  std::string_view operator[](std::size_t i) const
  {
    const std::size_t first = i == 0 ? 0 : ends[i - 1];
    return std::string_view(bytes).substr(first, ends[i] - first);
  }
};

// Where points of a file were seen from, up to those of the next viewpoint.
struct Viewpoint {
  std::array<double, 3> place;
  bool is_default = false; // what writers put there that know none
  std::size_t first = 0;   // of these points
};

// What the reading found out, for people and for the outputs.
struct Input_notes {
  std::vector<std::pair<std::string, std::string>> lines; // a word, and what there is to say about it
  std::vector<std::string> warnings;
  std::optional<Las_frame> las_frame;     // of a LAS file
  std::shared_ptr<Input_records> records; // if they are kept
  std::vector<Viewpoint> viewpoints;      // of a PCD file, or of each scan of a PTX file
  Box box;                                // of all points, where some are cropped
};

// ---

void read_cloud(const std::string& path, const Input_settings& settings, bool may_be_empty, Point_set& points,
                Input_notes& notes);

// What points may have beside coordinates: a bit for each.
using Attributes = unsigned;
constexpr Attributes normals_bit = 1, colors_bit = 2, intensity_bit = 4, classification_bit = 8;
constexpr Attributes all_attributes = normals_bit | colors_bit | intensity_bit | classification_bit;

// The words for them.
std::string names_of(Attributes attributes);

// Removes the others. A cloud without points gets those that are kept.
void keep_attributes(Attributes kept, Point_set& points);

// What one of the inputs has given.
struct Input_part {
  std::size_t input;       // its place among the inputs
  std::size_t first, last; // its points in the cloud
  Input_notes notes;
};

// One cloud of several files, in their order. It has what all of them have.
struct Input_cloud {
  Point_set points;
  std::vector<Input_part> parts;
  Attributes of_all = all_attributes, of_some = 0;
};

// Finds what is wrong before any file is read. `chosen`: the places of the files to read, in increasing order.
void check_inputs(const std::vector<std::string>& paths, const std::vector<std::size_t>& chosen,
                  const Input_settings& settings);

// Of several inputs some may have no points, which is a warning.
void read_clouds(const std::vector<std::string>& paths, const std::vector<std::size_t>& chosen,
                 const Input_settings& settings, Input_cloud& cloud);

} // namespace program

#endif // DETECT_PLANES_READ_CLOUD_H
