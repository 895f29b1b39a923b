// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "sensor.h"

#include <limits>
#include <map>
#include <numeric>

namespace CGAL::Tandem::scenes {

namespace {

struct Ray {
  Vec origin, direction;
};

struct Hit {
  double distance = std::numeric_limits<double>::infinity(); // in units of the length of the direction
  std::int32_t label = -1;                                   // index of the face, -1 on curved patches
};

constexpr double nearest = 0.01; // since a ray that begins on a surface is not to meet it

// Both roots of the quadratic equation, the nearer one first.
void meet(const Curved& curved, const Ray& ray, Hit& hit)
{
  const Frame& f = curved.frame;
  const bool is_sphere = curved.height == 0;
  const auto local = [&](const Vec& v) { return Vec{dot(f.x, v), dot(f.y, v), dot(f.z, v)}; };
  const Vec o = local(ray.origin - f.origin), d = local(ray.direction);
  const Vec a = {o.x, o.y, is_sphere ? o.z : 0}, b = {d.x, d.y, is_sphere ? d.z : 0};
  const double square = dot(b, b), half = dot(a, b);
  const double root2 = half * half - square * (dot(a, a) - curved.radius * curved.radius);
  if(square == 0 || root2 < 0)
    return;
  for(const double root : {-std::sqrt(root2), std::sqrt(root2)}) {
    const double distance = (root - half) / square, z = o.z + distance * d.z;
    if(distance > nearest && distance < hit.distance && (is_sphere || (z >= 0 && z <= curved.height)))
      hit = {distance, -1};
  }
}

// Where a ray meets a model first. The same bits on every machine.
Hit first_hit(const Model& model, const Ray& ray)
{
  Hit hit;
  for(std::size_t f = 0; f < model.faces.size(); ++f) {
    const Face& face = model.faces[f];
    const double slope = dot(face.normal, ray.direction);
    const double distance = slope == 0 ? -1 : -(dot(face.normal, ray.origin) + face.offset) / slope;
    if(distance > nearest && distance < hit.distance &&
       model.is_on(face, add_scaled(ray.origin, distance, ray.direction), 1e-7))
      hit = {distance, std::int32_t(f)};
  }
  for(const Curved& curved : model.curved)
    meet(curved, ray, hit);
  return hit;
}

// Of a cosine, and of a sine less its factor, the angle. Within [-pi, pi], with the same bits on every machine, unlike
// those of a library.
double series(double angle, int last)
{
  double sum = 1;
  for(int i = last; i > 1; i -= 2)
    sum = std::fma(-(angle * angle) / (i * (i - 1)), sum, 1.);
  return sum;
}

double sine(double angle) { return angle * series(angle, 27); }
double cosine(double angle) { return series(angle, 26); }

// Of the pixel at the place (u, v) of [0, 1]^2.
Ray ray_of(const Sensor& sensor, double u, double v)
{
  const Frame& pose = sensor.pose;
  if(sensor.kind == Sensor_kind::aerial || sensor.kind == Sensor_kind::profiler)
    return {pose.point({u * sensor.width, v * sensor.height, 0}), -1. * pose.z};
  if(sensor.kind == Sensor_kind::camera)
    return {pose.origin, unit(pose.vector({(u - 0.5) * sensor.width, (v - 0.5) * sensor.height, 1}))};
  const double azimuth = (u - 0.5) * sensor.width, elevation = sensor.lowest + v * sensor.height;
  const double across = cosine(elevation);
  return {pose.origin, unit(pose.vector({across * cosine(azimuth), across * sine(azimuth), sine(elevation)}))};
}

double noise_of(const Sensor& sensor, double distance)
{
  if(sensor.kind != Sensor_kind::scanner && sensor.kind != Sensor_kind::camera)
    return sensor.noise;
  const double relative = distance / 3;
  return sensor.noise * (sensor.kind == Sensor_kind::camera ? relative * relative : relative);
}

// Numbers the connected pieces of faces, in the order of their first points: two points are connected if their pixels are
// at most two rows and columns apart. pixel: the index of its point, -1: none.
void split_faces(const Sensor& sensor, const std::vector<std::int32_t>& pixel, const Model& model, Scene& scene)
{
  std::vector<std::int32_t> parent(scene.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t i) {
    while(parent[std::size_t(i)] != i)
      i = parent[std::size_t(i)] = parent[std::size_t(parent[std::size_t(i)])];
    return i;
  };
  const int columns = int(sensor.columns), rows = int(sensor.rows);
  const bool turns = (sensor.kind == Sensor_kind::scanner || sensor.kind == Sensor_kind::lidar) && sensor.width > 6.28;
  for(int row = 0; row < rows; ++row)
    for(int column = 0; column < columns; ++column)
      for(int r = row; r <= (std::min)(row + 2, rows - 1); ++r)
        for(int c = column - 2; c <= column + 2; ++c) {
          const int wrapped = turns ? (c + columns) % columns : (std::min)((std::max)(c, 0), columns - 1);
          const std::int32_t i = pixel[std::size_t(row * columns + column)],
                             j = pixel[std::size_t(r * columns + wrapped)];
          if(i >= 0 && j >= 0 && scene.label[std::size_t(i)] == scene.label[std::size_t(j)])
            parent[std::size_t((std::max)(root(i), root(j)))] = (std::min)(root(i), root(j));
        }
  std::map<std::int32_t, std::int32_t> number;
  for(std::size_t i = 0; i < scene.label.size(); ++i) {
    if(scene.label[i] < 0)
      continue;
    const auto entry = number.emplace(root(std::int32_t(i)), std::int32_t(number.size()));
    if(entry.second)
      scene.faces.push_back(model.faces[std::size_t(scene.label[i])]);
    scene.label[i] = entry.first->second;
  }
}

} // namespace

Scene scan(const Model& model, const Sensor& sensor)
{
  Scene scene;
  std::vector<std::int32_t> pixel;
  Random random(sensor.seed);
  const bool is_aerial = sensor.kind == Sensor_kind::aerial;
  for(unsigned row = 0; row < sensor.rows; ++row)
    for(unsigned column = 0; column < sensor.columns; ++column) {
      const double u = is_aerial ? random.uniform() : 0.5, v = is_aerial ? random.uniform() : 0.5;
      const Ray ray = ray_of(sensor, (column + u) / sensor.columns, (row + v) / sensor.rows);
      const Hit hit = first_hit(model, ray);
      const double noise = noise_of(sensor, hit.distance) * random.gaussian();
      const bool is_hit = std::isfinite(hit.distance);
      pixel.push_back(is_hit ? std::int32_t(scene.points.size()) : -1);
      if(!is_hit)
        continue;
      scene.ideal.push_back(add_scaled(ray.origin, hit.distance, ray.direction));
      scene.points.push_back(add_scaled(ray.origin, hit.distance + noise, ray.direction));
      scene.label.push_back(hit.label);
    }
  split_faces(sensor, pixel, model, scene);
  return scene;
}

} // namespace CGAL::Tandem::scenes
