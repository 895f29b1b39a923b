// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_TABLE_ROWS_H
#define DETECT_PLANES_TABLE_ROWS_H

#include "input/Text_lines.h"
#include "input/table_values.h"

#include <string>
#include <string_view>

namespace program {

inline bool is_comment(std::string_view row)
{
  row.remove_prefix(first_not_blank(row));
  return row.substr(0, 1) == "#" || row.substr(0, 2) == "//";
}

// The rows of a table that are not empty. Where numbers have decimal commas, these become points.
class Table_rows {
public:
  Table_rows(Text_lines& lines, bool has_decimal_commas) : lines(lines), has_decimal_commas(has_decimal_commas) {}

  bool next()
  {
    if(!lines.next_filled())
      return false;
    if(has_decimal_commas) {
      changed = lines.row();
      change();
    }
    return true;
  }

  const Text_row& row() const { return has_decimal_commas ? changed : lines.row(); }

private:
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  static bool is_number(std::string_view value)
  {
    return value.find_first_not_of("0123456789+-.,eE") == value.npos && value.find_first_of("0123456789") != value.npos;
  }

  // A comma before a digit, behind one or at the beginning of a number.
  void change()
  {
    std::string& text = changed.text;
    Table_values values(text, text.find(';') == text.npos ? ' ' : ';');
    for(std::string_view value; values.next(value);)
      if(value.find('.') != value.npos && is_number(value) && !is_comment(text))
        fail_at_row(changed.number, "has '" + std::string(value.substr(0, 40)) +
                                      "': with --decimal-comma, numbers have a comma, and neither a point nor "
                                      "separators of thousands");
    for(std::size_t i = 0; i + 1 < text.size(); ++i)
      if(text[i] == ',' && is_digit(text[i + 1]) &&
         (i == 0 || is_digit(text[i - 1]) || is_blank(text[i - 1]) ||
          std::string_view(";+-").find(text[i - 1]) != std::string_view::npos))
        text[i] = '.';
  }

  Text_lines& lines;
  bool has_decimal_commas;
  Text_row changed = {0, ""};
};

} // namespace program

#endif // DETECT_PLANES_TABLE_ROWS_H
