// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What files of polygons have in them, read as other programs read it. PLY and OFF have the mesh of OBJ: test_scene.py.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_WRITTEN_POLYGONS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_WRITTEN_POLYGONS_H

#include "output/writers.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdlib>
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
      result.back().polygons.push_back({{ring}});
    }
  }
  return result;
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_WRITTEN_POLYGONS_H
