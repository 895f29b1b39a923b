// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bytes of a file, its lines, and the values of a row of a table.

#ifndef DETECT_PLANES_INPUT_BUFFER_H
#define DETECT_PLANES_INPUT_BUFFER_H

#include "errors.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace program {

// --- The bytes of a file, and how the readers get them.

// The bytes of a file; of one that ends in .gz, those that it had before it was compressed.
class Byte_source {
public:
  virtual ~Byte_source() = default;
  virtual std::uint64_t size() const = 0;
  virtual void seek(std::uint64_t position) = 0;
  virtual std::size_t read(char* bytes, std::size_t count) = 0; // less than `count` at the end
};

// A file as it is, or a pipe, whose size is not known and which is read once.
class File_source final : public Byte_source {
public:
  explicit File_source(const std::string& path)
  {
    if(std::filesystem::is_directory(path))
      throw std::runtime_error("is a directory");
    errno = 0;
    file.open(path, std::ios::binary);
    if(!file)
      throw_error("cannot be opened", reason_of(errno));
    std::error_code error;
    size_ = std::filesystem::file_size(path, error); // the largest number where there is none
  }

  std::uint64_t size() const override { return size_; }
  void seek(std::uint64_t position) override { file.rdbuf()->pubseekpos(std::streamoff(position), std::ios::in); }
  std::size_t read(char* bytes, std::size_t count) override
  {
    errno = 0;
    file.clear();
    file.read(bytes, std::streamsize(count));
    if(file.bad())
      throw_error("cannot be read", reason_of(errno));
    return std::size_t(file.gcount());
  }

private:
  std::ifstream file;
  std::uint64_t size_;
};

std::unique_ptr<Byte_source> open_bytes(const std::string& path);
std::unique_ptr<Byte_source> open_gzip(const std::string& path); // by zlib

// Reads a file from a byte on. A signal ends it early: streams do not know of signals, but they stop where a file ends.
class Input_buffer : public std::streambuf {
public:
  explicit Input_buffer(Byte_source& file, std::uint64_t first = 0) : file(file), position_of_file(first)
  {
    file.seek(first);
  }

  // The byte of the file that is read next.
  std::uint64_t position() const { return position_of_file - std::uint64_t(egptr() - gptr()); }

  std::uint64_t left() const { return file.size() - position(); }

  // At most as many bytes as are left.
  void skip(std::uint64_t bytes)
  {
    const std::uint64_t buffered = (std::min)(bytes, std::uint64_t(egptr() - gptr()));
    gbump(int(buffered));
    if(bytes == buffered)
      return;
    position_of_file += bytes - buffered;
    file.seek(position_of_file);
  }

protected:
  int_type underflow() override
  {
    if(is_interrupted())
      return traits_type::eof();
    const std::size_t n = file.read(buffer.data(), buffer.size());
    position_of_file += n;
    setg(buffer.data(), buffer.data(), buffer.data() + n);
    return n == 0 ? traits_type::eof() : traits_type::to_int_type(buffer[0]);
  }

private:
  Byte_source& file;
  std::array<char, 65536> buffer;
  std::uint64_t position_of_file; // behind the bytes in the buffer
};

constexpr std::size_t longest_line = 65536; // in bytes. Longer ones are no text, and would fill the memory

constexpr const char* carriage_return_alone =
  "ends in a carriage return alone (end lines with a line feed: tr '\\r' '\\n' < FILE)";

template <class... Words>
[[noreturn]] void fail_at_row(std::size_t row, const Words&... words)
{
  throw_error("row ", row, ' ', words...);
}

inline bool is_blank(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

inline std::size_t first_not_blank(std::string_view text)
{
  return std::size_t(std::find_if_not(text.begin(), text.end(), is_blank) - text.begin());
}

inline bool is_comment(std::string_view row)
{
  row.remove_prefix(first_not_blank(row));
  return row.substr(0, 1) == "#" || row.substr(0, 2) == "//";
}

// What separates the values of a row: semicolons if it has any, else commas, else blanks. So a row that has several of
// them is no row of numbers.
inline char separator_of(std::string_view row)
{
  bool is_quoted = false;
  char separator = ' ';
  for(char c : row) {
    is_quoted = is_quoted != (c == '"');
    if(!is_quoted && (c == ';' || (c == ',' && separator == ' ')))
      separator = c;
  }
  return separator;
}

using Cells = std::vector<std::string_view>;

// The values of a row. Between two commas or semicolons there may be an empty one; blanks around them do not count, nor do
// quotes, in which a value may have separators.
inline Cells values_of(std::string_view row, char separator)
{
  Cells values;
  const auto is_end = [=](char c) { return separator == ' ' ? is_blank(c) : c == separator; };
  for(row.remove_prefix(first_not_blank(row)); !row.empty(); row.remove_prefix(first_not_blank(row))) {
    std::size_t quote = row.front() == '"' ? row.find('"', 1) : row.npos;
    while(quote < row.size() && row.substr(quote + 1, 1) == "\"") // two stand for one
      quote = row.find('"', quote + 2);
    const auto first = row.begin() + std::ptrdiff_t(quote == row.npos ? 0 : quote);
    std::string_view value = row.substr(0, std::size_t(std::find_if(first, row.end(), is_end) - row.begin()));
    row.remove_prefix((std::min)(value.size() + 1, row.size()));
    while(!value.empty() && is_blank(value.back()))
      value.remove_suffix(1);
    if(quote != row.npos && quote + 1 == value.size())
      value = value.substr(1, quote - 1);
    values.push_back(value);
  }
  return values;
}

inline Cells values_of(std::string_view row) { return values_of(row, separator_of(row)); }

struct Text_row {
  std::size_t number; // in the file, from 1 on
  std::string text;
};

// Makes points of decimal commas: of a comma before a digit, behind one or at the beginning of a number.
inline void change_commas(Text_row& row)
{
  std::string& text = row.text;
  for(std::string_view value : values_of(text, text.find(';') == text.npos ? ' ' : ';'))
    if(value.find('.') != value.npos && value.find_first_not_of("0123456789+-.,eE") == value.npos &&
       value.find_first_of("0123456789") != value.npos && !is_comment(text))
      fail_at_row(row.number, "has '", value.substr(0, 40),
                  "': with --decimal-comma, numbers have a comma, but no point and no separators of thousands");
  for(std::size_t i = 0; i + 1 < text.size(); ++i)
    if(text[i] == ',' && is_digit(text[i + 1]) &&
       (i == 0 || is_digit(text[i - 1]) || is_blank(text[i - 1]) ||
        std::string_view(";+-").find(text[i - 1]) != std::string_view::npos))
      text[i] = '.';
}

// The lines of a text, without their ends. A carriage return is part of an end only before a line feed, or where the
// file ends: elsewhere it would make one line of many.
class Text_lines {
public:
  explicit Text_lines(Input_buffer& in, bool has_decimal_commas = false)
    : in(&in), has_decimal_commas(has_decimal_commas)
  {
    this->in.exceptions(std::ios::badbit); // of the file
  }

  bool next()
  {
    std::string& line = row_.text;
    in.getline(bytes.data(), std::streamsize(bytes.size()));
    const auto size = std::size_t(in.gcount());
    const bool is_cut = in.fail() && !in.eof();
    if(size == 0)
      return false;
    ++row_.number;
    line.assign(bytes.data(), size - (in.good() ? 1 : 0)); // without the line feed
    if(!is_cut)                                            // else it is too long
      line.resize(line.find_last_not_of('\r') + 1);
    check();
    if(row_.number == 1 && line.compare(0, 3, "\xEF\xBB\xBF") == 0) // the mark of UTF-8
      line.erase(0, 3);
    return true;
  }

  // The next one that is not empty, where numbers have decimal points.
  bool next_filled()
  {
    do
      if(!next())
        return false;
    while(first_not_blank(row_.text) == row_.text.size());
    if(has_decimal_commas)
      change_commas(row_);
    return true;
  }

  const Text_row& row() const { return row_; }

private:
  void check() const
  {
    if(row_.text.find('\r') != row_.text.npos)
      fail_at_row(row_.number, carriage_return_alone);
    if(row_.text.size() > longest_line)
      fail_at_row(row_.number, "has more than ", longest_line, " bytes, the limit of a line");
    if(row_.text.find('\0') != row_.text.npos)
      fail_at_row(row_.number, "has a byte 0, as texts in UTF-16 have (convert the file to UTF-8)");
  }

  std::istream in;
  bool has_decimal_commas;
  std::vector<char> bytes = std::vector<char>(longest_line + 3);
  Text_row row_ = {0, ""};
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

// What there is to say of a row that cannot be read.
inline std::string advice_on_commas(std::string_view row)
{
  return row.find(',') == row.npos
           ? ""
           : "; numbers have no commas: write numbers with a decimal point, and without separators of thousands";
}

// The numbers of a row.
inline std::vector<double> numbers_of(const Text_row& row, char separator)
{
  std::vector<double> numbers;
  for(std::string_view text : values_of(row.text, separator)) {
    const std::optional<double> number = parse_number(text);
    if(!number)
      fail_at_row(row.number, "has '", text.substr(0, 40), "' where a number is expected",
                  separator == ' ' ? advice_on_commas(row.text) : "");
    numbers.push_back(*number);
  }
  return numbers;
}

} // namespace program

#endif // DETECT_PLANES_INPUT_BUFFER_H
