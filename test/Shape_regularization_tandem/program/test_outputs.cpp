// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What detect_planes writes of random scenes, read back: polygons in all formats, the data of the page, vertex groups,
// the report and the mesh.
//   test_outputs SEED        repeats one scene
//   test_outputs SEED COUNT  as many scenes, from SEED on

#undef NDEBUG

#include "testing/property_case.h"
#include "testing/test_support.h"

#include "program/Polygon_checker.h"
#include "program/check_surface.h"

#include "output/write_polygons.h"
#include "output/write_vg.h"
#include "view/write_view.h"

#include <map>

using program::Point_set;

struct Totals {
  std::size_t scenes = 0, shapes = 0, with_polygons = 0, polygons = 0, points = 0, inside = 0, meshes = 0;
};

struct Output_case {
  std::string name;
  Point_set points;
  program::Shapes shapes;
};

std::string text_of_polygons(const Output_case& c, const std::string& path, bool is_triangulated)
{
  std::ostringstream out;
  program::write_polygons(out, c.points, c.shapes, path, is_triangulated);
  return out.str();
}

void check_none(const Polygon_checker::Violations& violations, const Output_case& c, const std::string& what)
{
  CHECK_AT(violations.empty(), c.name + ", " + what + ": " + std::to_string(violations.size()) + " violations, " +
                                 (violations.empty() ? "" : violations.front()));
}

// A polygon has points of its shape in it, and most points are in a polygon.
void check_points(const Output_case& c, std::size_t s, const Written_shape& shape, Totals& totals)
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

Written_shapes check_polygons(const Output_case& c, Totals& totals)
{
  const Written_shapes shapes = read_geojson(text_of_polygons(c, "a.geojson", false));
  CHECK_AT(shapes.size() == c.shapes.number_of_shapes(), c.name);
  for(std::size_t s = 0; s < shapes.size(); ++s) {
    check_none(Polygon_checker(c.shapes, s).violations(shapes[s]), c, "shape " + std::to_string(s));
    check_points(c, s, shapes[s], totals);
  }
  for(bool is_triangulated : {false, true})
    for(const std::string path : {"a.geojson", "a.ply", "a.obj"}) {
      if(path == "a.geojson" && !is_triangulated)
        continue;
      const std::string text = text_of_polygons(c, path, is_triangulated);
      const Written_shapes faces = path == "a.ply"   ? read_ply(text, shapes.size())
                                   : path == "a.obj" ? read_obj(text)
                                                     : read_geojson(text);
      CHECK_AT(faces.size() == shapes.size(), c.name + ' ' + path);
      for(std::size_t s = 0; s < faces.size(); ++s)
        check_none(Polygon_checker(c.shapes, s).violations_of_faces(faces[s], shapes[s].area), c, path);
    }
  return shapes;
}

// --- The other files

// The numbers that the page has of the shapes.
void check_view(const Output_case& c, const Written_shapes& polygons)
{
  program::Run run;
  std::ostringstream out;
  program::write_view(out, c.points, c.shapes, run);
  const std::string text = out.str(), begin = "id=\"scene\">";
  const std::size_t first = text.rfind(begin) + begin.size();
  const Json scene = parsed_json(text.substr(first, text.find("</script>", first) - first));
  CHECK_AT(scene.get<std::size_t>("assigned") == c.shapes.statistics().number_of_assigned_points, c.name);
  std::size_t s = 0;
  for(const auto& area : scene.get_child("shapes.area"))
    CHECK_AT(area_of(area.second.data()) == polygons.at(s++).area, c.name);
  CHECK_AT(s == polygons.size(), c.name);
  for(const char* name : {"coefficients", "centroid", "mean_distance", "turned_degrees", "shifted"})
    for(const auto& number : scene.get_child(std::string("shapes.") + name))
      number_of(number.second.data());
}

void check_report(const Output_case& c)
{
  std::ostringstream out;
  program::write_report(out, c.shapes, program::Run());
  CHECK_AT(parsed_json(out.str()).get<std::size_t>("counts.shapes") == c.shapes.number_of_shapes(), c.name);
}

// Numbers or words after a key, and each point in one group at most.
void check_vg(const Output_case& c, bool has_group_for_each_plane)
{
  std::stringstream file;
  program::write_vg(file, c.points, c.shapes, has_group_for_each_plane);
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
  CHECK_AT(sum["num_groups:"] ==
             (has_group_for_each_plane ? c.shapes.number_of_coplanar_groups() : c.shapes.number_of_shapes()),
           c.name);
}

// --- Scenes

Output_case case_of(const std::string& name, const Cloud& cloud, const Shapes& shapes)
{
  Output_case result = {name, {}, program::Shapes(shapes.data())};
  result.points.add_normal_map();
  for(const auto& [p, n] : cloud)
    result.points.insert(program::Kernel::Point_3(p.x(), p.y(), p.z()), program::Kernel::Vector_3(n.x(), n.y(), n.z()));
  return result;
}

void check_outputs(const Output_case& c, Totals& totals)
{
  ++totals.scenes;
  totals.shapes += c.shapes.number_of_shapes();
  try {
    check_view(c, check_polygons(c, totals));
    check_report(c);
    check_vg(c, false);
    check_vg(c, true);
    totals.meshes += check_mesh(c.points, c.shapes, c.name);
  } catch(const std::exception& e) {
    CHECK_AT(false, c.name + ": " + e.what());
  }
}

void check_scenes(std::uint64_t first, std::uint64_t count)
{
  Totals t;
  for(std::uint64_t seed = first; seed < first + count; ++seed) {
    const Property_case c = Case_maker(seed).make();
    if(count == 1)
      std::cout << c.name << std::endl;
    try {
      check_outputs(case_of(c.name, c.cloud, detect(c.cloud, c.parameters, c.given)), t);
    } catch(const std::range_error&) {
    } // too wide: test_properties
  }
  std::cout << t.scenes << " scenes, " << t.shapes << " shapes, " << t.with_polygons << " with " << t.polygons
            << " polygons, " << t.inside << " of their " << t.points << " points inside, " << t.meshes << " meshes"
            << std::endl;
  CHECK(count == 1 || double(t.inside) > .8 * double(t.points));
}

// --- Scenes of their own

// Lengths are multiplied by a power of two.
Output_case scaled(const Output_case& c, int exponent)
{
  Output_case result = {c.name + " times 2^" + std::to_string(exponent), c.points, program::Shapes()};
  const auto scale = [&](double& length) { length = std::ldexp(length, exponent); };
  for(Point_set::Index i : result.points) {
    auto& p = result.points.point(i);
    p = {std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent)};
  }
  Shapes::Data data = c.shapes.data();
  for(auto& coefficients : data.coefficients)
    scale(coefficients[3]);
  scale(data.parameters.maximum_distance);
  result.shapes = program::Shapes(data);
  return result;
}

// In units whose squares, and even areas, are no doubles, polygons are the same.
void check_units()
{
  const Cloud cloud = make_pairs<Kernel>(make_box_cloud(400));
  const Output_case box = case_of("box", cloud, detect(cloud, make_parameters(.02, 50)));
  CHECK(box.shapes.number_of_shapes() == 6);
  const Written_shapes expected = read_geojson(text_of_polygons(box, "a.geojson", false));
  for(int exponent : {-960, -520, 520, 1000}) {
    const Output_case c = scaled(box, exponent);
    const Written_shapes written = read_geojson(text_of_polygons(c, "a.geojson", false));
    for(std::size_t s = 0; s < expected.size(); ++s) {
      CHECK_AT(written[s].polygons.size() == 1 && expected[s].polygons.size() == 1, c.name);
      if(written[s].polygons.empty() || expected[s].polygons.empty())
        continue;
      Ring ring = expected[s].polygons[0].rings[0];
      for(Position& p : ring)
        for(double& x : p)
          x = std::ldexp(x, exponent);
      CHECK_AT(written[s].polygons[0].rings[0] == ring, c.name);
      CHECK_AT(written[s].area == std::ldexp(expected[s].area, 2 * exponent), c.name);
    }
    check_view(c, written);
    check_vg(c, false);
  }
}

// Too few points for an outline, and points on a line.
void check_without_outline()
{
  for(const std::size_t width : {3, 1}) {
    Cloud cloud;
    for(std::size_t i = 0; i < 9; ++i)
      cloud.emplace_back(Kernel::Point_3(double(i % width), double(i / width), 0), Kernel::Vector_3(0, 0, 1));
    Shapes::Data data = detect(cloud, make_parameters(.1, 3)).data();
    CGAL::Tandem::internal::Host_buffer<std::int32_t> shape_of(cloud.size());
    std::fill(shape_of.begin(), shape_of.end(), 0);
    data.shape_of = std::move(shape_of);
    data.coefficients = {{0, 0, 1, 0}};
    data.parallel_group = data.coplanar_group = {0};
    data.fixed_direction = data.symmetry_group = {-1};
    data.is_flipped = {0};
    data.statistics.number_of_assigned_points = cloud.size();
    data.statistics.number_of_shapes = data.statistics.number_of_directions = data.statistics.number_of_planes = 1;
    Totals totals;
    check_outputs(case_of("a few points", cloud, Shapes(data)), totals);
    CHECK(totals.shapes == 1 && totals.polygons == 0);
  }
}

int main(int argc, char** argv)
{
  const std::uint64_t seed = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
  const std::uint64_t count = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : argc > 1 ? 1 : 60;
  if(argc == 1) {
    check_units();
    check_without_outline();
  }
  check_scenes(seed, count);
  return report();
}
