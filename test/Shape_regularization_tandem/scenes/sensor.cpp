// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "sensor.h"

#include <limits>
#include <map>
#include <numeric>

namespace CGAL::Tandem::scenes {

namespace {

struct Hit {
  double distance = std::numeric_limits<double>::infinity(); // in units of the length of the direction
  std::int32_t label = -1;                                   // index of the face, -1 on curved patches

  bool exists() const { return distance < std::numeric_limits<double>::infinity(); }
};

// Where a ray meets a model first. The same bits on every machine.
class Ray_caster {
public:
  explicit Ray_caster(const Model& model) : model_(model) {}

  // Farther than `nearest`, since a ray that begins on a surface is not to meet it.
  Hit operator()(const Vec& origin, const Vec& direction, double nearest = 0.01) const
  {
    Hit hit;
    for(std::size_t f = 0; f < model_.faces.size(); ++f) {
      const Face& face = model_.faces[f];
      const double slope = dot(face.normal, direction);
      const double distance = slope == 0 ? -1 : -(dot(face.normal, origin) + face.offset) / slope;
      if(distance > nearest && distance < hit.distance &&
         model_.is_on(face, add_scaled(origin, distance, direction), 1e-7))
        hit = {distance, std::int32_t(f)};
    }
    for(const Curved& curved : model_.curved)
      meet(curved, origin, direction, nearest, hit);
    return hit;
  }

private:
  // Both roots of the quadratic equation, the nearer one first.
  static void meet(const Curved& curved, const Vec& origin, const Vec& direction, double nearest, Hit& hit)
  {
    const Frame& f = curved.frame;
    const bool is_sphere = curved.height == 0;
    const auto local = [&](const Vec& v) { return Vec{dot(f.x, v), dot(f.y, v), dot(f.z, v)}; };
    const Vec o = local(origin - f.origin), d = local(direction);
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

  const Model& model_;
};

// By its series, which has the same bits on every machine, unlike that of a library; within [-pi, pi].
double sine(double angle)
{
  const double square = angle * angle;
  double sum = 1;
  for(int i = 27; i > 1; i -= 2)
    sum = std::fma(-square / (i * (i - 1)), sum, 1.);
  return angle * sum;
}

double cosine(double angle)
{
  const double square = angle * angle;
  double sum = 1;
  for(int i = 26; i > 0; i -= 2)
    sum = std::fma(-square / (i * (i - 1)), sum, 1.);
  return sum;
}

struct Ray {
  Vec origin, direction;
};

// Of the pixel at the place (u, v) of [0, 1]^2.
Ray ray_of(const Sensor& sensor, double u, double v)
{
  const Frame& pose = sensor.pose;
  if(sensor.kind == Sensor_kind::aerial)
    return {pose.point({u * sensor.width, v * sensor.height, 0}), -1. * pose.z};
  if(sensor.kind == Sensor_kind::camera)
    return {pose.origin, unit(pose.vector({(u - 0.5) * sensor.width, (v - 0.5) * sensor.height, 1}))};
  const double azimuth = (u - 0.5) * sensor.width, elevation = sensor.lowest + v * sensor.height;
  const double across = cosine(elevation);
  return {pose.origin, unit(pose.vector({across * cosine(azimuth), across * sine(azimuth), sine(elevation)}))};
}

double noise_of(const Sensor& sensor, double distance)
{
  if(sensor.kind == Sensor_kind::aerial)
    return sensor.noise;
  const double share = distance / 3;
  return sensor.noise * (sensor.kind == Sensor_kind::camera ? share * share : share);
}

// The pixels that met something, with the index of their point.
class Image {
public:
  explicit Image(const Sensor& sensor)
    : columns_(int(sensor.columns)), rows_(int(sensor.rows)),
      turns_(sensor.kind == Sensor_kind::scanner && sensor.width > 6.28),
      point_(std::size_t(sensor.columns) * sensor.rows, -1)
  {}

  std::int32_t& operator()(int column, int row) { return point_[std::size_t(row) * std::size_t(columns_) + column]; }

  // Calls join(i, j) for the points of pixels that are at most two rows and columns apart.
  template <class Join>
  void for_each_pair(const Join& join)
  {
    for(int row = 0; row < rows_; ++row)
      for(int column = 0; column < columns_; ++column)
        for(int r = row; r <= (std::min)(row + 2, rows_ - 1); ++r)
          for(int c = column - 2; c <= column + 2; ++c) {
            const int wrapped = turns_ ? (c + columns_) % columns_ : c;
            if(wrapped >= 0 && wrapped < columns_ && (*this)(column, row) >= 0 && (*this)(wrapped, r) >= 0)
              join((*this)(column, row), (*this)(wrapped, r));
          }
  }

private:
  int columns_, rows_;
  bool turns_;
  std::vector<std::int32_t> point_; // -1: none
};

// Numbers the connected pieces of faces, in the order of their first points.
void split_faces(Image& image, const Model& model, Scene& scene)
{
  std::vector<std::int32_t> parent(scene.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t i) {
    while(parent[std::size_t(i)] != i)
      i = parent[std::size_t(i)] = parent[std::size_t(parent[std::size_t(i)])];
    return i;
  };
  image.for_each_pair([&](std::int32_t i, std::int32_t j) {
    if(scene.label[std::size_t(i)] == scene.label[std::size_t(j)])
      parent[std::size_t((std::max)(root(i), root(j)))] = (std::min)(root(i), root(j));
  });
  std::map<std::int32_t, std::int32_t> number;
  for(std::size_t i = 0; i < scene.label.size(); ++i) {
    if(scene.label[i] < 0)
      continue;
    const auto entry = number.emplace(root(std::int32_t(i)), std::int32_t(number.size()));
    if(entry.second) {
      const Face& face = model.faces[std::size_t(scene.label[i])];
      scene.faces.push_back({face.normal, face.offset});
    }
    scene.label[i] = entry.first->second;
  }
}

} // namespace

Scene scan(const Model& model, const Sensor& sensor)
{
  Scene scene;
  Image image(sensor);
  Random random(sensor.seed);
  const Ray_caster caster(model);
  const bool is_aerial = sensor.kind == Sensor_kind::aerial;
  for(unsigned row = 0; row < sensor.rows; ++row)
    for(unsigned column = 0; column < sensor.columns; ++column) {
      const double u = is_aerial ? random.uniform() : 0.5, v = is_aerial ? random.uniform() : 0.5;
      const Ray ray = ray_of(sensor, (column + u) / sensor.columns, (row + v) / sensor.rows);
      const Hit hit = caster(ray.origin, ray.direction);
      const double noise = noise_of(sensor, hit.distance) * random.gaussian();
      if(!hit.exists())
        continue;
      image(int(column), int(row)) = std::int32_t(scene.points.size());
      scene.ideal.push_back(add_scaled(ray.origin, hit.distance, ray.direction));
      scene.points.push_back(add_scaled(ray.origin, hit.distance + noise, ray.direction));
      scene.label.push_back(hit.label);
    }
  split_faces(image, model, scene);
  return scene;
}

} // namespace CGAL::Tandem::scenes
