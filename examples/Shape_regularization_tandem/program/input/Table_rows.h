// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_TABLE_ROWS_H
#define DETECT_PLANES_TABLE_ROWS_H

#include "input/Input_buffer.h"
#include "input/table_columns.h"

#include <charconv>
#include <cmath>
#include <istream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace program {

// The next value of a row, which `rest` begins with. Blanks separate values, and so does a comma or semicolon among
// them; two of these have an empty value between them. False at the end of the row.
inline bool next_value(std::string_view& rest, std::string_view& value)
{
  const auto skip_blanks = [&rest] {
    const std::size_t first = rest.find_first_not_of(" \t\r\v\f");
    rest.remove_prefix(first == rest.npos ? rest.size() : first);
  };
  skip_blanks();
  if(rest.empty())
    return false;
  std::size_t size = 0;
  while(size < rest.size() && !is_separator(rest[size]))
    ++size;
  value = rest.substr(0, size);
  rest.remove_prefix(size);
  skip_blanks();
  if(!rest.empty() && (rest.front() == ',' || rest.front() == ';'))
    rest.remove_prefix(1);
  return true;
}

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

// The lines of a table, without empty ones.
class Table_rows {
public:
  explicit Table_rows(Byte_source& file) : Table_rows(file, {0, file.size()}) {}
  Table_rows(Byte_source& file, Byte_range range) : buffer(file, range, ""), in(&buffer) {}

  bool next()
  {
    while(std::getline(in, line)) {
      ++number_;
      if(number_ == 1 && line.compare(0, 3, "\xEF\xBB\xBF") == 0) // the mark of UTF-8
        line.erase(0, 3);
      if(line.find_first_not_of(" \t\r\v\f") != line.npos)
        return true;
    }
    return false;
  }

  bool is_comment() const
  {
    const std::size_t first = line.find_first_not_of(" \t\r\v\f");
    return line[first] == '#' || line.compare(first, 2, "//") == 0;
  }

  const std::string& text() const { return line; }
  std::size_t number() const { return number_; }

private:
  Input_buffer buffer;
  std::istream in;
  std::string line;
  std::size_t number_ = 0;
};

} // namespace program

#endif // DETECT_PLANES_TABLE_ROWS_H
