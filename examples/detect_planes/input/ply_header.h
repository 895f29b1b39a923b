// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads the header of a PLY file, and rejects unknown types and missing or repeated properties.

#ifndef DETECT_PLANES_PLY_HEADER_H
#define DETECT_PLANES_PLY_HEADER_H

#include "input/Text_lines.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace program {

struct Ply_header {
  struct Property {
    std::string name, type;
    std::string count_type; // of a list, empty for a number

    bool is_list() const { return !count_type.empty(); }
  };
  struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
  };
  std::string format;
  std::vector<Element> elements;

  bool is_ascii() const { return format == "ascii"; }
};

// Bytes of a scalar type of PLY, 0 if there is no such type.
inline std::uint64_t ply_type_size(const std::string& type)
{
  static const std::map<std::string, std::uint64_t> sizes = {
    {"char", 1},   {"int8", 1},    {"uchar", 1},  {"uint8", 1},  {"short", 2}, {"int16", 2},
    {"ushort", 2}, {"uint16", 2},  {"int", 4},    {"int32", 4},  {"uint", 4},  {"uint32", 4},
    {"float", 4},  {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

inline bool is_real_ply_type(const std::string& type) { return type[0] == 'f' || type[0] == 'd'; }

inline void parse_ply_format(const std::string& name, Ply_header& header)
{
  if(name != "ascii" && name != "binary_little_endian" && name != "binary_big_endian")
    throw std::runtime_error("unknown format '" + name + "' of PLY");
  header.format = name;
}

inline void parse_ply_element(std::istream& words, Ply_header& header)
{
  std::string name;
  std::int64_t count = -1;
  if(!(words >> name >> count) || count < 0)
    throw std::runtime_error("the PLY header has no number of items for the element '" + name + "'");
  header.elements.push_back({name, std::uint64_t(count), {}});
}

inline void parse_ply_property(std::istream& words, Ply_header& header)
{
  Ply_header::Property p;
  words >> p.type;
  if(p.type == "list")
    words >> p.count_type >> p.type;
  if(!(words >> p.name) || header.elements.empty())
    throw std::runtime_error("the PLY header has an incomplete property");
  for(const std::string& type : {p.type, p.is_list() ? p.count_type : p.type})
    if(ply_type_size(type) == 0)
      throw std::runtime_error("unknown type '" + type + "' of the PLY property '" + p.name + "'");
  if(p.is_list() && is_real_ply_type(p.count_type))
    throw std::runtime_error("the number of items of the PLY list '" + p.name + "' must be an integer");
  header.elements.back().properties.push_back(p);
}

inline Ply_header read_ply_header(Text_lines& lines)
{
  constexpr std::size_t most_bytes = 1 << 20;
  Ply_header header;
  std::string keyword;
  if(!lines.next() || !(std::istringstream(lines.row().text) >> keyword) || keyword != "ply")
    throw std::runtime_error("is not a PLY file (the first line is not 'ply')");
  for(std::size_t bytes = 0; lines.next();) {
    bytes += lines.row().text.size() + 1;
    if(bytes > most_bytes)
      throw std::runtime_error("the PLY header has more than " + std::to_string(most_bytes) + " bytes, the limit");
    std::istringstream words(lines.row().text);
    if(!(words >> keyword))
      throw std::runtime_error("the PLY header has an empty line");
    if(header.format.empty() && keyword != "format")
      throw std::runtime_error("the second line of the PLY header is not its format");
    if(keyword == "format") {
      words >> keyword;
      parse_ply_format(keyword, header);
    } else if(keyword == "element") {
      parse_ply_element(words, header);
    } else if(keyword == "property") {
      parse_ply_property(words, header);
    } else if(keyword == "end_header") {
      return header;
    }
  }
  throw std::runtime_error("the PLY header has no end");
}

// The place of a number among the properties of an element, or their count: the one of that name, else the first one
// whose name differs by case.
inline std::size_t find_ply_number(const Ply_header::Element& element, const std::string& name)
{
  const auto find = [&](auto is_name) {
    const auto found = std::find_if(element.properties.begin(), element.properties.end(),
                                    [&](const auto& p) { return !p.is_list() && is_name(p.name); });
    return std::size_t(found - element.properties.begin());
  };
  const auto is_same = [&name](const std::string& other) {
    return std::equal(name.begin(), name.end(), other.begin(), other.end(),
                      [](unsigned char a, unsigned char b) { return a == std::tolower(b); });
  };
  const std::size_t exact = find([&name](const std::string& other) { return other == name; });
  return exact < element.properties.size() ? exact : find(is_same);
}

inline void check_ply_points(const Ply_header::Element& points)
{
  std::set<std::string> names;
  for(const Ply_header::Property& p : points.properties)
    if(!names.insert(p.name).second)
      throw std::runtime_error("the points of the PLY file have two properties '" + p.name + "'");
  for(const char* name : {"x", "y", "z"})
    if(find_ply_number(points, name) == points.properties.size())
      throw std::runtime_error(std::string("the points of the PLY file have no property '") + name + "'");
}

} // namespace program

#endif // DETECT_PLANES_PLY_HEADER_H
