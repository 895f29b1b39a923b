// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/readers.h"
#include "input/table_head.h"

namespace program {

namespace {

// --- Commas separate values. Where they are parts of numbers instead, the values are others than those of the file.

// 05 after 1, of 1,05; and 034.5 after 1, of 1,034.5. No number is written so.
bool is_rest_of_number(std::string_view before, std::string_view value)
{
  return value.size() > 1 && value[0] == '0' && is_digit(value[1]) && is_integer(before);
}

// Makes points of the rows of a table, and looks at what may be wrong with them.
class Table_reader {
public:
  Table_reader(const Table_head& head, const Input_settings& settings, Point_set& points, Input_notes& notes)
    : head(head), columns(head.columns), notes(notes),
      fields(fields_of([this](Column c) { return has_column(columns, c); })), builder(points, fields, settings, notes),
      may_be_decimal(head.source == Source::sample && !head.rows.empty())
  {}

  void add(const Text_row& row)
  {
    parse(row);
    Point_row point = row_of(values);
    for(std::size_t i = 0; i < 3; ++i)
      point.color[i] = clamped<std::uint16_t>(head.channel_unit * values[std::size_t(Column::red) + i]);
    point.classification = clamped<std::uint8_t>(values[std::size_t(Column::classification)]);
    builder.add(point);
    if(fields.normal)
      look_at_normal(point.normal);
    look_at_commas(row);
    if(head.counts_rows && break_at == 0)
      look_at_counter(row);
    ++count;
  }

  void finish()
  {
    if(head.channel_unit == 1)
      builder.widen_colors();
    if(2 * strange > count)
      notes.warnings.push_back("the normals (nx ny nz, columns " + places() + ") are far from length 1, as " +
                               std::to_string(example) + "; name the columns by --columns if they are no normals");
    if(may_be_decimal)
      report_commas();
    if(break_at > 0)
      notes.warnings.push_back("column 1 counts the rows until row " + std::to_string(break_at) +
                               " goes on otherwise, and is passed over; name the columns by --columns if it is a "
                               "coordinate");
    if(head.count && *head.count != count)
      throw_error("has ", count, " rows of points, ", *head.count, " announced");
  }

private:
  void parse(const Text_row& row)
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
    if(rest.next(value) && (head.source != Source::option || rest.separator() == ','))
      fail_at(row, "has more than " + std::to_string(columns.size()) +
                     " values (name all its columns by --columns, also those to pass over, by _)");
    if(is_split && head.source == Source::sample)
      fail_at(row, "has a number with a leading 0 behind a comma, as in 1,05, which may be a decimal comma (if it is a "
                   "value of its own, name all columns by --columns)");
  }

  static double parse_value(const Text_row& row, Column column, std::string_view value)
  {
    const std::optional<double> number = parse_number(value);
    if(!number)
      fail_at(row,
              "has '" + std::string(value.substr(0, 40)) + "' where the number " + name_of(column) + " is expected");
    return *number;
  }

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

  // Commas may be decimal ones, as in 4,4,17,4,1,1, though they are read as others.
  void look_at_commas(const Text_row& row)
  {
    may_be_decimal = may_be_decimal && has_pairs_of_integers(row.text, false);
    for(Column c : {Column::red, Column::green, Column::blue})
      has_wide_colors = has_wide_colors || values[std::size_t(c)] > 255;
  }

  // Colors of 16 bits are too rare in such a table.
  void report_commas()
  {
    const std::string text = "each row is of integers with commas between them, read as " + names_of(columns) +
                             (has_wide_colors ? " with values above 255 of r g b" : "") +
                             ": write numbers with a decimal point if the commas are decimal ones, or name the columns "
                             "by --columns if they are not";
    if(has_wide_colors)
      throw std::runtime_error(text);
    notes.warnings.push_back(text);
  }

  // A column that seems to count the rows may not go on like that.
  void look_at_counter(const Text_row& row)
  {
    std::string_view value;
    Table_values(row.text).next(value);
    const double number = parse_number(value).value_or(0);
    break_at = count > 0 && number != last_number + 1 ? row.number : 0;
    last_number = number;
  }

  const Table_head& head;
  const std::vector<Column>& columns;
  Input_notes& notes;
  Fields fields;
  Cloud_builder builder;
  Row_values values = {};
  bool may_be_decimal, has_wide_colors = false;
  std::size_t count = 0, strange = 0; // rows, normals
  double example = 0, last_number = 0;
  std::size_t break_at = 0; // the row
};

} // namespace

void read_table(Byte_source& file, const std::string& extension, const Input_settings& settings, Point_set& points,
                Input_notes& notes)
{
  Input_buffer in(file);
  Text_lines lines(in);
  Table_rows table(lines, settings.has_decimal_commas);
  const Table_head head = read_head(table, extension, settings);
  if(!settings.classes.empty() && !has_column(head.columns, Column::classification))
    throw_error("has no classification, which --classes needs (its columns: ", names_of(head.columns), ")");
  Table_reader reader(head, settings, points, notes);
  for(const Text_row& row : head.rows)
    reader.add(row);
  while(table.next())
    if(!is_comment(table.row().text))
      reader.add(table.row());
  reader.finish();
  notes.lines.emplace_back("columns",
                           names_of(head.columns) + (head.counts_rows ? " (the first counts the rows)" : ""));
  if(head.is_geographic)
    notes.warnings.push_back("x and y are columns of longitude and latitude: planes need lengths, so " +
                             std::string(advice_on_degrees));
}

} // namespace program
