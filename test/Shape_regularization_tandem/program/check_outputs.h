// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the outputs of a scene, reads them back, and checks them.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECK_OUTPUTS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECK_OUTPUTS_H

#include "testing/test_support.h"

#include "program/Polygon_checker.h"

#include "output/writers.h"

#include <map>
#include <sstream>
#include <string>
#include <vector>

using program::Faces_of_file;
using program::Point_set;

struct Totals {
  std::size_t scenes = 0, shapes = 0, with_polygons = 0, polygons = 0, points = 0, inside = 0;
};

struct Output_case {
  std::string name;
  Point_set points;
  program::Shapes shapes;
};

inline std::string text_of_polygons(const Output_case& c, const std::string& path, Faces_of_file faces)
{
  std::ostringstream out;
  program::write_polygons(out, program::Described_shapes(c.points, c.shapes),
                          {program::lower_case_extension(path), faces, ""});
  return out.str();
}

inline void check_none(const Polygon_checker::Violations& violations, const Output_case& c, const std::string& what)
{
  CHECK_AT(violations.empty(), c.name + ", " + what + ": " + std::to_string(violations.size()) + " violations, " +
                                 (violations.empty() ? "" : violations.front()));
}

// A polygon has points of its shape in it, and most points are in a polygon.
inline void check_points(const Output_case& c, std::size_t s, const Written_shape& shape, Totals& totals)
{
  const Polygon_checker checker(c.shapes, s);
  std::vector<std::size_t> inside(shape.polygons.size());
  for(std::size_t i : c.shapes.points(s)) {
    const auto foot = checker.foot(c.points.point(*(c.points.begin() + std::ptrdiff_t(i))));
    for(std::size_t p = 0; p < shape.polygons.size(); ++p)
      inside[p] += checker.is_inside(shape.polygons[p], foot);
  }
  for(std::size_t count : inside) {
    CHECK_AT(count >= 3, c.name + ", points in a polygon: " + std::to_string(count));
    totals.inside += count;
  }
  totals.points += shape.polygons.empty() ? 0 : c.shapes.points(s).size();
  totals.with_polygons += !shape.polygons.empty();
  totals.polygons += shape.polygons.size();
}

inline Written_shapes check_polygons(const Output_case& c, Totals& totals)
{
  const Written_shapes shapes = read_geojson(text_of_polygons(c, "a.geojson", Faces_of_file::polygons));
  CHECK_AT(shapes.size() == c.shapes.number_of_shapes(), c.name);
  for(std::size_t s = 0; s < shapes.size(); ++s) {
    check_none(Polygon_checker(c.shapes, s).violations(shapes[s]), c, "shape " + std::to_string(s));
    check_points(c, s, shapes[s], totals);
  }
  const auto check_faces = [&](const std::string& path, Faces_of_file kind, Polygon_checker::Seen_from side) {
    const std::string text = text_of_polygons(c, path, kind);
    const Written_shapes faces = path == "a.obj" ? read_obj(text) : read_geojson(text);
    CHECK_AT(faces.size() == shapes.size(), c.name + ' ' + path);
    for(std::size_t s = 0; s < faces.size(); ++s)
      check_none(Polygon_checker(c.shapes, s, side).violations_of_faces(faces[s], shapes[s].area), c, path);
  };
  check_faces("a.geojson", Faces_of_file::triangles, Polygon_checker::Seen_from::above);
  for(Faces_of_file kind : {Faces_of_file::polygons, Faces_of_file::triangles})
    check_faces("a.obj", kind, Polygon_checker::Seen_from::outside);
  return shapes;
}

// --- The other files

// The numbers that the page has of the shapes.
inline void check_view(const Output_case& c, const Written_shapes& polygons)
{
  program::Run run;
  std::ostringstream out;
  program::write_view(out, program::Described_shapes(c.points, c.shapes), run);
  const std::string text = out.str(), begin = "id=\"scene\">";
  const std::size_t first = text.rfind(begin) + begin.size();
  const Json scene = Json::parse(text.substr(first, text.find("</script>", first) - first));
  CHECK_AT(scene.at("assigned") == c.shapes.statistics().number_of_assigned_points, c.name);
  std::size_t s = 0;
  for(const Json& area : scene.at("shapes").at("area"))
    CHECK_AT(area_of(area) == polygons.at(s++).area, c.name);
  CHECK_AT(s == polygons.size(), c.name);
  for(const char* name : {"coefficients", "centroid", "mean_distance", "turned_deg", "shifted"})
    for(const Json& number : scene.at("shapes").at(name))
      CHECK_AT(number.is_number(), c.name + ' ' + name);
}

// Numbers or words after a key, and each point in one group at most.
inline void check_vg(const Output_case& c)
{
  std::stringstream file;
  program::write_vg(file, c.points, c.shapes);
  std::map<std::string, std::size_t> sum;
  for(std::string line; std::getline(file, line);) {
    std::istringstream in(line);
    std::string word, key;
    while(in >> word)
      if(word.back() == ':')
        key = word;
      else if(key != "group_label:")
        sum[key] += key == "group_num_points:" || key == "num_groups:" ? std::size_t(number_of(word))
                                                                       : 0 * std::size_t(number_of(word) != 0);
  }
  CHECK_AT(sum["group_num_points:"] == c.shapes.statistics().number_of_assigned_points, c.name);
  CHECK_AT(sum["num_groups:"] == c.shapes.number_of_shapes(), c.name);
}

// --- Scenes

inline Output_case case_of(const std::string& name, const Cloud& cloud, const Shapes& shapes)
{
  Output_case result = {name, {}, program::Shapes(shapes.data())};
  result.points.add_normal_map();
  for(const auto& [p, n] : cloud)
    result.points.insert(program::Kernel::Point_3(p.x(), p.y(), p.z()), program::Kernel::Vector_3(n.x(), n.y(), n.z()));
  return result;
}

inline void check_outputs(const Output_case& c, Totals& totals)
{
  ++totals.scenes;
  totals.shapes += c.shapes.number_of_shapes();
  try {
    check_view(c, check_polygons(c, totals));
    std::ostringstream report;
    program::write_report(report, c.shapes, program::Run());
    CHECK_AT(Json::parse(report.str()).at("counts").at("shapes") == c.shapes.number_of_shapes(), c.name);
    check_vg(c);
    check_vg({c.name + ", by plane", c.points, program::joined_shapes(c.points, c.shapes)});
  } catch(const std::exception& e) {
    CHECK_AT(false, c.name + ": " + e.what());
  }
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECK_OUTPUTS_H
