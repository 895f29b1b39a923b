// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/readers.h"

#include "file_names.h"
#include "input/decimal_commas.h"
#include "input/Table_reader.h"
#include "input/table_columns.h"

#include <filesystem>
#include <stdexcept>

namespace program {

namespace {

using Row = Text_row;

[[noreturn]] void fail_at(const Row& row, const std::string& reason)
{
  fail_at_row(row.number, reason + advice_on_commas(row.text));
}

bool is_comment(std::string_view row)
{
  row.remove_prefix(first_not_blank(row));
  return row.front() == '#' || row.substr(0, 2) == "//";
}

// What tells the columns: --columns, a line of names, or the values.
enum class Source { option, header, sample };

// What stands before the points, and the first of them.
struct Head {
  Source source = Source::sample;
  std::vector<Column> columns;    // empty: unknown
  std::vector<std::string> names; // of a line of names
  bool is_geographic = false;
  std::optional<std::size_t> count;
  std::vector<Row> rows;
};

std::vector<std::string_view> values_of(std::string_view row)
{
  std::vector<std::string_view> values;
  Table_values rest(row);
  for(std::string_view value; rest.next(value);)
    values.push_back(value);
  return values;
}

std::size_t parse_count(const Row& row, std::string_view text)
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

// A line before the first point.
void read_head_line(const Row& row, Head& head)
{
  const std::vector<std::string_view> values = values_of(row.text);
  const bool has_note = is_comment(row.text);
  if(!has_note && is_point(values, head.columns)) {
    head.rows.push_back(row);
    return;
  }
  const std::vector<std::string> names = names_of_header(row.text);
  std::vector<Column> columns = columns_of_names(names);
  const bool is_geographic = columns.empty();
  if(is_geographic)
    columns = geographic_columns_of_names(names);
  if(!columns.empty() && head.source != Source::option) {
    head.source = Source::header;
    head.columns = columns;
    head.names = names;
    head.is_geographic = is_geographic;
  } else if(!has_note && columns.empty()) {
    head.count = parse_count(row, values.size() == 1 ? values[0] : "");
  }
}

Head read_head(Text_lines& table, const std::vector<Column>& columns)
{
  constexpr std::size_t most_rows = 1000, most_bytes = 1 << 20;
  Head head;
  head.columns = columns;
  head.source = columns.empty() ? Source::sample : Source::option;
  for(std::size_t bytes = 0; head.rows.size() < most_rows && bytes < most_bytes && table.next_filled();)
    if(head.rows.empty()) {
      read_head_line(table.row(), head);
    } else if(!is_comment(table.row().text)) {
      head.rows.push_back(table.row());
      bytes += table.row().text.size();
    }
  return head;
}

// The rows that have as many values as the first one; the others are reported when they are read.
Sample sample_of(const std::vector<Row>& rows)
{
  Sample sample;
  for(const Row& row : rows) {
    std::vector<double> numbers;
    for(std::string_view value : values_of(row.text))
      numbers.push_back(parse_number(value).value_or(std::numeric_limits<double>::quiet_NaN()));
    if(sample.empty() || numbers.size() == sample.front().size())
      sample.push_back(numbers);
  }
  return sample;
}

// As many values as names are told what they are.
void check_pairs(const Head& head)
{
  const auto has_pairs = [](const Row& row) { return has_pairs_of_integers(row.text, true); };
  if(!head.rows.empty() && values_of(head.rows[0].text).size() != head.columns.size() &&
     std::all_of(head.rows.begin(), head.rows.end(), has_pairs))
    fail_at(head.rows[0], "has integers in pairs, as 1,5, 2,5");
}

class Row_parser {
public:
  Row_parser(std::vector<Column> columns, Source source) : columns(std::move(columns)), source(source) {}

  const Row_values& parse(const Row& row)
  {
    Table_values rest(row.text);
    std::string_view value, before;
    bool is_split = false; // a number, by a comma
    for(std::size_t c = 0; c < columns.size(); ++c, before = value) {
      if(!rest.next(value))
        fail_at(row, "has " + std::to_string(c) + " values instead of " + std::to_string(columns.size()));
      is_split = is_split || (rest.separator() == ',' && is_rest_of_number(before, value));
      if(columns[c] != Column::none)
        values[std::size_t(columns[c])] = parse_value(row, columns[c], value);
    }
    if(rest.next(value) && (source != Source::option || rest.separator() == ','))
      fail_at(row, "has more than " + std::to_string(columns.size()) +
                     " values (name all its columns by --columns, also those to pass over, by _)");
    if(is_split && source == Source::sample)
      fail_at(
        row, "has a number with a leading 0 behind a comma, as in 1,05, which may be a decimal comma (if it is a value "
             "of its own, name all columns by --columns)");
    return values;
  }

private:
  static double parse_value(const Row& row, Column column, std::string_view value)
  {
    const std::optional<double> number = parse_number(value);
    if(!number)
      fail_at(row,
              "has '" + std::string(value.substr(0, 40)) + "' where the number " + name_of(column) + " is expected");
    return *number;
  }

  std::vector<Column> columns;
  Source source;
  Row_values values = {};
};

// Channels from 0 to 1 become 16 bits.
double channel_unit_of(const std::vector<Column>& columns, const Sample& sample)
{
  const auto red = std::find(columns.begin(), columns.end(), Column::red);
  const std::size_t first = std::size_t(red - columns.begin());
  const bool is_triple = first + 2 < columns.size() && columns[first + 1] == Column::green;
  return is_triple && !sample.empty() && first + 2 < sample.front().size() && are_real_colors(sample, first) ? 65535
                                                                                                             : 1;
}

void check_classes(const std::vector<Column>& columns, const Input_settings& settings)
{
  if(!settings.classes.empty() && !has_column(columns, Column::classification))
    throw std::runtime_error("has no classification, which --classes needs (its columns: " + names_of(columns) + ")");
}

// With the column of --tolerance-column.
std::vector<Column> columns_of(const Head& head, const Sample& sample, const std::string& path,
                               const std::string& tolerance)
{
  std::vector<Column> columns =
    head.source == Source::sample ? recognize_columns(sample, input_extension(path)) : head.columns;
  if(tolerance.empty() || head.source == Source::option)
    return columns;
  if(head.source == Source::sample)
    throw std::runtime_error("has no line of names, of which --tolerance-column takes '" + tolerance +
                             "' (--columns names them)");
  columns[find_name(head.names, tolerance, "column")] = Column::tolerance;
  remove_incomplete(columns);
  if(!has_coordinates(columns))
    throw std::runtime_error("the column '" + tolerance + "' of --tolerance-column is a coordinate");
  return columns;
}

} // namespace

void read_table(Byte_source& file, const std::string& path, const Input_settings& settings, Point_set& points,
                Input_notes& notes)
{
  Input_buffer in(file);
  Text_lines table(in);
  const Head head = read_head(table, settings.columns);
  check_pairs(head);
  const Sample sample = sample_of(head.rows);
  const std::vector<Column> columns = columns_of(head, sample, path, settings.tolerance);
  check_classes(columns, settings);
  Row_parser parser(columns, head.source);
  Table_reader reader(columns, channel_unit_of(columns, sample), settings.classes, points);
  Unclear_commas commas(head.source == Source::sample && !head.rows.empty());
  const auto add = [&](const Row& row) {
    const Row_values& values = parser.parse(row);
    reader.add(values);
    commas.look_at(row.text, values);
  };
  for(const Row& row : head.rows)
    add(row);
  while(table.next_filled())
    if(!is_comment(table.row().text))
      add(table.row());
  const std::size_t count = reader.finish(notes);
  commas.finish(names_of(columns), notes.warnings);
  if(head.count && *head.count != count)
    throw std::runtime_error("has " + std::to_string(count) + " rows of points, " + std::to_string(*head.count) +
                             " announced");
  notes.lines.emplace_back("columns", names_of(columns));
  if(head.is_geographic)
    notes.warnings.push_back("x and y are columns of longitude and latitude: planes need lengths, so " +
                             std::string(advice_on_degrees));
}

} // namespace program
