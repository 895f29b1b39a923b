// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_PLY_ROWS_H
#define DETECT_PLANES_PLY_ROWS_H

#include "input/las_header.h"
#include "input/ply_points.h"
#include "input/table_values.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace program {

// A real number of a text, as a stream reads it: one that is too small becomes 0, a float is rounded once.
template <class Real>
bool parse_real(std::string_view word, Real& x)
{
  if(word.size() > 1 && word.front() == '+' && word[1] != '-')
    word.remove_prefix(1);
  const auto end = std::from_chars(word.data(), word.data() + word.size(), x);
  if(end.ptr != word.data() + word.size() || end.ec == std::errc())
    return end.ptr == word.data() + word.size() && !word.empty();
  std::istringstream in{std::string(word)};
  in.imbue(std::locale::classic());
  return bool(in >> x);
}

// The rows of an element of a PLY file that is known to be complete.
class Ply_rows {
public:
  Ply_rows(Byte_source& file, const std::string& format, const Ply_part& part)
    : in(file, part.bytes, ""), element(part.element), is_ascii(format == "ascii"),
      is_big(format == "binary_big_endian")
  {
    for(const Ply_header::Property& p : element.properties) {
      values.push_back(type_of(p.type));
      counts.push_back(type_of(p.is_list() ? p.count_type : p.type));
    }
  }

  // A number of each property: of a list that of its items, which `list` gets where it is wanted.
  void next(std::vector<double>& numbers, std::size_t wanted_list, std::vector<double>& list)
  {
    numbers.resize(values.size());
    for(std::size_t i = 0; i < values.size(); ++i) {
      numbers[i] = read(i, counts[i]);
      if(!element.properties[i].is_list())
        continue;
      list.resize(i == wanted_list ? std::size_t(numbers[i]) : list.size());
      for(std::size_t k = 0; k < std::size_t(numbers[i]); ++k) {
        const double item = read(i, values[i]);
        if(i == wanted_list)
          list[k] = item;
      }
    }
    ++row;
  }

  void next(std::vector<double>& numbers) { next(numbers, values.size(), no_list); }

private:
  // The kind is that of number_of_type().
  struct Type {
    char kind;
    std::size_t size;
  };

  static Type type_of(const std::string& name)
  {
    return {is_real_ply_type(name) ? 'F' : name[0] == 'u' ? 'U' : 'I', std::size_t(ply_type_size(name))};
  }

  double read(std::size_t property, const Type& type)
  {
    if(is_ascii)
      return parse(property, type);
    char bytes[8];
    if(in.sgetn(bytes, std::streamsize(type.size)) != std::streamsize(type.size))
      fail("");
    if(is_big)
      std::reverse(bytes, bytes + type.size);
    return number_of_type(bytes, type.kind, type.size);
  }

  double parse(std::size_t property, const Type& type)
  {
    skip_blanks_of(in);
    word.clear();
    for(int c = in.sgetc(); c != std::streambuf::traits_type::eof() && !is_blank(c); c = in.snextc())
      word += char(c);
    double x = 0;
    if(word.empty() || !parse_word(type, x))
      fail(word.empty() ? ""
                        : " (a value is not of the type that the header says: '" + word.substr(0, 40) +
                            "' of the property '" + element.properties[property].name + "')");
    return x;
  }

  bool parse_word(const Type& type, double& x) const
  {
    if(type.kind == 'F' && type.size == 8)
      return parse_real(word, x);
    if(type.kind == 'F') {
      float real = 0;
      const bool is_real = parse_real(word, real);
      x = double(real);
      return is_real;
    }
    std::int64_t integer = 0;
    const char* const first = word.data() + (word.size() > 1 && word[0] == '+' && is_digit(word[1]) ? 1 : 0);
    const auto end = std::from_chars(first, word.data() + word.size(), integer);
    x = double(integer);
    const std::int64_t largest = (std::int64_t(1) << (8 * type.size - (type.kind == 'U' ? 0 : 1))) - 1;
    return end.ec == std::errc() && end.ptr == word.data() + word.size() && integer <= largest &&
           integer >= (type.kind == 'U' ? 0 : -largest - 1);
  }

  [[noreturn]] void fail(const std::string& reason) const
  {
    if(is_interrupted())
      throw Interrupted();
    throw std::runtime_error("unreadable after " + std::string(element.name == "face" ? "face " : "point ") +
                             std::to_string(row) + " of " + std::to_string(element.count) + reason);
  }

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  Input_buffer in;
  Ply_header::Element element;
  bool is_ascii, is_big;
  std::vector<Type> values, counts;
  std::vector<double> no_list;
  std::string word;
  std::uint64_t row = 0; // those that were read
};

} // namespace program

#endif // DETECT_PLANES_PLY_ROWS_H
