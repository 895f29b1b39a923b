// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_TABLE_VALUES_H
#define DETECT_PLANES_TABLE_VALUES_H

#include "input/Text_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

namespace program {

// What separates the values of a row: semicolons if it has any, else commas, else blanks. So a row that has several of
// them is no row of numbers.
inline char separator_of(std::string_view row)
{
  return row.find(';') != row.npos ? ';' : row.find(',') != row.npos ? ',' : ' ';
}

// The values of a row. Between two commas or semicolons there may be an empty one; blanks around them do not count.
class Table_values {
public:
  explicit Table_values(std::string_view row) : Table_values(row, separator_of(row)) {}
  Table_values(std::string_view row, char separator) : rest(row), separator_(separator) {}

  // False at the end of the row.
  bool next(std::string_view& value)
  {
    rest.remove_prefix(first_not_blank(rest));
    if(rest.empty())
      return false;
    const auto is_end = [this](char c) { return separator_ == ' ' ? is_blank(c) : c == separator_; };
    const std::size_t size = std::size_t(std::find_if(rest.begin(), rest.end(), is_end) - rest.begin());
    value = rest.substr(0, size);
    rest.remove_prefix((std::min)(size + 1, rest.size()));
    while(!value.empty() && is_blank(value.back()))
      value.remove_suffix(1);
    return true;
  }

  char separator() const { return separator_; }

private:
  std::string_view rest;
  char separator_;
};

// Nothing if the text is no number, or too large for one. An empty value is NaN.
inline std::optional<double> parse_number(std::string_view text)
{
  if(text.empty())
    return std::numeric_limits<double>::quiet_NaN();
  if(text.size() > 1 && text.front() == '+' && text[1] != '-')
    text.remove_prefix(1);
  double number = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number);
  if(end.ec != std::errc() || end.ptr != text.data() + text.size())
    return std::nullopt;
  return number;
}

} // namespace program

#endif // DETECT_PLANES_TABLE_VALUES_H
