// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/readers.h"
#include "input/table_head.h"

namespace program {

namespace {

template <class Integer>
Integer clamped(double x)
{
  constexpr double largest = double((std::numeric_limits<Integer>::max)());
  return x > 0 ? Integer(std::lround((std::min)(x, largest))) : Integer(0); // NaN is 0
}

// Makes points of rows, and looks whether their normals are some.
class Table_reader {
public:
  Table_reader(const std::vector<Column>& columns, double channel_unit, const Input_settings& settings,
               Input_notes& notes, Point_set& points)
    : columns(columns), fields{has_column(columns, Column::nx), has_column(columns, Column::red),
                               has_column(columns, Column::intensity), has_column(columns, Column::classification),
                               has_column(columns, Column::tolerance)},
      channel_unit(channel_unit), builder(points, fields, settings, notes)
  {}

  void add(const Row_values& values)
  {
    Point_row row;
    for(std::size_t i = 0; i < 3; ++i) {
      row.point[i] = values[i];
      row.normal[i] = values[std::size_t(Column::nx) + i];
      row.color[i] = clamped<std::uint16_t>(channel_unit * values[std::size_t(Column::red) + i]);
    }
    row.intensity = float(values[std::size_t(Column::intensity)]);
    row.classification = clamped<std::uint8_t>(values[std::size_t(Column::classification)]);
    row.tolerance = values[std::size_t(Column::tolerance)];
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

class Row_parser {
public:
  Row_parser(std::vector<Column> columns, Source source) : columns(std::move(columns)), source(source) {}

  const Row_values& parse(const Text_row& row)
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
  static double parse_value(const Text_row& row, Column column, std::string_view value)
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
    throw_error("has no classification, which --classes needs (its columns: ", names_of(columns), ")");
}

// Looks whether a column that seems to count the rows goes on like that.
class Row_counter {
public:
  explicit Row_counter(bool is_used) : is_used(is_used) {}

  void look_at(const Text_row& row)
  {
    if(!is_used || break_ > 0)
      return;
    std::string_view value;
    Table_values(row.text).next(value);
    const double number = parse_number(value).value_or(0);
    break_ = is_begun && number != before + 1 ? row.number : 0;
    is_begun = true;
    before = number;
  }

  void finish(std::vector<std::string>& warnings) const
  {
    if(break_ > 0)
      warnings.push_back("column 1 counts the rows until row " + std::to_string(break_) +
                         " goes on otherwise, and is passed over; name the columns by --columns if it is a coordinate");
  }

private:
  bool is_used, is_begun = false;
  double before = 0;
  std::size_t break_ = 0;
};

} // namespace

void read_table(Byte_source& file, const std::string& extension, const Input_settings& settings, Point_set& points,
                Input_notes& notes)
{
  Input_buffer in(file);
  Text_lines lines(in);
  Table_rows table(lines, settings.has_decimal_commas);
  const Table_head head = read_head(table, settings.columns);
  check_pairs(head);
  const Sample sample = sample_of(head.rows);
  const auto [columns, counts_rows] = columns_of(head, sample, extension, settings.tolerance);
  check_classes(columns, settings);
  Row_parser parser(columns, head.source);
  Table_reader reader(columns, channel_unit_of(columns, sample), settings, notes, points);
  Unclear_commas commas(head.source == Source::sample && !head.rows.empty());
  Row_counter counter(counts_rows);
  const auto add = [&](const Text_row& row) {
    const Row_values& values = parser.parse(row);
    reader.add(values);
    commas.look_at(row.text, values);
    counter.look_at(row);
  };
  for(const Text_row& row : head.rows)
    add(row);
  while(table.next())
    if(!is_comment(table.row().text))
      add(table.row());
  const std::size_t count = reader.finish(notes);
  commas.finish(names_of(columns), notes.warnings);
  counter.finish(notes.warnings);
  if(head.count && *head.count != count)
    throw_error("has ", count, " rows of points, ", *head.count, " announced");
  notes.lines.emplace_back("columns", names_of(columns) + (counts_rows ? " (the first counts the rows)" : ""));
  if(head.is_geographic)
    notes.warnings.push_back("x and y are columns of longitude and latitude: planes need lengths, so " +
                             std::string(advice_on_degrees));
}

} // namespace program
