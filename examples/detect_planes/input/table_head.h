// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What stands before the points of a text table, and what its columns are.

#ifndef DETECT_PLANES_TABLE_HEAD_H
#define DETECT_PLANES_TABLE_HEAD_H

#include "input/Input_buffer.h"
#include "input/input_settings.h"

namespace program {

inline bool is_integer(std::string_view value)
{
  if(!value.empty() && (value.front() == '-' || value.front() == '+'))
    value.remove_prefix(1);
  return !value.empty() && std::all_of(value.begin(), value.end(), is_digit);
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

// What tells the columns: --columns, a line of names, or the values.
enum class Source { option, header, sample };

// What stands before the points, and the first of them.
struct Table_head {
  Source source = Source::sample;
  std::vector<Column> columns;
  bool counts_rows = false; // the first column, which is passed over
  double channel_unit = 1;  // of colors: channels from 0 to 1 become 16 bits
  bool is_geographic = false;
  std::optional<std::size_t> count;
  std::vector<Text_row> rows;
};

// Says what is wrong with a row, and what may be wrong with its commas.
[[noreturn]] void fail_at(const Text_row& row, const std::string& reason);

// A column that counts the rows need not have a name.
Table_head read_head(Table_rows& table, const std::string& extension, const Input_settings& settings);

} // namespace program

#endif // DETECT_PLANES_TABLE_HEAD_H
