// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_BASE64_LINES_H
#define DETECT_PLANES_BASE64_LINES_H

#include "output/write_results.h"

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

#include <ostream>
#include <sstream>
#include <string>

namespace program {

inline std::string base64(std::string bytes)
{
  namespace it = boost::archive::iterators;
  using Digits = it::base64_from_binary<it::transform_width<std::string::const_iterator, 6, 8>>;
  const std::size_t padding = (3 - bytes.size() % 3) % 3;
  bytes.append(padding, '\0');
  std::string text(Digits(bytes.begin()), Digits(bytes.end()));
  return text.replace(text.size() - padding, padding, padding, '=');
}

// Numbers as their bytes, least significant first, as lines of Base64: an element of a page that is no markup.
class Base64_lines {
public:
  Base64_lines(std::ostream& out, const char* id) : out(out), binary(bytes)
  {
    out << "<script type=\"text/plain\" id=\"" << id << "\">\n";
  }

  ~Base64_lines()
  {
    flush();
    out << "</script>\n";
  }

  Base64_lines(const Base64_lines&) = delete;
  Base64_lines& operator=(const Base64_lines&) = delete;

  template <class T>
  void write(T value)
  {
    binary.write(value);
    size += sizeof(T);
    if(size >= line_size)
      flush();
  }

private:
  static constexpr std::size_t line_size = 30000;

  void flush()
  {
    if(size > 0)
      out << base64(bytes.str()) << '\n';
    bytes.str("");
    size = 0;
  }

  std::ostream& out;
  std::ostringstream bytes;
  Binary_writer binary;
  std::size_t size = 0;
};

} // namespace program

#endif // DETECT_PLANES_BASE64_LINES_H
