// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/table_head.h"

#include "input/decimal_commas.h"
#include "input/table_values.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <stdexcept>

namespace program {

namespace {

std::vector<std::string_view> values_of(std::string_view row)
{
  std::vector<std::string_view> values;
  Table_values rest(row);
  for(std::string_view value; rest.next(value);)
    values.push_back(value);
  return values;
}

std::size_t parse_count(const Text_row& row, std::string_view text)
{
  long long count = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), count);
  if(end.ec != std::errc() || end.ptr != text.data() + text.size())
    fail_at(row, "is neither a point, the number of points nor a line of names (comments begin with # or //)");
  if(count < 0)
    throw std::runtime_error("announces " + std::to_string(count) + " points");
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
    throw std::runtime_error(
      "is a raster of ESRI (its first word is ncols), and no table of points; make one of it with "
      "gdal_translate -of XYZ, for example");
}

// A line before the first point.
void read_head_line(const Text_row& row, Table_head& head)
{
  const std::vector<std::string_view> values = values_of(row.text);
  check_raster(values);
  const bool has_note = is_comment(row.text);
  if(!has_note && is_point(values, head.columns)) {
    head.rows.push_back(row);
    return;
  }
  const std::vector<std::string> names = names_of_header(row.text);
  std::vector<Column> columns = columns_of_names(names);
  if(columns.empty())
    columns = map_columns_of_names(names);
  const bool is_geographic = columns.empty();
  if(is_geographic)
    columns = geographic_columns_of_names(names);
  head.is_geographic = columns.empty() ? head.is_geographic : is_geographic;
  if(!columns.empty() && head.source != Source::option) {
    head.source = Source::header;
    head.columns = columns;
    head.names = names;
  } else if(!has_note && columns.empty() && head.source == Source::option && !head.has_skipped_names &&
            are_names(values)) {
    head.has_skipped_names = true;
  } else if(!has_note && columns.empty() && are_names(values)) {
    fail_at_row(row.number, "is a line of names that do not tell x, y and z (name the columns by --columns)");
  } else if(!has_note && columns.empty()) {
    head.count = parse_count(row, values.size() == 1 ? values[0] : "");
  }
}

} // namespace

void fail_at(const Text_row& row, const std::string& reason)
{
  fail_at_row(row.number, reason + advice_on_commas(row.text) +
                            (row.text.find(',') == row.text.npos ? "" : " (or give --decimal-comma)"));
}

Table_head read_head(Table_rows& table, const std::vector<Column>& columns)
{
  constexpr std::size_t most_rows = 1000, most_bytes = 1 << 20;
  Table_head head;
  head.columns = columns;
  head.source = columns.empty() ? Source::sample : Source::option;
  for(std::size_t bytes = 0; head.rows.size() < most_rows && bytes < most_bytes && table.next();)
    if(head.rows.empty()) {
      read_head_line(table.row(), head);
    } else if(!is_comment(table.row().text)) {
      head.rows.push_back(table.row());
      bytes += table.row().text.size();
    }
  return head;
}

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

void check_pairs(const Table_head& head)
{
  const auto has_pairs = [](const Text_row& row) { return has_pairs_of_integers(row.text, true); };
  if(!head.rows.empty() && values_of(head.rows[0].text).size() != head.columns.size() &&
     std::all_of(head.rows.begin(), head.rows.end(), has_pairs))
    fail_at(head.rows[0], "has integers in pairs, as 1,5, 2,5");
}

Table_columns columns_of(const Table_head& head, const Sample& sample, const std::string& extension,
                         const std::string& tolerance)
{
  if(head.source == Source::option)
    return {head.columns};
  if(head.source == Source::sample && !tolerance.empty())
    throw std::runtime_error("has no line of names, of which --tolerance-column takes '" + tolerance +
                             "' (--columns names them)");
  if(head.source == Source::sample)
    return {recognize_columns(sample, extension), counts_rows(sample)};
  Table_columns found = {head.columns};
  if(!tolerance.empty())
    found.columns[find_name(head.names, tolerance, "column")] = Column::tolerance;
  remove_incomplete(found.columns);
  if(!has_coordinates(found.columns))
    throw std::runtime_error("the column '" + tolerance + "' of --tolerance-column is a coordinate");
  found.counts_rows = !sample.empty() && sample.front().size() == head.names.size() + 1 && counts_rows(sample);
  if(found.counts_rows)
    found.columns.insert(found.columns.begin(), Column::none);
  return found;
}
} // namespace program
