// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Commas separate values. Where they are parts of numbers instead, the values are others than those of the file.

#ifndef DETECT_PLANES_DECIMAL_COMMAS_H
#define DETECT_PLANES_DECIMAL_COMMAS_H

#include "input/table_values.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace program {

// What there is to say of a row that cannot be read.
inline std::string advice_on_commas(std::string_view row)
{
  return row.find(',') == row.npos ? ""
                                   : "; commas are no part of numbers: write numbers with a decimal point, and without "
                                     "separators of thousands";
}

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

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

// As in 1,5, 2,5, 3,5: integers, and blanks behind every second comma only.
inline bool has_pairs_of_integers(std::string_view row)
{
  Table_values values(row);
  std::string_view value;
  std::size_t count = 0;
  for(const char* end = nullptr; values.next(value); end = value.data() + value.size(), ++count) {
    const bool has_blank = end != nullptr && value.data() != end + 1;
    if(!is_integer(value) || (count > 0 && has_blank != (count % 2 == 0)))
      return false;
  }
  return values.separator() == ',' && count >= 6 && count % 2 == 0;
}

} // namespace program

#endif // DETECT_PLANES_DECIMAL_COMMAS_H
