// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The generated scenes, and twins of real clouds, are what they claim to be: points on their faces, known numbers of
// directions and planes, no two labels for one connected plane, errors of the declared size, the same bits everywhere.

#include "testing/checks.h"

#include "scenes/scene_twins.h"
#include "scenes/sensor.h"
#include "testing/plane_relations.h"

#include <boost/test/unit_test.hpp>

#include <cstring>
#include <map>
#include <set>

// Not `scenes`, which is a namespace here.
BOOST_AUTO_TEST_SUITE(test_scenes)

namespace scenes = CGAL::Tandem::scenes;
using CGAL::Tandem::benchmark::Plane_relations;
using scenes::Options;
using scenes::Scene;
using scenes::Twin;
using scenes::Vec;

Options options(std::size_t points)
{
  Options o;
  o.points = points;
  return o;
}

std::uint64_t hash(const Scene& scene)
{
  std::uint64_t h = 0xcbf29ce484222325u;
  const auto add = [&](double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    h = (h ^ bits) * 0x100000001b3u;
  };
  const bool has_normals = !scene.normals.empty(); // or else of the points only
  for(std::size_t i = 0; i < scene.points.size(); ++i)
    for(const Vec& v : {scene.points[i], has_normals ? scene.normals[i] : Vec()}) {
      for(double c : {v.x, v.y, v.z})
        add(c);
      if(!has_normals)
        break;
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
  return Plane_relations(planes, CGAL::Tandem::benchmark::relaxed_relations(scene.diagonal, {0, 0, 0}));
}

// All faces have points, but for `unseen` of them. Coplanar ones share no voxel: else they would be one shape with two
// labels, and the truth would be wrong.
void check_faces(const std::string& name, const Scene& scene, const std::vector<Vec>& points, std::ptrdiff_t unseen = 0)
{
  using Voxels = std::set<std::array<long, 3>>;
  const Plane_relations r = relations(scene);
  const double size = 6e-4 * scene.diagonal;
  std::vector<Voxels> voxels(scene.faces.size());
  for(std::size_t i = 0; i < points.size(); ++i)
    if(scene.label[i] >= 0) {
      const Vec p = (1 / size) * points[i];
      voxels[std::size_t(scene.label[i])].insert({std::lround(p.x), std::lround(p.y), std::lround(p.z)});
    }
  const auto is_empty = [](const Voxels& of_face) { return of_face.empty(); };
  BOOST_TEST(std::count_if(voxels.begin(), voxels.end(), is_empty) <= unseen, name << ": faces have no point");
  for(std::size_t f = 0; f < voxels.size(); ++f)
    for(std::size_t g = 0; g < f; ++g) {
      const auto is_shared = [&](const auto& v) { return voxels[g].count(v) > 0; };
      BOOST_REQUIRE_MESSAGE(!r.are_coplanar(f, g) || std::none_of(voxels[f].begin(), voxels[f].end(), is_shared),
                            name << ": faces " << f << " and " << g << " touch");
    }
}

double face_distance(const Scene& scene, std::size_t i, const Vec& p)
{
  const scenes::Truth_face& f = scene.faces[std::size_t(scene.label[i])];
  return std::abs(dot(f.normal, p) + f.offset);
}

// The truth of a bent face is its mean plane. Normals are those of the surface: two points one step apart along the bend
// lie on a line orthogonal to the normal between them.
BOOST_AUTO_TEST_CASE(clean_points_lie_on_their_faces)
{
  for(const std::string& name : scenes::scene_names()) {
    const scenes::Model model = name == "noise" ? scenes::Model() : scenes::make_model(name);
    const Scene scene =
      name == "noise" ? scenes::make_scene(name, options(20000)) : scenes::make_scene(model, options(20000));
    BOOST_REQUIRE_EQUAL(scene.points.size(), 20000u);
    std::map<double, std::pair<double, double>> bent; // by sag: number of points and sum of heights
    for(std::size_t i = 0; i < scene.points.size(); ++i) {
      const std::int32_t f = scene.label[i];
      const std::string where = name + ": point " + std::to_string(i);
      BOOST_REQUIRE_MESSAGE(f >= -1 && f < std::int32_t(scene.faces.size()), where);
      BOOST_REQUIRE_MESSAGE(std::abs(length(scene.normals[i]) - 1) < 1e-12, where);
      if(f < 0)
        continue;
      const Vec& p = scene.points[i];
      const scenes::Face& face = model.faces[std::size_t(f)];
      const double d = dot(face.normal, p) + face.offset, height = face.bend.height(p), step = 1e-4;
      BOOST_REQUIRE_MESSAGE(std::abs(d - height) < 1e-11 * scene.diagonal, where);
      BOOST_REQUIRE_MESSAGE(!model.is_hidden(p, 1e-6), where);
      const double rise =
        face.bend.height(add_scaled(p, step, face.bend.axis)) - face.bend.height(add_scaled(p, -step, face.bend.axis));
      const Vec along = add_scaled(2 * step * face.bend.axis, rise, face.normal);
      BOOST_REQUIRE_MESSAGE(std::abs(dot(scene.normals[i], along)) < 1e-9 * step, where);
      BOOST_REQUIRE_MESSAGE(dot(scene.normals[i], face.normal) > .9, where);
      ++bent[face.bend.sag].first;
      bent[face.bend.sag].second += height;
    }
    for(const auto& [sag, sum] : bent)
      BOOST_TEST(std::abs(sum.second) <= .05 * std::abs(sag) * sum.first, name << ": sag " << sag);
  }
}

BOOST_AUTO_TEST_CASE(directions_and_planes_are_as_counted_by_hand)
{
  struct Expected {
    const char* name;
    std::size_t faces, directions, planes, degrees_of_freedom;
  };
  // The vertical has two degrees of freedom, and one for each frame around it.
  const Expected expected[] = {{"cube", 6, 3, 6, 3},
                               {"tilted_cube", 6, 6, 6, 12},
                               {"staircase", 16, 2, 16, 3},
                               {"squares_gap", 2, 1, 1, 2},
                               {"squares_touching", 1, 1, 1, 2},
                               {"slope", 3, 2, 2, 4},
                               {"chained", 3, 3, 3, 6},
                               {"two_followers", 3, 3, 3, 4},
                               {"offset_pair", 2, 1, 2, 2},
                               {"sphere", 0, 0, 0, 0},
                               {"noise", 0, 0, 0, 0}};
  for(const Expected& e : expected) {
    const Scene scene = scenes::make_scene(e.name, options(100));
    const Plane_relations r = relations(scene);
    BOOST_TEST_CONTEXT(e.name)
    {
      BOOST_TEST(scene.faces.size() == e.faces);
      BOOST_TEST(r.directions() == e.directions);
      BOOST_TEST(r.planes() == e.planes);
      BOOST_TEST(r.degrees_of_freedom() == e.degrees_of_freedom);
    }
  }
  BOOST_TEST(relations(scenes::make_scene("village", options(100))).directions() == 65u);
}

BOOST_AUTO_TEST_CASE(faces_are_seen_and_apart)
{
  for(const char* name : {"house", "village", "indoor", "part", "squares_gap"}) {
    const Scene scene = scenes::make_scene(name, options(300000));
    check_faces(name, scene, scene.points);
  }
  for(const Twin& twin : scenes::twins()) {
    const Scene scene = scenes::make_twin(twin, 300000);
    // From a road, a few reveals of windows are not seen.
    check_faces(twin.name, scene, scene.ideal, twin.name == "street" ? 40 : 0);
  }
}

// The same for all compilers and flags.
BOOST_AUTO_TEST_CASE(same_seed_same_bits)
{
  Options o = options(5000);
  o.noise = 0.002;
  o.outliers = 0.2;
  o.varies_density = true;
  o.normals = scenes::Normals::perturbed;
  BOOST_TEST(hash(scenes::make_scene("house", o)) == 6212014825797636720u);
  o.seed = 2;
  BOOST_TEST(hash(scenes::make_scene("house", o)) != 6212014825797636720u);
  const std::map<std::string, std::uint64_t> expected = {
    {"terrestrial", 1029664864976318346u}, {"kinect", 13497633120438636856u},    {"street", 3048911798510605531u},
    {"aerial", 7601843585497981935u},      {"multiview", 13637846688728164120u}, {"mechanical", 13538663334630593238u},
    {"curved", 11421857331715693994u}};
  for(const Twin& twin : scenes::twins()) {
    BOOST_TEST(hash(scenes::make_twin(twin, 2000)) == expected.at(twin.name), twin.name);
    BOOST_TEST(hash(scenes::make_twin(twin, 2000, 2)) != expected.at(twin.name), twin.name);
  }
}

BOOST_AUTO_TEST_CASE(errors_and_densities_are_those_asked_for)
{
  Options o = options(50000);
  o.noise = 0.01;
  o.outliers = 0.2;
  o.normals = scenes::Normals::perturbed;
  o.normal_noise_deg = 3;
  const Scene scene = scenes::make_scene("cube", o);
  double squares = 0, tilts = 0, count = 0;
  for(std::size_t i = 0; i < scene.points.size(); ++i) {
    if(scene.label[i] < 0)
      continue;
    const double d = face_distance(scene, i, scene.points[i]);
    const double tilt = length(cross(scene.faces[std::size_t(scene.label[i])].normal, scene.normals[i]));
    squares += d * d;
    tilts += tilt * tilt / 2; // two axes
    ++count;
  }
  BOOST_TEST(1 - count / 50000 == 0.2, boost::test_tools::tolerance(0.05));
  BOOST_TEST(std::sqrt(squares / count) == 0.01 * std::sqrt(3.0), boost::test_tools::tolerance(0.03));
  BOOST_TEST(std::sqrt(tilts / count) * 57.29577951308232 == 3.0, boost::test_tools::tolerance(0.03));

  const scenes::Model model = scenes::make_model("indoor");
  double mean_distance[2] = {0, 0}; // from the nearest scanner
  for(const bool varies : {false, true}) {
    o = options(20000);
    o.varies_density = varies;
    for(const Vec& p : scenes::make_scene(model, o).points) {
      double nearest = 1e300;
      for(const Vec& s : model.scanners)
        nearest = (std::min)(nearest, length(p - s));
      mean_distance[varies] += nearest / 20000;
    }
  }
  BOOST_TEST(mean_distance[1] < 0.98 * mean_distance[0]);
  o.normals = scenes::Normals::none;
  BOOST_TEST(scenes::make_scene("cube", o).normals.empty());
  BOOST_TEST(scenes::make_scene("cube", options(0)).points.empty());
  BOOST_CHECK_THROW(scenes::make_scene("castle", o), std::invalid_argument);
  BOOST_CHECK_THROW(scenes::twin("castle"), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(twins_have_errors_of_their_sensor)
{
  for(const Twin& twin : scenes::twins()) {
    const Scene scene = scenes::make_twin(twin, 20000);
    BOOST_REQUIRE(scene.points.size() == 20000u && scene.normals.empty());
    BOOST_TEST(twin.minimum(1000) >= 20u);
    BOOST_TEST(twin.minimum(1000000) > twin.minimum(100000));
    double squares = 0, faces = 0, outside = 0;
    for(std::size_t i = 0; i < scene.points.size(); ++i) {
      if(scene.label[i] < 0)
        continue;
      BOOST_REQUIRE_MESSAGE(face_distance(scene, i, scene.ideal[i]) < 1e-10 * scene.diagonal, twin.name);
      const double d = face_distance(scene, i, scene.points[i]);
      squares += d * d;
      outside += d > twin.epsilon;
      ++faces;
    }
    const double rms = std::sqrt(squares / faces);
    BOOST_TEST_CONTEXT(twin.name << ": rms " << rms << " of epsilon " << twin.epsilon)
    {
      const bool is_exact = twin.sensor.range_noise == 0 && twin.sensor.roughness == 0;
      BOOST_TEST((is_exact ? rms < 1e-10 : rms > 0.03 * twin.epsilon));
      BOOST_TEST(rms < 0.6 * twin.epsilon);
      BOOST_TEST(outside < 0.1 * faces);
    }
  }
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
