// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/table_head.h"

namespace program {

namespace {

// The first rows of a table, all with as many values; NaN for what is no number.
using Sample = std::vector<std::vector<double>>;

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

// Channels from 0 to 1, at least one of which is between.
bool are_real_colors(const Sample& rows, std::size_t first)
{
  return all_values(rows, first, [](double x) { return x >= 0 && x <= 1; }) && !are_integer_colors(rows, first);
}

bool is_number(const Sample& rows, std::size_t column)
{
  return std::none_of(rows.begin(), rows.end(), [=](const auto& row) { return std::isnan(row[column]); });
}

// The columns of these names, or none if they do not name x, y and z. Each but for the first of a kind is passed over.
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

using Names = std::initializer_list<const char*>;

// Of names of maps or of the globe, such as Easting and Northing. Without a unit in parentheses.
Column column_by(const std::string& text, Names x, Names y, Names z)
{
  const std::string plain = plain_name(text), name = plain.substr(0, plain.find_first_of("(["));
  return is_in(name, x) ? Column::x : is_in(name, y) ? Column::y : is_in(name, z) ? Column::z : column_of_name(text);
}

Column column_of_map_name(const std::string& text)
{
  return column_by(text, {"easting", "east", "e", "x"}, {"northing", "north", "n", "y"},
                   {"elevation", "elev", "height", "h", "altitude", "alt", "z"});
}

Column column_of_geographic_name(const std::string& text)
{
  return column_by(text, {"lon", "long", "longitude"}, {"lat", "latitude"},
                   {"height", "h", "altitude", "alt", "elevation"});
}

void place(std::vector<Column>& columns, std::size_t first, Column name)
{
  for(int i = 0; i < 3; ++i)
    columns[first + std::size_t(i)] = Column(int(name) + i);
}

// Most of the normals in the columns from `first` on have length 1.
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

// The words of a line of names.
std::vector<std::string> names_of_header(std::string_view line)
{
  line.remove_prefix((std::min)(line.find_first_not_of(" \t#/"), line.size()));
  const std::vector<std::string_view> names = values_of(line);
  return {names.begin(), names.end()};
}

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

// The first column has integers that rise by one from row to row, and three at least follow it. Not where the second one
// has always the same value: then both may be the coordinates of a raster.
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

// The columns of a table without a line of names; one that counts the rows is passed over. In a .pts file the intensity
// comes before the colors; files .pwn and .xyzn have normals, those of .xyzrgb colors.
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

// --- What stands before the points

// The rows that have as many values as the first one; the others are reported when they are read.
Sample sample_of(const std::vector<Text_row>& rows)
{
  Sample sample;
  for(const Text_row& row : rows) {
    std::vector<double> numbers;
    for(std::string_view value : values_of(row.text))
      numbers.push_back(parse_number(value).value_or(std::numeric_limits<double>::quiet_NaN()));
    if(sample.empty() || numbers.size() == sample.front().size())
      sample.push_back(numbers);
  }
  return sample;
}

std::size_t parse_count(const Text_row& row, std::string_view text)
{
  long long count = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), count);
  if(end.ec != std::errc() || end.ptr != text.data() + text.size())
    fail_at(row, "is neither a point, the number of points nor a line of names (comments begin with # or //)");
  if(count < 0)
    throw_error("announces ", count, " points");
  return std::size_t(count);
}

// Its coordinates are numbers, or empty.
bool is_point(const std::vector<std::string_view>& values, const std::vector<Column>& columns)
{
  for(Column c : {Column::x, Column::y, Column::z}) {
    const auto found = std::find(columns.begin(), columns.end(), c);
    const std::size_t place = columns.empty() ? std::size_t(c) : std::size_t(found - columns.begin());
    if(place >= values.size() || !parse_number(values[place]))
      return false;
  }
  return true;
}

// Words, none of which is a number.
bool are_names(const std::vector<std::string_view>& values)
{
  const auto is_word = [](std::string_view value) {
    const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
    return std::any_of(value.begin(), value.end(), is_letter) && !parse_number(value);
  };
  return values.size() >= 3 && std::all_of(values.begin(), values.end(), is_word);
}

void check_raster(const std::vector<std::string_view>& values)
{
  if(!values.empty() && plain_name(values[0]) == "ncols")
    throw std::runtime_error("is a raster of ESRI (its first word is ncols), and no table of points; make one of it "
                             "with gdal_translate -of XYZ, for example");
}

// A line before the first point.
void read_head_line(const Text_row& row, Table_head& head, std::vector<std::string>& head_names,
                    bool& has_skipped_names)
{
  const std::vector<std::string_view> values = values_of(row.text);
  check_raster(values);
  const bool has_note = is_comment(row.text);
  if(!has_note && is_point(values, head.columns)) {
    head.rows.push_back(row);
    return;
  }
  const std::vector<std::string> names = names_of_header(row.text);
  std::vector<Column> columns = columns_by(names, column_of_name);
  if(columns.empty())
    columns = columns_by(names, column_of_map_name);
  const bool is_geographic = columns.empty();
  if(is_geographic)
    columns = columns_by(names, column_of_geographic_name);
  head.is_geographic = columns.empty() ? head.is_geographic : is_geographic;
  if(!columns.empty() && head.source != Source::option) {
    head.source = Source::header;
    head.columns = columns;
    head_names = names;
  } else if(!has_note && columns.empty() && head.source == Source::option && !has_skipped_names && are_names(values)) {
    has_skipped_names = true;
  } else if(!has_note && columns.empty() && are_names(values)) {
    fail_at_row(row.number, "is a line of names that do not tell x, y and z (name the columns by --columns)");
  } else if(!has_note && columns.empty()) {
    head.count = parse_count(row, values.size() == 1 ? values[0] : "");
  }
}

// Finds integers in pairs, as 1,5, 2,5. As many values as names are told what they are.
void check_pairs(const Table_head& head)
{
  const auto has_pairs = [](const Text_row& row) { return has_pairs_of_integers(row.text, true); };
  if(!head.rows.empty() && values_of(head.rows[0].text).size() != head.columns.size() &&
     std::all_of(head.rows.begin(), head.rows.end(), has_pairs))
    fail_at(head.rows[0], "has integers in pairs, as 1,5, 2,5");
}

// names: of the columns, where a line has them.
void find_columns(const Sample& sample, const std::vector<std::string>& names, const std::string& extension,
                  const std::string& tolerance, Table_head& head)
{
  std::vector<Column>& columns = head.columns;
  if(head.source == Source::sample && !tolerance.empty())
    throw_error("has no line of names, of which --tolerance-column takes '", tolerance, "' (--columns names them)");
  if(head.source == Source::sample) {
    columns = recognize_columns(sample, extension);
    head.counts_rows = counts_rows(sample);
  }
  if(head.source != Source::header)
    return;
  if(!tolerance.empty())
    columns[find_name(names, tolerance, "column")] = Column::tolerance;
  remove_incomplete(columns);
  if(!has_coordinates(columns))
    throw_error("the column '", tolerance, "' of --tolerance-column is a coordinate");
  head.counts_rows = !sample.empty() && sample.front().size() == names.size() + 1 && counts_rows(sample);
  if(head.counts_rows)
    columns.insert(columns.begin(), Column::none);
}

double channel_unit_of(const std::vector<Column>& columns, const Sample& sample)
{
  const std::size_t first = std::size_t(std::find(columns.begin(), columns.end(), Column::red) - columns.begin());
  const bool is_triple = first + 2 < columns.size() && columns[first + 1] == Column::green;
  return is_triple && !sample.empty() && first + 2 < sample.front().size() && are_real_colors(sample, first) ? 65535
                                                                                                             : 1;
}

} // namespace

void fail_at(const Text_row& row, const std::string& reason)
{
  fail_at_row(row.number, reason + advice_on_commas(row.text) +
                            (row.text.find(',') == row.text.npos ? "" : " (or give --decimal-comma)"));
}

Table_head read_head(Table_rows& table, const std::string& extension, const Input_settings& settings)
{
  constexpr std::size_t most_rows = 1000, most_bytes = 1 << 20;
  Table_head head;
  std::vector<std::string> names;
  bool has_skipped_names = false;
  head.columns = settings.columns;
  head.source = settings.columns.empty() ? Source::sample : Source::option;
  for(std::size_t bytes = 0; head.rows.size() < most_rows && bytes < most_bytes && table.next();)
    if(head.rows.empty()) {
      read_head_line(table.row(), head, names, has_skipped_names);
    } else if(!is_comment(table.row().text)) {
      head.rows.push_back(table.row());
      bytes += table.row().text.size();
    }
  check_pairs(head);
  const Sample sample = sample_of(head.rows);
  find_columns(sample, names, extension, settings.tolerance, head);
  head.channel_unit = channel_unit_of(head.columns, sample);
  return head;
}

} // namespace program
