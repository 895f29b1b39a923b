// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What stands before the points of a text table, and what its columns are.

#ifndef DETECT_PLANES_TABLE_HEAD_H
#define DETECT_PLANES_TABLE_HEAD_H

#include "input/Input_buffer.h"
#include "input/input_settings.h"

namespace program {

// --- Commas separate values. Where they are parts of numbers instead, the values are others than those of the file.

inline bool is_integer(std::string_view value)
{
  if(!value.empty() && (value.front() == '-' || value.front() == '+'))
    value.remove_prefix(1);
  return !value.empty() && std::all_of(value.begin(), value.end(), is_digit);
}

// 05 after 1, of 1,05; and 034.5 after 1, of 1,034.5. No number is written so.
inline bool is_rest_of_number(std::string_view before, std::string_view value)
{
  return value.size() > 1 && value[0] == '0' && is_digit(value[1]) && is_integer(before);
}

// As in 1,5,2,5,3,5, or 1,5, 2,5, 3,5 if there are blanks behind every second comma only. No part behind a decimal
// comma has a sign.
inline bool has_pairs_of_integers(std::string_view row, bool has_blanks)
{
  Table_values values(row);
  std::string_view value;
  std::size_t count = 0;
  for(const char* end = nullptr; values.next(value); end = value.data() + value.size(), ++count) {
    const bool is_second = count % 2 == 1, has_blank = end != nullptr && value.data() != end + 1;
    if(!is_integer(value) || (is_second && !is_digit(value[0])) ||
       (count > 0 && has_blank != (has_blanks && !is_second)))
      return false;
  }
  return values.separator() == ',' && count >= 6 && count % 2 == 0;
}

// Looks at the rows of a table whose commas may be decimal ones, as in 4,4,17,4,1,1, though they are read as others.
class Unclear_commas {
public:
  explicit Unclear_commas(bool may_be_decimal) : may_be_decimal(may_be_decimal) {}

  void look_at(std::string_view row, const Row_values& values)
  {
    may_be_decimal = may_be_decimal && has_pairs_of_integers(row, false);
    for(Column c : {Column::red, Column::green, Column::blue})
      has_wide_colors = has_wide_colors || values[std::size_t(c)] > 255;
  }

  // Colors of 16 bits are too rare in such a table.
  void finish(const std::string& columns, std::vector<std::string>& warnings) const
  {
    if(!may_be_decimal)
      return;
    const std::string text = "each row is of integers with commas between them, read as " + columns +
                             (has_wide_colors ? " with values above 255 of r g b" : "") +
                             ": write numbers with a decimal point if the commas are decimal ones, or name the columns "
                             "by --columns if they are not";
    if(has_wide_colors)
      throw std::runtime_error(text);
    warnings.push_back(text);
  }

private:
  bool may_be_decimal, has_wide_colors = false;
};

// ---

// What tells the columns: --columns, a line of names, or the values.
enum class Source { option, header, sample };

// What stands before the points, and the first of them.
struct Table_head {
  Source source = Source::sample;
  std::vector<Column> columns;    // empty: unknown
  std::vector<std::string> names; // of a line of names
  bool is_geographic = false, has_skipped_names = false;
  std::optional<std::size_t> count;
  std::vector<Text_row> rows;
};

// Says what is wrong with a row, and what may be wrong with its commas.
[[noreturn]] void fail_at(const Text_row& row, const std::string& reason);

// columns: those of --columns, or none.
Table_head read_head(Table_rows& table, const std::vector<Column>& columns);

// The rows that have as many values as the first one; the others are reported when they are read.
Sample sample_of(const std::vector<Text_row>& rows);

// Finds integers in pairs, as 1,5, 2,5. As many values as names are told what they are.
void check_pairs(const Table_head& head);

// Channels from 0 to 1, at least one of which is between.
bool are_real_colors(const Sample& rows, std::size_t first);

// What the columns of a table are.
struct Table_columns {
  std::vector<Column> columns;
  bool counts_rows = false; // the first one, which is passed over
};

// A column that counts the rows need not have a name. tolerance: the name of --tolerance-column, or empty.
Table_columns columns_of(const Table_head& head, const Sample& sample, const std::string& extension,
                         const std::string& tolerance);

} // namespace program

#endif // DETECT_PLANES_TABLE_HEAD_H
