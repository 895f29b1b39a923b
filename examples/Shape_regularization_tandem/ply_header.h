// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads the header of a PLY file and rejects what CGAL's reader would misread or
// crash on: unknown types, missing or mixed coordinates, a file that is too short.

#ifndef DETECT_PLANES_PLY_HEADER_H
#define DETECT_PLANES_PLY_HEADER_H

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace program {

struct Ply_header {
  struct Property {
    std::string name, type; // type "list" for a list
  };
  struct Element {
    std::string name;
    std::uint64_t count;
    std::vector<Property> properties;
  };
  bool is_ascii = true;
  std::vector<Element> elements;
  std::uint64_t size = 0; // bytes up to and with the line end_header
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

inline void parse_ply_format(const std::string& name, Ply_header& header)
{
  if(name != "ascii" && name != "binary_little_endian" && name != "binary_big_endian")
    throw std::runtime_error("unknown format '" + name + "' of PLY");
  header.is_ascii = name == "ascii";
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
  std::string type, name;
  words >> type >> name;
  std::string item_type = type;
  if(type == "list")
    words >> item_type >> name;
  if(!words || header.elements.empty())
    throw std::runtime_error("the PLY header has an incomplete property");
  if(ply_type_size(item_type) == 0)
    throw std::runtime_error("unknown type '" + item_type + "' of the PLY property '" + name + "'");
  header.elements.back().properties.push_back({name, type});
}

inline Ply_header read_ply_header(std::istream& in)
{
  Ply_header header;
  std::string line, keyword;
  if(!std::getline(in, line) || line.substr(0, line.find_last_not_of(" \r") + 1) != "ply")
    throw std::runtime_error("is not a PLY file (the first line is not 'ply')");
  bool has_format = false;
  while(std::getline(in, line) && line.size() < 4096) {
    std::istringstream words(line);
    if(!(words >> keyword))
      throw std::runtime_error("the PLY header has an empty line");
    if(!has_format && keyword != "format")
      throw std::runtime_error("the second line of the PLY header is not its format");
    if(keyword == "format") {
      has_format = bool(words >> keyword);
      parse_ply_format(keyword, header);
    } else if(keyword == "element") {
      parse_ply_element(words, header);
    } else if(keyword == "property") {
      parse_ply_property(words, header);
    } else if(keyword == "end_header") {
      header.size = std::uint64_t(in.tellg());
      return header;
    }
  }
  throw std::runtime_error("the PLY header has no end");
}

// CGAL reads coordinates as float or double, the same for all; normals of a float
// cloud as float.
inline void check_ply_coordinates(const Ply_header::Element& vertices)
{
  std::map<std::string, std::uint64_t> size;
  for(const Ply_header::Property& p : vertices.properties)
    size[p.name] = p.type[0] == 'f' || p.type[0] == 'd' ? ply_type_size(p.type) : 0;
  for(const char* name : {"x", "y", "z"}) {
    if(size.count(name) == 0)
      throw std::runtime_error(std::string("the points of the PLY file have no property '") + name + "'");
    if(size[name] == 0 || size[name] != size["x"])
      throw std::runtime_error("the coordinates x, y and z must be all float or all double");
  }
  if(size.count("nx") * size.count("ny") * size.count("nz") == 0)
    return;
  for(const char* name : {"nx", "ny", "nz"})
    if(size[name] == 0 || size[name] > size["x"])
      throw std::runtime_error(std::string("the normals must be float") +
                               (size["x"] == 4 ? ", as the coordinates are" : " or double"));
}

// The least number of bytes that the items of the element take.
inline std::uint64_t least_item_size(const Ply_header::Element& element, bool is_ascii)
{
  std::uint64_t bytes = 0;
  for(const Ply_header::Property& p : element.properties)
    bytes += is_ascii ? 2 : p.type == "list" ? 1 : ply_type_size(p.type);
  return bytes;
}

// Returns the number of points. Throws if the file cannot be read, with its name.
inline std::size_t check_ply(const std::string& path)
{
  try {
    std::ifstream in(path, std::ios::binary);
    const Ply_header header = read_ply_header(in);
    std::uint64_t left = std::uint64_t(std::filesystem::file_size(path)) - header.size + (header.is_ascii ? 1 : 0);
    const Ply_header::Element* vertices = nullptr;
    for(const Ply_header::Element& element : header.elements) {
      const std::uint64_t item = least_item_size(element, header.is_ascii);
      if(item > 0 && element.count > left / item)
        throw std::runtime_error("is truncated: " + std::to_string(element.count) + " items of '" + element.name +
                                 "' announced, room for " + std::to_string(left / item) + " at most");
      left -= item * element.count;
      if(element.name == "vertex" || element.name == "vertices")
        vertices = &element;
    }
    if(vertices == nullptr)
      throw std::runtime_error("the PLY file has no element 'vertex'");
    check_ply_coordinates(*vertices);
    return vertices->count;
  } catch(const std::exception& e) {
    throw std::runtime_error(path + ": " + e.what());
  }
}

} // namespace program

#endif // DETECT_PLANES_PLY_HEADER_H
