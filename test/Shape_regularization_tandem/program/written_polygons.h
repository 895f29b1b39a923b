// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What files of polygons have in them, read as other programs read it.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_WRITTEN_POLYGONS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_WRITTEN_POLYGONS_H

#include "output/Described_shapes.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using Position = std::array<double, 3>;
using Ring = std::vector<Position>; // the first corner is not there again
struct Written_polygon {
  std::vector<Ring> rings; // the outer one first
};
struct Written_shape {
  std::vector<Written_polygon> polygons;
  double area = 0; // as written; GeoJSON only
};
using Written_shapes = std::vector<Written_shape>;
using Json = nlohmann::json; // its parser takes nothing but JSON: no "nan"

// All of the text, and finite.
inline double number_of(const std::string& text)
{
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if(text.empty() || *end != '\0' || !std::isfinite(value))
    throw std::runtime_error("no finite number: " + text);
  return value;
}

// Areas may be larger than doubles are.
inline double area_of(const Json& json) { return json.is_null() ? HUGE_VAL : json.get<double>(); }

inline Ring ring_of(const Json& json)
{
  Ring ring;
  for(const Json& corner : json) {
    if(corner.size() != 3)
      throw std::runtime_error("a corner without three coordinates");
    ring.push_back(corner.get<Position>());
  }
  if(ring.size() < 4 || ring.front() != ring.back())
    throw std::runtime_error("a ring that is not closed");
  ring.pop_back();
  return ring;
}

inline Written_shapes read_geojson(const std::string& text)
{
  Written_shapes result;
  const Json json = Json::parse(text);
  for(const Json& feature : json.at("features")) {
    result.emplace_back();
    result.back().area = area_of(feature.at("properties").at("area"));
    for(const Json& polygon : feature.at("geometry").at("coordinates")) {
      result.back().polygons.emplace_back();
      for(const Json& ring : polygon)
        result.back().polygons.back().rings.push_back(ring_of(ring));
    }
  }
  return result;
}

inline Written_shapes read_obj(const std::string& text)
{
  Written_shapes result;
  std::vector<Position> vertices;
  std::istringstream lines(text);
  for(std::string line; std::getline(lines, line);) {
    std::istringstream in(line);
    std::string word;
    in >> word;
    if(word == "g")
      result.emplace_back();
    else if(word == "v") {
      Position p;
      for(double& x : p) {
        in >> word;
        x = number_of(word);
      }
      vertices.push_back(p);
    } else if(word == "f") {
      Ring ring;
      for(std::size_t corner; in >> corner;)
        ring.push_back(vertices.at(corner - 1));
      result.at(result.size() - 1).polygons.push_back({{ring}});
    }
  }
  return result;
}

// The colors are those of the shapes.
inline Written_shapes read_off(const std::string& text, std::size_t number_of_shapes)
{
  Written_shapes result(number_of_shapes);
  std::map<program::Color, std::size_t> shape_of;
  for(std::size_t s = number_of_shapes; s > 0; --s)
    shape_of[program::color_of_shape(int(s) - 1)] = s - 1;
  std::istringstream in(text);
  std::string word;
  std::getline(in, word);
  std::getline(in, word);
  std::size_t number_of_vertices, number_of_faces, edges;
  in >> number_of_vertices >> number_of_faces >> edges;
  std::vector<Position> vertices(number_of_vertices);
  for(Position& p : vertices)
    for(double& x : p) {
      in >> word;
      x = number_of(word);
    }
  for(; number_of_faces > 0; --number_of_faces) {
    std::size_t count, corner;
    Ring ring;
    for(in >> count; count > 0 && in >> corner; --count)
      ring.push_back(vertices.at(corner));
    int r, g, b;
    in >> r >> g >> b;
    const program::Color color = {std::uint8_t(r), std::uint8_t(g), std::uint8_t(b)};
    result.at(shape_of.at(color)).polygons.push_back({{ring}});
  }
  if(!in || in >> word)
    throw std::runtime_error("not as many numbers as the header says");
  return result;
}

class Ply_bytes {
public:
  explicit Ply_bytes(const std::string& text) : text_(text), position_(text.find("end_header\n") + 11) {}

  template <class T>
  T next()
  {
    T value;
    std::memcpy(&value, text_.substr(position_, sizeof value).data(), sizeof value);
    position_ += sizeof value;
    return value;
  }

  std::size_t count_of(const std::string& element) const
  {
    return std::size_t(std::atol(text_.c_str() + text_.find("element " + element + ' ') + 9 + element.size()));
  }
  bool has(const std::string& line) const { return text_.find(line) < position_; }
  bool is_at_end() const { return position_ == text_.size(); }

private:
  const std::string& text_;
  std::size_t position_;
};

inline Written_shapes read_ply(const std::string& text, std::size_t number_of_shapes)
{
  Written_shapes result(number_of_shapes);
  Ply_bytes bytes(text);
  std::vector<Position> vertices(bytes.count_of("vertex"));
  for(Position& p : vertices)
    for(double& x : p)
      x = bytes.next<double>();
  const bool is_small = bytes.has("property list uchar int");
  for(std::size_t f = bytes.count_of("face"); f > 0; --f) {
    Ring ring;
    for(int n = is_small ? int(bytes.next<std::uint8_t>()) : bytes.next<std::int32_t>(); n > 0; --n)
      ring.push_back(vertices.at(std::size_t(bytes.next<std::int32_t>())));
    for(int channel = 0; channel < 3; ++channel)
      bytes.next<std::uint8_t>();
    result.at(std::size_t(bytes.next<std::int32_t>())).polygons.push_back({{ring}});
  }
  if(!bytes.is_at_end())
    throw std::runtime_error("more bytes than the header says");
  return result;
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_WRITTEN_POLYGONS_H
