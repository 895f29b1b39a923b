// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The generated scenes have the same bits everywhere, so that they stay what they were found
// to be; points on their faces, and known numbers of directions and planes.

#include "testing/checks.h"

#include "scenes/labeled_scenes.h"
#include "scenes/sensor.h"
#include "testing/plane_relations.h"

#include <boost/test/unit_test.hpp>

#include <cstring>
#include <map>
#include <utility>

// Not `scenes`, which is a namespace here.
BOOST_AUTO_TEST_SUITE(test_scenes)

namespace scenes = CGAL::Tandem::scenes;
using CGAL::Tandem::benchmark::Plane_relations;
using scenes::Options;
using scenes::Scene;
using scenes::Vec;

std::uint64_t hash(const Scene& scene)
{
  std::uint64_t h = 0xcbf29ce484222325u;
  const auto add = [&](double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    h = (h ^ bits) * 0x100000001b3u;
  };
  const auto add_vector = [&](const Vec& v) {
    for(double c : {v.x, v.y, v.z})
      add(c);
  };
  for(std::size_t i = 0; i < scene.points.size(); ++i) {
    add_vector(scene.points[i]);
    if(scene.normals.empty())
      continue;
    add(double(scene.label[i]));
    add_vector(scene.normals[i]);
    add(double(scene.label[i]));
  }
  return h;
}

// Of the true faces.
Plane_relations relations(const Scene& scene)
{
  std::vector<CGAL::Tandem::benchmark::Plane> planes;
  for(const scenes::Truth_face& f : scene.faces)
    planes.push_back({f.normal, f.offset});
  return Plane_relations(planes, scene.diagonal, {0, 0, 0});
}

double face_distance(const Scene& scene, std::size_t i, const Vec& p)
{
  const scenes::Truth_face& f = scene.faces[std::size_t(scene.label[i])];
  return std::abs(dot(f.normal, p) + f.offset);
}

// The truth of a bent face is its mean plane.
BOOST_AUTO_TEST_CASE(clean_points_lie_on_their_faces)
{
  for(const std::string& name : scenes::scene_names()) {
    const scenes::Model model = scenes::make_model(name);
    const Scene scene = scenes::make_scene(model, {5000});
    for(std::size_t i = 0; i < scene.points.size(); ++i) {
      const std::int32_t f = scene.label[i];
      const Vec &p = scene.points[i], &n = scene.normals[i];
      const std::string where = name + ": point " + std::to_string(i);
      BOOST_REQUIRE_MESSAGE(f < std::int32_t(scene.faces.size()) && std::abs(length(n) - 1) < 1e-12, where);
      if(f < 0)
        continue;
      const scenes::Face& face = model.faces[std::size_t(f)];
      const double d = dot(face.normal, p) + face.offset;
      BOOST_REQUIRE_MESSAGE(std::abs(d - face.bend.height(p)) < 1e-11 * scene.diagonal, where);
      BOOST_REQUIRE_MESSAGE(!model.is_hidden(p, 1e-6) && dot(n, face.normal) > .9, where);
    }
  }
}

BOOST_AUTO_TEST_CASE(directions_and_planes_are_as_counted_by_hand)
{
  // Faces, directions, planes, and degrees of freedom: two of the vertical, and one for each frame around it.
  const std::map<std::string, std::array<std::size_t, 4>> expected = {{"cube", {6, 3, 6, 3}},
                                                                      {"tilted_cube", {6, 6, 6, 12}},
                                                                      {"staircase", {16, 2, 16, 3}},
                                                                      {"squares_gap", {2, 1, 1, 2}},
                                                                      {"squares_touching", {1, 1, 1, 2}},
                                                                      {"slope", {3, 2, 2, 4}},
                                                                      {"chained", {3, 3, 3, 6}},
                                                                      {"two_followers", {3, 3, 3, 4}},
                                                                      {"offset_pair", {2, 1, 2, 2}},
                                                                      {"sphere", {0, 0, 0, 0}},
                                                                      {"noise", {0, 0, 0, 0}}};
  for(const auto& [name, numbers] : expected) {
    const Scene scene = scenes::make_scene(name, {100});
    const Plane_relations r = relations(scene);
    const std::size_t found[] = {scene.faces.size(), r.directions(), r.planes(), r.degrees_of_freedom()};
    BOOST_TEST(std::equal(numbers.begin(), numbers.end(), found), name);
  }
  // Two for the vertical, one for the walls of each house, and one for each side of a roof.
  const Plane_relations village = relations(scenes::make_scene("village", {100}));
  BOOST_TEST(village.directions() == 65u);
  BOOST_TEST(village.degrees_of_freedom() == 50u);
  BOOST_TEST(village.complexity() * double(3 * village.shapes()) == double(50 + village.planes()),
             boost::test_tools::tolerance(1e-12));
}

// Faces, and the least and the largest height above the first one.
BOOST_AUTO_TEST_CASE(walls_bend_and_have_steps_of_the_given_height)
{
  struct Wall {
    const char* kind;
    std::size_t faces;
    double lowest, highest;
  };
  const Wall walls[] = {{"bend", 1, -1, 1},          {"bow", 1, -4. / 3, 2. / 3}, {"offset", 1, -.5, .5},
                        {"half-offset", 1, -.5, .5}, {"halves", 2, 0, 1},         {"inset", 2, 0, 1},
                        {"strip", 2, 0, 1},          {"stairs", 3, 0, 2},         {"boards", 4, 0, 1},
                        {"strips", 5, 0, 1}};
  const double height = .02;
  for(const Wall& wall : walls)
    BOOST_TEST_CONTEXT(wall.kind)
    {
      const scenes::Model model =
        scenes::make_wall(wall.kind, height, scenes::Frame().at({1, 2, 3}).turned({1, 2, 3}, .4));
      const Scene scene = scenes::make_scene(model, {5000});
      BOOST_TEST(scene.faces.size() == wall.faces);
      BOOST_TEST(model.solids.size() == (wall.faces == 1 ? 0 : wall.faces));
      double lowest = 9, highest = -9;
      for(std::size_t i = 0; i < scene.points.size(); ++i) {
        const Vec& p = scene.points[i];
        const double h = (dot(scene.faces[0].normal, p) + scene.faces[0].offset) / height;
        lowest = (std::min)(lowest, h);
        highest = (std::max)(highest, h);
        BOOST_REQUIRE(!model.is_hidden(p, 1e-6));
        BOOST_REQUIRE((wall.faces == 1 || face_distance(scene, i, p) < 1e-12));
      }
      BOOST_TEST(std::abs(lowest - wall.lowest) < .01);
      BOOST_TEST(std::abs(highest - wall.highest) < .01);
    }
}

BOOST_AUTO_TEST_CASE(what_is_around_a_wall_has_no_label)
{
  std::string group;
  for(const scenes::Labeled_scene& wall : scenes::labeled_walls())
    if(std::exchange(group, wall.group) != wall.group) {
      const Scene scene = wall.make();
      const auto free = std::count(scene.label.begin(), scene.label.end(), -1);
      BOOST_TEST((free > 10000 && free < 30000), wall.name);
      BOOST_TEST(*std::max_element(scene.label.begin(), scene.label.end()) + 1 == std::int32_t(scene.faces.size()));
    }
}

// The same for all compilers and flags.
BOOST_AUTO_TEST_CASE(same_seed_same_bits)
{
  Options o = {5000, 0.002, 0.2, true, scenes::Normals::perturbed};
  const std::map<std::string, std::uint64_t> expected = {
    {"house", 6212014825797636720u},         {"curved", 13178095787276836678u},
    {"village", 4889894781406829352u},       {"indoor", 14131617969777476776u},
    {"part", 3254076670455321759u},          {"cube", 9490769805443325746u},
    {"tilted_cube", 17567284440396245269u},  {"staircase", 17659844742620580906u},
    {"squares_gap", 7058461299616445296u},   {"squares_touching", 15525272810852997229u},
    {"slope", 6983050685735606232u},         {"chained", 8579465196824400408u},
    {"two_followers", 6038536455248018179u}, {"offset_pair", 15817291419831088417u},
    {"sphere", 13020534582438300035u},       {"noise", 9465220665368488763u},
    {"bent_hall", 17372442077763981334u},    {"bent_road", 3741397832191319576u}};
  for(const std::string& name : scenes::scene_names()) {
    const std::uint64_t h = hash(scenes::make_scene(name, o));
    BOOST_TEST(h == expected.at(name), name << ": " << h);
  }
  o.seed = 2;
  BOOST_TEST(hash(scenes::make_scene("house", o)) != expected.at("house"));
  o.normals = scenes::Normals::none;
  BOOST_TEST(scenes::make_scene("cube", o).normals.empty());
  BOOST_CHECK_THROW(scenes::make_scene("castle", o), std::invalid_argument);
}

// A camera looks at a wall, before whose middle a board stands that divides it.
BOOST_AUTO_TEST_CASE(a_sensor_labels_connected_pieces)
{
  scenes::Model model;
  model.add_rectangle(scenes::Frame().at({-2, -2, 4}), 4, 4);
  model.add_rectangle(scenes::Frame().at({-.25, -2, 2}), .5, 4);
  scenes::Sensor camera = {scenes::Sensor_kind::camera, {}, 40, 40, 1, 1};
  const scenes::Scene scene = scenes::scan(model, camera);
  BOOST_TEST(scene.points.size() == 1600u);
  BOOST_TEST(scene.faces.size() == 3u);
  for(std::size_t i = 0; i < scene.points.size(); ++i)
    BOOST_TEST(face_distance(scene, i, scene.points[i]) < 1e-9);
  camera.noise = .01;
  BOOST_TEST(scenes::scan(model, camera).label == scene.label);
}

BOOST_AUTO_TEST_SUITE_END()
