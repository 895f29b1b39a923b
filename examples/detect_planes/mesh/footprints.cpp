// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/footprints.h"
#include "errors.h"
#include "output/report.h"

#include <fstream>

namespace program {

namespace {

// The first corner of a ring is also the last one.
CGAL::Polygon_2<Kernel> polygon_of(const Json& ring)
{
  CGAL::Polygon_2<Kernel> result;
  for(const Json& corner : ring)
    result.push_back(Kernel::Point_2(corner.at(0).get<double>(), corner.at(1).get<double>()));
  if(result.size() > 1 && result[0] == result[result.size() - 1])
    result.erase(result.vertices_end() - 1);
  if(result.size() < 3 || !result.is_simple())
    throw_error("a boundary of a polygon touches itself, or has less than three corners");
  return result;
}

void add_footprint(const Json& rings, Footprints& footprints)
try {
  footprints.emplace_back(polygon_of(rings.at(0)));
  for(std::size_t i = 1; i < rings.size(); ++i)
    footprints.back().add_hole(polygon_of(rings[i]));
} catch(const std::runtime_error& e) {
  throw_error("polygon ", footprints.size() + 1, ": ", e.what());
}

void add_footprints(const Json& object, Footprints& footprints)
{
  const Json& type = object.at("type");
  const auto add_members = [&](const char* name) {
    for(const Json& member : object.at(name))
      add_footprints(member, footprints);
  };
  if(type == "FeatureCollection")
    add_members("features");
  else if(type == "GeometryCollection")
    add_members("geometries");
  else if(type == "Feature" && !object.at("geometry").is_null())
    add_footprints(object["geometry"], footprints);
  else if(type == "Polygon")
    add_footprint(object.at("coordinates"), footprints);
  else if(type == "MultiPolygon")
    for(const Json& rings : object.at("coordinates"))
      add_footprint(rings, footprints);
}

} // namespace

Footprints read_footprints(const std::string& path)
try {
  Footprints result;
  std::ifstream in(path);
  if(!in)
    throw_error("cannot be opened", reason_of(errno));
  add_footprints(Json::parse(in), result);
  if(result.empty())
    throw_error("has no polygons");
  return result;
} catch(const Json::exception& e) {
  throw_error("--footprint ", path, ": is no GeoJSON: ", e.what());
} catch(const std::exception& e) {
  throw_error("--footprint ", path, ": ", e.what());
}

} // namespace program
