// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pieces of an HTML page that needs no other file: text, tables, embedded pictures.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_HTML_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_HTML_H

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace benchmark {
namespace html {

inline std::string escaped(const std::string& text)
{
  std::string result;
  for(char c : text)
    if(c == '&')
      result += "&amp;";
    else if(c == '<')
      result += "&lt;";
    else if(c == '>')
      result += "&gt;";
    else if(c == '"')
      result += "&quot;";
    else
      result += c;
  return result;
}

// As the head of a column: long names may be broken at "_".
inline std::string breakable(const std::string& text)
{
  std::string result = escaped(text);
  for(std::size_t i = 0; (i = result.find('_', i)) != std::string::npos; i += 6)
    result.insert(i + 1, "<wbr>");
  return result;
}

// The content is HTML already. tag("td class=x", "y") is <td class=x>y</td>.
inline std::string tag(const std::string& opening, const std::string& content)
{
  return "<" + opening + ">" + content + "</" + opening.substr(0, opening.find(' ')) + ">";
}

inline std::string read_file(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline bool exists(const std::string& path) { return bool(std::ifstream(path)); }

inline std::string base64(const std::string& bytes)
{
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for(std::size_t i = 0; i < bytes.size(); i += 3) {
    std::size_t left = bytes.size() - i;
    auto byte = [&](std::size_t k) { return k < left ? unsigned(static_cast<unsigned char>(bytes[i + k])) : 0u; };
    unsigned word = byte(0) << 16 | byte(1) << 8 | byte(2);
    for(std::size_t k = 0; k < 4; ++k)
      result += k <= left ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return result;
}

// Of type image/png or image/svg+xml.
inline std::string image(const std::string& path, const std::string& type, const std::string& description)
{
  return "<img loading=lazy alt=\"" + escaped(description) + "\" src=\"data:" + type + ";base64," +
         base64(read_file(path)) + "\">";
}

inline std::string fixed(double value, int digits)
{
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

// Three digits that count: 0.0123, 1.23, 12.3, 123.
inline std::string rounded(double value)
{
  double size = value < 0 ? -value : value;
  int digits = size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : size >= 0.1 ? 3 : 4;
  return fixed(value, size == 0 ? 0 : digits);
}

// 1234567.8 becomes 1,234,567.8.
inline std::string grouped(std::string number)
{
  std::size_t first = number[0] == '-' ? 1 : 0, end = number.find('.');
  if(end == std::string::npos)
    end = number.size();
  for(std::size_t i = end; i > first + 3;) {
    i -= 3;
    number.insert(i, ",");
  }
  return number;
}

// Wide tables scroll by themselves.
inline std::string table(const std::string& head, const std::string& body, const std::string& caption)
{
  std::string inside = tag("caption", caption) + tag("thead", tag("tr", head)) + tag("tbody", body);
  return tag("div class=scroll tabindex=0", tag("table", inside)) + "\n";
}

} // namespace html
} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_HTML_H
