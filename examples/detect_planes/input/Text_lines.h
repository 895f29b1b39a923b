// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_TEXT_LINES_H
#define DETECT_PLANES_TEXT_LINES_H

#include "input/Input_buffer.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

namespace program {

constexpr std::size_t longest_line = 65536; // in bytes. Longer ones are no text, and would fill the memory

constexpr const char* carriage_return_alone =
  "ends in a carriage return alone (end lines with a line feed: tr '\\r' '\\n' < FILE)";

[[noreturn]] inline void fail_at_row(std::size_t row, const std::string& reason)
{
  throw std::runtime_error("row " + std::to_string(row) + ' ' + reason);
}

inline bool is_blank(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

inline std::size_t first_not_blank(std::string_view text)
{
  return std::size_t(std::find_if_not(text.begin(), text.end(), is_blank) - text.begin());
}

struct Text_row {
  std::size_t number; // in the file, from 1 on
  std::string text;
};

// The lines of a text, without their ends. A carriage return is part of an end only before a line feed, or where the
// file ends: elsewhere it would make one line of many.
class Text_lines {
public:
  explicit Text_lines(Input_buffer& in) : in(in) {}

  bool next()
  {
    std::string& line = row_.text;
    line.clear();
    std::string_view bytes = in.bytes_at_hand();
    if(bytes.empty())
      return false;
    ++row_.number;
    bool has_end = false;
    while(!bytes.empty() && !has_end && line.size() <= longest_line + 1) {
      const std::size_t end = bytes.find('\n');
      has_end = end != bytes.npos;
      line.append(bytes.substr(0, end));
      in.skip(has_end ? end + 1 : bytes.size());
      bytes = has_end ? bytes : in.bytes_at_hand();
    }
    if(has_end || bytes.empty())
      line.resize(line.find_last_not_of('\r') + 1);
    check();
    if(row_.number == 1 && line.compare(0, 3, "\xEF\xBB\xBF") == 0) // the mark of UTF-8
      line.erase(0, 3);
    return true;
  }

  // The next one that is not empty.
  bool next_filled()
  {
    while(next())
      if(first_not_blank(row_.text) < row_.text.size())
        return true;
    return false;
  }

  const Text_row& row() const { return row_; }

private:
  void check() const
  {
    if(row_.text.find('\r') != row_.text.npos)
      fail_at_row(row_.number, carriage_return_alone);
    if(row_.text.size() > longest_line)
      fail_at_row(row_.number, "has more than " + std::to_string(longest_line) + " bytes, the limit of a line");
    if(row_.text.find('\0') != row_.text.npos)
      fail_at_row(row_.number, "has a byte 0, which no text has but one of UTF-16");
  }

  Input_buffer& in;
  Text_row row_ = {0, ""};
};

} // namespace program

#endif // DETECT_PLANES_TEXT_LINES_H
