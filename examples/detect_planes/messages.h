// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the program says about a run on standard error, one line each, and texts that may have any bytes: names of files
// and other pieces of input, in messages and in JSON.

#ifndef DETECT_PLANES_MESSAGES_H
#define DETECT_PLANES_MESSAGES_H

#include <cstddef>
#include <iostream>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>

namespace program {

// The number of bytes of the UTF-8 character that a text begins with; 0 if it begins with something else.
inline std::size_t utf8_length(std::string_view text)
{
  const auto byte = [&](std::size_t i) { return (unsigned char)(text[i]); };
  if(text.empty())
    return 0;
  if(byte(0) < 0x80)
    return 1;
  const std::size_t n = byte(0) < 0xc2 ? 0 : byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : byte(0) < 0xf5 ? 4 : 0;
  if(n == 0 || text.size() < n)
    return 0;
  for(std::size_t i = 1; i < n; ++i)
    if((byte(i) & 0xc0) != 0x80)
      return 0;
  const bool is_too_long = (byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xf0 && byte(1) < 0x90);
  const bool is_no_character = (byte(0) == 0xed && byte(1) >= 0xa0) || (byte(0) == 0xf4 && byte(1) >= 0x90);
  return is_too_long || is_no_character ? 0 : n;
}

// Whether a text begins with a character, in UTF-8, that controls what shows it. Its last byte is its code.
inline bool begins_with_control(std::string_view text)
{
  const unsigned char first = text.empty() ? 0x20 : (unsigned char)(text[0]);
  return first < 0x20 || first == 0x7f || (utf8_length(text) == 2 && first == 0xc2 && (unsigned char)(text[1]) < 0xa0);
}

// Whether a text begins with a character that changes the direction of others.
inline bool begins_with_direction(std::string_view text)
{
  const std::string_view all[] = {"\u061c", "\u200e", "\u200f", "\u202a", "\u202b", "\u202c",
                                  "\u202d", "\u202e", "\u2066", "\u2067", "\u2068", "\u2069"};
  for(std::string_view one : all)
    if(text.substr(0, one.size()) == one)
      return true;
  return false;
}

// The number of bytes of the character that a text begins with, if it can be shown: it is UTF-8, and does not control
// what shows it. Otherwise 0.
inline std::size_t visible_length(std::string_view text)
{
  return begins_with_control(text) || begins_with_direction(text) ? 0 : utf8_length(text);
}

// Writes \x1b for a byte that cannot be shown, so that no input controls a terminal. Works without memory.
inline void write_visible(std::ostream& out, std::string_view text)
{
  while(!text.empty()) {
    std::size_t shown = 0;
    for(std::size_t n = 1; n > 0; shown += n)
      n = visible_length(text.substr(shown));
    out.write(text.data(), std::streamsize(shown));
    text.remove_prefix(shown);
    if(text.empty())
      return;
    const unsigned char byte = (unsigned char)(text[0]);
    out << "\\x"
        << "0123456789abcdef"[byte / 16] << "0123456789abcdef"[byte % 16];
    text.remove_prefix(1);
  }
}

// One line, whatever a library or the name of a file put into the message. Works without memory, too.
inline void print_message(const char* before, std::string_view message, const char* after = "")
{
  std::cerr << before;
  write_visible(std::cerr, message);
  std::cerr << after << std::endl;
}

// Returns the exit code.
inline int fail(int code, const char* message, const char* advice = "")
{
  print_message("detect_planes: ", message, advice);
  return code;
}

inline void warn(std::string_view message) { print_message("detect_planes: warning: ", message); }

// CGAL reports on std::cerr; its message becomes part of our one line. Some of it reports on std::cout.
class Captured_messages {
public:
  explicit Captured_messages(std::ostream& stream = std::cerr)
    : stream(stream), precision(stream.precision()), previous(stream.rdbuf(text.rdbuf()))
  {}
  ~Captured_messages()
  {
    stream.rdbuf(previous);
    stream.precision(precision);
  }
  Captured_messages(const Captured_messages&) = delete;
  Captured_messages& operator=(const Captured_messages&) = delete;

  std::string first_line() const { return text.str().substr(0, text.str().find('\n')); }

private:
  std::ostream& stream;
  std::ostringstream text;
  std::streamsize precision;
  std::streambuf* previous;
};

} // namespace program

#endif // DETECT_PLANES_MESSAGES_H
