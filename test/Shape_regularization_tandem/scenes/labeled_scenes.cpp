// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "labeled_scenes.h"
#include "sensor.h"

namespace CGAL::Tandem::scenes {

namespace {

constexpr double cosine_9 = 25.841932763167124, cosine_8 = 36.86989764584402; // degrees

// What a user would choose for noise of so many millimetres.
struct Noise {
  int millimetres;
  double scanner_epsilon, camera_epsilon, alpha_deg;
};
constexpr Noise noises[] = {{0, 0.015, 0.02, cosine_9}, {5, 0.02, 0.025, cosine_9}, {10, 0.035, 0.045, cosine_8}};

std::string in_name(const Noise& noise) { return "-" + std::to_string(noise.millimetres) + "mm"; }

// By a scanner that rotates on its tripod: all around, from 60 degrees below to 80 degrees above the horizon.
Labeled_scene scanned_room(const std::string& group, const std::string& name, Model (*make_room)(), unsigned columns,
                           const Noise& noise)
{
  const auto make = [=] {
    const Model model = make_room();
    return scan(model, {Sensor_kind::scanner, Frame().at(model.scanners.front()), columns,
                        columns == 100 ? 100 : columns * 5 / 8, 6.283185307179586, 2.443460952792061,
                        -1.0471975511965976, 1e-3 * noise.millimetres});
  };
  return {group,
          name + "-" + std::to_string(columns) + in_name(noise),
          make,
          noise.scanner_epsilon,
          noise.alpha_deg,
          columns == 100 ? 40u : 150u};
}

// By a depth camera of 58 by 45 degrees; places are in the frame of the office.
Labeled_scene depth_image(const std::string& view, const Vec& position, const Vec& target, const Noise& noise)
{
  const auto make = [=] {
    const Frame office = Frame().turned({0, 0, 1}, 0.17);
    const Vec origin = office.point(position), z = unit(office.point(target) - origin), x = unit(cross(z, {0, 0, 1}));
    const Frame pose = {origin, x, cross(z, x), z};
    return scan(make_office(), {Sensor_kind::camera, pose, 320, 240, 1.1086, 0.8284, 0, 1e-3 * noise.millimetres});
  };
  return {"camera", "camera-" + view + in_name(noise), make, noise.camera_epsilon, noise.alpha_deg, 150};
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
    return scan(make_roof(kind), {Sensor_kind::aerial, pose, columns, rows, width, depth, 0, 0.03});
  };
  const std::size_t minimum = points >= 3000 ? 30 : points >= 1000 ? 15 : 10;
  const std::string group = points < 1000 ? "sparse roofs" : "roofs";
  return {group, "roof-" + kind + "-" + std::to_string(points), make, 0.15, cosine_9, minimum};
}

// By a lidar of 30 degrees in height, 1800 points a turn, with a noise in metres.
Labeled_scene lidar_frame(const std::string& place, unsigned beams, bool is_tilted, double noise, std::uint64_t seed)
{
  const auto make = [=] {
    const Model model = place == "room" ? make_office() : make_model("village");
    Frame pose = Frame().at(model.scanners.front());
    if(is_tilted)
      pose = pose.turned({0.6, 0.8, 0}, 0.22);
    return scan(model, {Sensor_kind::lidar, pose, 1800, beams, 6.283185307179586, 0.5235987755982988,
                        -0.2617993877991494, noise, seed});
  };
  const std::string name = "lidar-" + place + "-" + std::to_string(beams) + (is_tilted ? "-tilted" : "-level") + "-" +
                           std::to_string(int(1000 * noise + .5)) + "mm";
  return {"lidar " + place, name, make, 3 * noise, cosine_9, 50, 3, seed};
}

// Points .004 apart, on lines so many times as far.
Labeled_scene profiles(unsigned times)
{
  const auto make = [=] {
    const Frame office = Frame().turned({0, 0, 1}, 0.17);
    const Frame pose = office.at({1.6, 0.4, 1.4}).turned({0, 1, 0}, -0.17);
    return scan(make_office(), {Sensor_kind::profiler, pose, 750, unsigned(1050 / times), 3, 4.2, 0, 0.001, times});
  };
  return {"profiles", "profiles-" + std::to_string(times), make, 0.005, cosine_9, 50, 3, times};
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
    return make_scene(kind.model, {points, kind.noise, kind.outliers, kind.varies_density, Normals::none, 0, seed});
  };
  const std::string name = kind.name + "-" + std::to_string(seed);
  return {kind.name, name, make, kind.epsilon, kind.alpha_deg, points / 1000, kind.normal_noise_deg, seed};
}

// Walls of one group: of all kinds, heights and noises (in epsilons), each so many times.
struct Wall_set {
  std::string group;
  std::vector<std::string> kinds;
  std::vector<double> heights, noises;
  int times;
};
constexpr double third = 1. / 3;
const std::vector<std::string> steps = {"halves", "inset", "strip", "stairs"};
const Wall_set wall_sets[] = {{"bends", {"bend"}, {.2, .4, .6}, {.1, .2, third}, 1},
                              {"bows", {"bow"}, {.2, .4, .6}, {.1, .2, third}, 1},
                              {"offsets", {"offset"}, {.3, .6, .9}, {.1, .2, third}, 1},
                              {"half offsets", {"half-offset"}, {.3, .6, .9}, {.1, .2, third}, 1},
                              {"low steps", steps, {.8, 1}, {.1, .2, third}, 1},
                              {"steps", steps, {1.1, 1.3}, {.1, .2, third}, 1},
                              {"boards", {"boards"}, {1.1, 1.3}, {.2, third}, 6},
                              {"strips", {"strips"}, {1.1, 1.3}, {.2, third}, 6}};

// Turned anyhow, with normals that lean by about 5 degrees. What is around the wall has no labels.
Labeled_scene wall(const std::string& group, const std::string& kind, double height, double noise, std::uint64_t seed)
{
  const double epsilon = 0.02;
  const auto make = [=] {
    Random random(seed);
    const Place place = Place(random.bits() % 3);
    const Vec axis = random.direction();
    const Frame frame = Frame().turned(axis, random.uniform());
    Model model = make_wall(kind, height * epsilon, frame);
    const std::size_t faces = model.faces.size();
    add_place(model, place, frame);
    const double sigma = noise * epsilon / make_scene(model, {1}).diagonal;
    Scene scene = make_scene(model, {50000, sigma, 0, false, Normals::none, 0, seed});
    scene.faces.resize(faces);
    for(std::int32_t& label : scene.label)
      label = label < std::int32_t(faces) ? label : -1;
    return scene;
  };
  const auto percent = [](double value) { return "-" + std::to_string(int(100 * value + .5)); };
  const std::string name = kind + percent(height) + percent(noise) + "-" + std::to_string(seed);
  return {group, name, make, epsilon, cosine_9, 100, 5, seed};
}

} // namespace

std::vector<Labeled_scene> labeled_frames()
{
  std::vector<Labeled_scene> list = {scanned_room("small room", "office", make_office, 100, noises[0]),
                                     scanned_room("small room", "tilted", make_tilted_room, 100, noises[0])};
  for(const Noise& noise : noises)
    list.push_back(scanned_room("room", "office", make_office, 400, noise));
  for(const Noise& noise : noises)
    list.push_back(scanned_room("tilted room", "tilted", make_tilted_room, 400, noise));
  for(const Noise& noise : noises)
    list.push_back(depth_image("corner", {0.4, 0.4, 1.7}, {4, 3.2, 0.8}, noise));
  for(const Noise& noise : noises)
    list.push_back(depth_image("shelves", {3.2, 0.9, 1.5}, {2.2, 4.5, 0.9}, noise));
  for(unsigned points : {3000u, 1000u, 300u})
    for(const char* kind : {"gable", "low", "hip", "dormers", "wing", "mansard", "hall", "villa"})
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

std::vector<Labeled_scene> labeled_scan_lines()
{
  std::vector<Labeled_scene> list;
  for(const char* place : {"room", "street"})
    for(unsigned beams : {16u, 32u, 64u, 128u})
      for(bool is_tilted : {false, true})
        list.push_back(lidar_frame(place, beams, is_tilted, 0.01 * double(1 + list.size() % 3), 801 + list.size()));
  for(unsigned times : {5u, 15u, 50u})
    list.push_back(profiles(times));
  return list;
}

std::vector<Labeled_scene> labeled_walls()
{
  std::vector<Labeled_scene> list;
  for(const Wall_set& set : wall_sets)
    for(const std::string& kind : set.kinds)
      for(double height : set.heights)
        for(double noise : set.noises)
          for(int i = 0; i < set.times; ++i)
            list.push_back(wall(set.group, kind, height, noise, 701 + list.size()));
  return list;
}

} // namespace CGAL::Tandem::scenes
