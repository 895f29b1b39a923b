// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where to look at a cloud from: obliquely from above, with the walls turned a
// little, and into a room through its ceiling, which is left out.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_CAMERA_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_CAMERA_H

#include "clouds/ply_cloud.h"

#include <set>

namespace CGAL {
namespace Tandem {
namespace benchmark {

// What is known beforehand; the rest is found.
struct View {
  Vec vertical{0, 0, 0}; // points up
  double azimuth_deg = -1000, elevation_deg = -1000;
};

// A window onto the plane of the picture, in units of the cloud.
struct Window {
  double left, right, bottom, top;
};

struct Camera {
  Vec right, up, to_viewer; // orthonormal
  Vec vertical;
  double ceiling; // what is higher along the vertical is not drawn
  Window window;

  bool sees(const Vec& p) const { return dot(p, vertical) <= ceiling; }
};

// The value below which this share of the values lies.
inline double quantile(std::vector<double> values, double share)
{
  std::size_t i = (std::min)(std::size_t(share * double(values.size())), values.size() - 1);
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(i), values.end());
  return values[i];
}

class Camera_finder {
public:
  Camera_finder(const Ply_cloud& cloud, const View& view, double aspect) : aspect_(aspect)
  {
    sample(cloud);
    vertical_ = dot(view.vertical, view.vertical) > 0 ? scenes::unit(view.vertical) : find_vertical();
    Vec other = std::abs(vertical_.z) < 0.9 ? Vec{0, 0, 1} : Vec{1, 0, 0};
    east_ = scenes::unit(cross(other, vertical_));
    north_ = cross(vertical_, east_);
    find_ceiling();
    double elevation = view.elevation_deg > -360 ? view.elevation_deg : is_room_ ? 52 : 35;
    if(view.azimuth_deg > -360)
      best_ = make_camera(view.azimuth_deg, elevation);
    else
      choose(elevation);
  }

  const Camera& camera() const { return best_; }

private:
  static constexpr double degree = 0.017453292519943295;

  void sample(const Ply_cloud& cloud)
  {
    std::size_t step = 1 + cloud.points.size() / 40000;
    for(std::size_t i = 0; i < cloud.points.size(); i += step) {
      const Vec& p = cloud.points[i];
      if(!std::isfinite(dot(p, p)))
        continue;
      points_.push_back(p);
      if(cloud.has_normals() && dot(cloud.normals[i], cloud.normals[i]) > 0)
        normals_.push_back(scenes::unit(cloud.normals[i]));
    }
    if(points_.empty())
      points_.push_back({0, 0, 0});
  }

  // z, except in earth-centered coordinates, and in those of a camera, whose y points down.
  Vec find_vertical() const
  {
    double radius = length(points_[0]);
    if(radius > 6.33e6 && radius < 6.4e6)
      return scenes::unit(points_[0]);
    auto faces = [&](double Vec::*axis) {
      return std::count_if(normals_.begin(), normals_.end(), [&](const Vec& n) { return std::abs(n.*axis) > 0.94; });
    };
    auto z = faces(&Vec::z);
    bool has_floor = 10 * z >= std::ptrdiff_t(normals_.size()) || 2 * faces(&Vec::y) < 3 * z;
    return has_floor ? Vec{0, 0, 1} : Vec{0, -1, 0};
  }

  // A room is where most of the floor lies under one flat ceiling.
  void find_ceiling()
  {
    std::vector<double> heights;
    for(const Vec& p : points_)
      heights.push_back(dot(p, vertical_));
    double low = quantile(heights, 0.01), high = quantile(heights, 0.985), height = high - low;
    double west = quantile(projections(east_), 0.01), south = quantile(projections(north_), 0.01);
    double cell =
      (std::max)({quantile(projections(east_), 0.99) - west, quantile(projections(north_), 0.99) - south, 1e-300}) / 40;
    std::set<std::pair<long, long>> covered, all;
    for(std::size_t i = 0; i < points_.size(); ++i) {
      auto column = std::make_pair(std::lround((dot(points_[i], east_) - west) / cell),
                                   std::lround((dot(points_[i], north_) - south) / cell));
      all.insert(column);
      if(heights[i] > high - 0.1 * height)
        covered.insert(column);
    }
    is_room_ = double(covered.size()) > 0.5 * double(all.size());
    ceiling_ = is_room_ ? high - 0.12 * height : 1e300;
  }

  std::vector<double> projections(const Vec& axis) const
  {
    std::vector<double> result;
    for(const Vec& p : points_)
      if(dot(p, vertical_) <= ceiling_)
        result.push_back(dot(p, axis));
    return result;
  }

  // Of the walls, in [-45, 45) degrees: the mean of four times the angle.
  double wall_azimuth() const
  {
    double c = 0, s = 0;
    for(const Vec& n : normals_) {
      double x = dot(n, east_), y = dot(n, north_), r = x * x + y * y;
      if(r < 0.5)
        continue;
      double angle = 4 * std::atan2(y, x);
      c += std::cos(angle);
      s += std::sin(angle);
    }
    return std::atan2(s, c) / 4 / degree;
  }

  Camera make_camera(double azimuth_deg, double elevation_deg) const
  {
    double ca = std::cos(azimuth_deg * degree), sa = std::sin(azimuth_deg * degree);
    double ce = std::cos(elevation_deg * degree), se = std::sin(elevation_deg * degree);
    Vec away = ca * east_ + sa * north_;
    Camera camera;
    camera.right = ca * north_ - sa * east_;
    camera.up = ce * vertical_ - se * away;
    camera.to_viewer = ce * away + se * vertical_;
    camera.vertical = vertical_;
    camera.ceiling = ceiling_;
    camera.window = frame(camera);
    return camera;
  }

  // Around nearly all points, of the shape of the picture; a few that fly far off do not count.
  Window frame(const Camera& camera) const
  {
    auto range = [&](const Vec& axis) {
      std::vector<double> values = projections(axis);
      double low = quantile(values, 0.003), high = quantile(values, 0.997), margin = 0.04 * (high - low) + 1e-9;
      return std::make_pair(low - margin, high + margin);
    };
    auto x = range(camera.right), y = range(camera.up);
    double width = (std::max)(x.second - x.first, aspect_ * (y.second - y.first)), height = width / aspect_;
    double cx = (x.first + x.second) / 2, cy = (y.first + y.second) / 2;
    return {cx - width / 2, cx + width / 2, cy - height / 2, cy + height / 2};
  }

  // How much of the picture is covered, times the share of the points that is not hidden.
  double merit(const Camera& camera) const
  {
    constexpr int columns = 80, rows = 60;
    std::vector<double> front(columns * rows, -1e300);
    const Window& w = camera.window;
    auto pixel = [&](const Vec& p) {
      int x = int((dot(p, camera.right) - w.left) / (w.right - w.left) * columns);
      int y = int((dot(p, camera.up) - w.bottom) / (w.top - w.bottom) * rows);
      return x < 0 || y < 0 || x >= columns || y >= rows || !camera.sees(p) ? -1 : y * columns + x;
    };
    for(const Vec& p : points_)
      if(int i = pixel(p); i >= 0)
        front[std::size_t(i)] = (std::max)(front[std::size_t(i)], dot(p, camera.to_viewer));
    double slack = 0.03 * (w.right - w.left), visible = 0;
    for(const Vec& p : points_)
      if(int i = pixel(p); i >= 0)
        visible += dot(p, camera.to_viewer) > front[std::size_t(i)] - slack;
    return visible * double(std::count_if(front.begin(), front.end(), [](double d) { return d > -1e300; }));
  }

  void choose(double elevation_deg)
  {
    double walls = wall_azimuth(), best = -1;
    for(int quarter = 0; quarter < 4; ++quarter)
      for(double turn : {30, 60}) {
        Camera camera = make_camera(walls + 90 * quarter + turn, elevation_deg);
        double value = merit(camera);
        if(value > best) {
          best = value;
          best_ = camera;
        }
      }
  }

  double aspect_;
  std::vector<Vec> points_, normals_; // of a sample
  Vec vertical_, east_, north_;
  bool is_room_ = false;
  double ceiling_ = 1e300;
  Camera best_;
};

inline Camera find_camera(const Ply_cloud& cloud, const View& view, double aspect)
{
  return Camera_finder(cloud, view, aspect).camera();
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_CAMERA_H
