// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/read_table.h"

#include "formats.h"
#include "input/Cloud_builder.h"
#include "input/Table_rows.h"
#include "input/recognize_columns.h"

#include <filesystem>
#include <stdexcept>

namespace program {

namespace {

[[noreturn]] void fail_at_row(std::size_t row, const std::string& reason)
{
  throw std::runtime_error("row " + std::to_string(row) + " " + reason);
}

struct Row {
  std::size_t number;
  std::string text;
};

// What stands before the points, and the first of them.
struct Head {
  std::vector<Column> columns; // of --columns, or of a line of names; empty: unknown
  std::optional<std::size_t> count;
  std::vector<Row> rows;
};

std::vector<std::string_view> values_of(std::string_view row)
{
  std::vector<std::string_view> values;
  for(std::string_view value; next_value(row, value);)
    values.push_back(value);
  return values;
}

std::size_t parse_count(const Row& row, std::string_view text)
{
  long long count = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), count);
  if(end.ec != std::errc() || end.ptr != text.data() + text.size())
    fail_at_row(row.number,
                "is neither a point, the number of points nor a line of names (comments begin with # or //)");
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
void read_head_line(const Row& row, bool is_comment, bool is_named, Head& head)
{
  const std::vector<std::string_view> values = values_of(row.text);
  if(!is_comment && is_point(values, head.columns)) {
    head.rows.push_back(row);
    return;
  }
  const std::vector<Column> names = columns_of_header(row.text);
  if(!names.empty() && !is_named)
    head.columns = names;
  else if(!is_comment && names.empty())
    head.count = parse_count(row, values.size() == 1 ? values[0] : "");
}

Head read_head(Table_rows& table, const std::vector<Column>& columns)
{
  constexpr std::size_t most = 1000;
  Head head;
  head.columns = columns;
  while(head.rows.size() < most && table.next())
    if(head.rows.empty())
      read_head_line({table.number(), table.text()}, table.is_comment(), !columns.empty(), head);
    else if(!table.is_comment())
      head.rows.push_back({table.number(), table.text()});
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

void check_decimal_points(const std::vector<Row>& rows)
{
  for(const Row& row : rows)
    if(row.text.find(';') != row.text.npos && row.text.find(',') != row.text.npos)
      fail_at_row(row.number, "has commas and semicolons (write numbers with a decimal point, and separate them by one "
                              "of both)");
}

class Row_parser {
public:
  Row_parser(std::vector<Column> columns, bool is_strict) : columns(std::move(columns)), is_strict(is_strict) {}

  const std::array<double, 11>& parse(std::size_t row, std::string_view text)
  {
    std::string_view value;
    for(std::size_t c = 0; c < columns.size(); ++c) {
      if(!next_value(text, value))
        fail_at_row(row, "has " + std::to_string(c) + " values instead of " + std::to_string(columns.size()));
      if(columns[c] == Column::none)
        continue;
      const std::optional<double> number = parse_number(value);
      if(!number)
        fail_at_row(row, "has '" + std::string(value.substr(0, 40)) + "' where the number " + name_of(columns[c]) +
                           " is expected");
      values[std::size_t(columns[c])] = *number;
    }
    if(is_strict && next_value(text, value))
      fail_at_row(row, "has more than " + std::to_string(columns.size()) +
                         " values (name its columns by --columns, for example)");
    return values;
  }

private:
  std::vector<Column> columns;
  bool is_strict; // no more values than columns
  std::array<double, 11> values = {};
};

template <class Integer>
Integer clamped(double x)
{
  constexpr double largest = double((std::numeric_limits<Integer>::max)());
  return x > 0 ? Integer(std::lround((std::min)(x, largest))) : Integer(0); // NaN is 0
}

// Makes points of rows, and looks whether their normals are some.
class Table_reader {
public:
  Table_reader(const std::vector<Column>& columns, double channel_unit, const std::vector<int>& classes,
               Point_set& points)
    : columns(columns), fields{has_column(columns, Column::nx), has_column(columns, Column::red),
                               has_column(columns, Column::intensity), has_column(columns, Column::classification)},
      channel_unit(channel_unit), builder(points, fields, classes)
  {}

  void add(const std::array<double, 11>& values)
  {
    Point_row row;
    for(std::size_t i = 0; i < 3; ++i) {
      row.point[i] = values[i];
      row.normal[i] = values[std::size_t(Column::nx) + i];
      row.color[i] = clamped<std::uint16_t>(channel_unit * values[std::size_t(Column::red) + i]);
    }
    row.intensity = float(values[std::size_t(Column::intensity)]);
    row.classification = clamped<std::uint8_t>(values[std::size_t(Column::classification)]);
    builder.add(row);
    ++count;
    if(fields.normal)
      look_at_normal(row.normal);
  }

  std::size_t finish(Input_notes& notes)
  {
    if(channel_unit == 1)
      builder.widen_colors();
    if(2 * strange > count)
      notes.warnings.push_back("the normals (nx ny nz, columns " + places() + ") are far from length 1, as " +
                               std::to_string(example) + "; name the columns by --columns if they are no normals");
    return count;
  }

private:
  void look_at_normal(const double (&n)[3])
  {
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if(!(length > 0) || std::fabs(length - 1) <= largest_error_of_length)
      return;
    example = strange++ == 0 ? length : example;
  }

  std::string places() const
  {
    std::string text;
    for(std::size_t c = 0; c < columns.size(); ++c)
      if(columns[c] == Column::nx || columns[c] == Column::ny || columns[c] == Column::nz)
        text += (text.empty() ? "" : " ") + std::to_string(c + 1);
    return text;
  }

  std::vector<Column> columns;
  Fields fields;
  double channel_unit;
  Cloud_builder builder;
  std::size_t count = 0, strange = 0;
  double example = 0;
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

} // namespace

void read_table(Byte_source& file, const std::string& path, const Input_settings& settings, Point_set& points,
                Input_notes& notes)
{
  Table_rows table(file);
  const Head head = read_head(table, settings.columns);
  check_decimal_points(head.rows);
  const Sample sample = sample_of(head.rows);
  const bool is_named = !head.columns.empty();
  const std::vector<Column> columns = is_named ? head.columns : recognize_columns(sample, input_extension(path));
  check_classes(columns, settings);
  Row_parser parser(columns, settings.columns.empty());
  Table_reader reader(columns, channel_unit_of(columns, sample), settings.classes, points);
  for(const Row& row : head.rows)
    reader.add(parser.parse(row.number, row.text));
  while(table.next())
    if(!table.is_comment())
      reader.add(parser.parse(table.number(), table.text()));
  const std::size_t count = reader.finish(notes);
  if(head.count && *head.count != count)
    throw std::runtime_error("has " + std::to_string(count) + " rows of points, " + std::to_string(*head.count) +
                             " announced");
  notes.lines.emplace_back("columns", names_of(columns));
}

} // namespace program
