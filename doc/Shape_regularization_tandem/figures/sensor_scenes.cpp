// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes what six kinds of sensors see, as FOLDER/*.ply, without normals; the sensor is at the origin. draw.py draws what is
// found in them, for the page "Sensors".
//   sensor_scenes FOLDER

#include "clouds/ply_cloud.h"
#include "scenes/sensor.h"

#include <iostream>

using namespace CGAL::Tandem::scenes;

namespace {

constexpr double turn = 6.283185307179586, degree = turn / 360;

// Of what is less than `reach` away.
void write(const std::string& path, const Scene& scene, const Vec& sensor, double reach = 1000)
{
  CGAL::Tandem::benchmark::Ply_cloud cloud;
  for(const Vec& p : scene.points)
    if(length(p - sensor) < reach)
      cloud.points.push_back(p - sensor);
  write_ply(path + ".ply", cloud);
}

void write_street(const std::string& folder, const Model& village)
{
  Model street = village;
  const Vec car = village.scanners.front();
  for(double x : {-6., 6.}) // poles
    street.curved.push_back({Frame().at(car + Vec{x, 4, -2}), .1, 6, false});
  write(folder + "lidar", scan(street, {Sensor_kind::lidar, Frame().at(car), 1800, 32, turn, .7, -.44, .02}), car, 25);
}

void write_office(const std::string& folder, const Model& office)
{
  const Frame room = Frame().turned({0, 0, 1}, .17);
  const Frame rail = room.at({1.6, .4, 1.4}).turned({0, 1, 0}, -.17);
  write(folder + "profiles", scan(office, {Sensor_kind::profiler, rail, 750, 70, 3, 4.2, 0, .001}), rail.origin);

  const Vec corner = room.point({.4, .4, 1.7});
  const Vec z = unit(room.point({4, 3.2, .8}) - corner), x = unit(cross(z, {0, 0, 1}));
  const Frame camera = {corner, x, cross(z, x), z};
  write(folder + "depth", scan(office, {Sensor_kind::camera, camera, 320, 240, 1.1086, .8284, 0, .005}), corner);

  // Two stations, the second one 5 mm off on each axis.
  const Frame first = room.at({2.7, 2.2, 1.6}), second = room.at({4.4, 1.9, 1.6});
  const auto station = [&](const Frame& pose) {
    return scan(office, {Sensor_kind::scanner, pose, 400, 250, turn, 140 * degree, -60 * degree, .002});
  };
  Scene both = station(first);
  for(const Vec& p : station(second).points)
    both.points.push_back(p + Vec{.005, .005, .005});
  write(folder + "terrestrial", both, first.origin);
}

} // namespace

int main(int argc, char** argv)
try {
  if(argc != 2) {
    std::cerr << "usage: sensor_scenes FOLDER\n";
    return 2;
  }
  const std::string folder = argv[1] + std::string("/");
  const Model village = make_village();
  write_street(folder, village);
  write_office(folder, make_office());
  const Vec high = {-12, -12, 100};
  write(folder + "aerial", scan(village, {Sensor_kind::aerial, Frame().at(high), 170, 170, 60, 60, 0, .03}), high);
  write(folder + "images", make_scene("house", {100000, .002, .2, false, Normals::none}), {0, 0, 0});
  return 0;
} catch(const std::exception& e) {
  std::cerr << "sensor_scenes: " << e.what() << "\n";
  return 1;
}
