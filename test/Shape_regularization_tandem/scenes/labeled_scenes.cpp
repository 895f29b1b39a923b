// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "labeled_scenes.h"
#include "sensor.h"

namespace CGAL::Tandem::scenes {

namespace {

constexpr double cosine_9 = 25.841932763167124, cosine_8 = 36.86989764584402; // degrees

// Rotating, on its tripod: all around, from 60 degrees below to 80 degrees above the horizon.
Sensor scanner(const Vec& position, unsigned columns, unsigned rows)
{
  Frame pose;
  pose.origin = position;
  return {Sensor_kind::scanner, pose, columns, rows, 6.283185307179586, 2.443460952792061, -1.0471975511965976};
}

// A depth camera of 58 by 45 degrees.
Sensor camera(const Vec& position, const Vec& target)
{
  Frame pose;
  pose.origin = position;
  pose.z = unit(target - position);
  pose.x = unit(cross(pose.z, {0, 0, 1}));
  pose.y = cross(pose.z, pose.x);
  return {Sensor_kind::camera, pose, 320, 240, 1.1086, 0.8284};
}

// What a user would choose for noise of so many millimetres.
struct Noise {
  int millimetres;
  double scanner_epsilon, camera_epsilon, alpha_deg;
};
constexpr Noise noises[] = {{0, 0.015, 0.02, cosine_9}, {5, 0.02, 0.025, cosine_9}, {10, 0.035, 0.045, cosine_8}};

std::string in_name(const Noise& noise) { return "-" + std::to_string(noise.millimetres) + "mm"; }

struct Room {
  std::string name;
  Model (*make)();
};

Labeled_scene scanned_room(const std::string& group, const Room& room, unsigned columns, const Noise& noise)
{
  const unsigned rows = columns == 100 ? 100 : columns * 5 / 8;
  const auto make = [=] {
    const Model model = room.make();
    Sensor sensor = scanner(model.scanners.front(), columns, rows);
    sensor.noise = 1e-3 * noise.millimetres;
    return scan(model, sensor);
  };
  const std::string name = room.name + "-" + std::to_string(columns) + in_name(noise);
  return {group, name, make, noise.scanner_epsilon, noise.alpha_deg, columns == 100 ? 40u : 150u};
}

struct View {
  std::string name;
  Vec position, target; // in the frame of the office
};
const View corner = {"corner", {0.4, 0.4, 1.7}, {4, 3.2, 0.8}}, shelves = {"shelves", {3.2, 0.9, 1.5}, {2.2, 4.5, 0.9}};

const Frame office_frame = Frame().turned({0, 0, 1}, 0.17);

Labeled_scene depth_image(const View& view, const Noise& noise)
{
  const auto make = [=] {
    Sensor sensor = camera(office_frame.point(view.position), office_frame.point(view.target));
    sensor.noise = 1e-3 * noise.millimetres;
    return scan(make_office(), sensor);
  };
  return {"camera", "camera-" + view.name + in_name(noise), make, noise.camera_epsilon, noise.alpha_deg, 150};
}

// About 28, 9 and 3 points a square metre.
Labeled_scene roof(const std::string& kind, unsigned points)
{
  const auto make = [=] {
    Frame pose = Frame().turned({0, 0, 1}, 0.17).at({-2, -5, 30});
    const double width = 18, depth = 17;
    const double pixels = std::sqrt(points * width * depth / 108.);
    const unsigned columns = unsigned(pixels * std::sqrt(width / depth)),
                   rows = unsigned(pixels * std::sqrt(depth / width));
    Sensor sensor = {Sensor_kind::aerial, pose, columns, rows, width, depth};
    sensor.noise = 0.03;
    return scan(make_roof(kind), sensor);
  };
  const std::size_t minimum = points >= 3000 ? 30 : points >= 1000 ? 15 : 10;
  const std::string group = points < 1000 ? "sparse roofs" : "roofs";
  return {group, "roof-" + kind + "-" + std::to_string(points), make, 0.15, cosine_9, minimum};
}

struct Scene_kind {
  std::string name, model;
  double noise, outliers, normal_noise_deg, epsilon, alpha_deg;
  bool varies_density;
};

// As in clouds.csv, with fewer points.
Labeled_scene scene(const Scene_kind& kind, std::size_t points, std::uint64_t seed)
{
  const auto make = [=] {
    Options o;
    o.points = points;
    o.noise = kind.noise;
    o.outliers = kind.outliers;
    o.varies_density = kind.varies_density;
    o.normals = Normals::none;
    o.seed = seed;
    return make_scene(kind.model, o);
  };
  const std::string name = kind.name + "-" + std::to_string(seed);
  return {kind.name, name, make, kind.epsilon, kind.alpha_deg, points / 1000, kind.normal_noise_deg, seed};
}

struct Layers {
  std::string name;
  Model (*make)(double gap);
  double gap; // in epsilons
};

// With noise of a third of epsilon, and normals that lean by about 5 degrees.
Labeled_scene layers(const Layers& kind, std::uint64_t seed)
{
  const double epsilon = 0.02;
  const auto make = [=] {
    const Model model = kind.make(kind.gap * epsilon);
    Options o;
    o.points = 1;
    o.noise = epsilon / 3 / make_scene(model, o).diagonal;
    o.points = 40000;
    o.normals = Normals::none;
    o.seed = seed;
    return make_scene(model, o);
  };
  return {kind.name, kind.name + "-" + std::to_string(seed), make, epsilon, cosine_9, 100, 5, seed};
}

} // namespace

std::vector<Labeled_scene> labeled_frames()
{
  const Room office = {"office", make_office}, tilted = {"tilted", make_tilted_room};
  std::vector<Labeled_scene> list = {scanned_room("small room", office, 100, noises[0]),
                                     scanned_room("small room", tilted, 100, noises[0])};
  for(const Noise& noise : noises)
    list.push_back(scanned_room("room", office, 400, noise));
  for(const Noise& noise : noises)
    list.push_back(scanned_room("tilted room", tilted, 400, noise));
  for(const View& view : {corner, shelves})
    for(const Noise& noise : noises)
      list.push_back(depth_image(view, noise));
  for(unsigned points : {3000u, 1000u, 300u})
    for(const std::string& kind : roof_kinds())
      list.push_back(roof(kind, points));
  return list;
}

std::vector<Labeled_scene> labeled_scenes(std::size_t points)
{
  std::vector<Labeled_scene> list;
  const Scene_kind kinds[] = {{"house", "house", 0, 0, 0, 0.04, cosine_9, false},
                              {"part", "part", 0.0003, 0, 3, 0.02, cosine_9, false},
                              {"indoor", "indoor", 0.0002, 0.02, 4, 0.015, cosine_9, true},
                              {"city", "village", 0.0003, 0.05, 4, 0.12, cosine_9, false}};
  for(const Scene_kind& kind : kinds)
    list.push_back(scene(kind, points, 1));
  for(std::uint64_t seed = 1; seed <= 5; ++seed)
    list.push_back(scene({"noisy house", "house", 0.002, 0.2, 8, 0.2, cosine_8, false}, points, seed));
  return list;
}

std::vector<Labeled_scene> labeled_layers()
{
  std::vector<Labeled_scene> list;
  const Layers kinds[] = {{"strips-1.1", make_strips, 1.1},
                          {"strips-1.3", make_strips, 1.3},
                          {"boards-1.1", make_boards, 1.1},
                          {"boards-1.3", make_boards, 1.3}};
  for(const Layers& kind : kinds)
    for(std::uint64_t seed = 1; seed <= 3; ++seed)
      list.push_back(layers(kind, seed));
  return list;
}

} // namespace CGAL::Tandem::scenes
