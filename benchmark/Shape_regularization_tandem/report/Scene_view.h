// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Draws what detectors made of a cloud, all from the same place: each point a
// small square in the color of its shape, the nearest in front, shaded by the
// plane of the shape and darker beside what lies far in front.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SCENE_VIEW_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SCENE_VIEW_H

#include "Camera.h"
#include "shape_colors.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

struct Picture_size {
  int width = 600, height = 450;
};

class Scene_view {
public:
  // The cloud must outlive the view.
  explicit Scene_view(const Ply_cloud& cloud, const View& view = {}, Picture_size size = {})
    : cloud_(cloud), width_(2 * size.width), height_(2 * size.height),
      camera_(find_camera(cloud, view, double(size.width) / size.height))
  {
    for(std::size_t i = 0; i < cloud.points.size(); ++i)
      if(camera_.sees(cloud.points[i])) // not where it is not a number
        spots_.push_back(spot_of(i));
    double spacing = std::sqrt(double(width_) * height_ / double((std::max)(spots_.size(), std::size_t(1))));
    radius_ = (std::max)(1, (std::min)(int(spacing + 0.5), 6));
  }

  // The cloud as it came, in grey.
  Picture draw_input() const
  {
    return drawn(
      [&](const Spot& spot) {
        return scaled({225, 228, 232}, cloud_.has_normals() ? light(cloud_.normals[spot.point]) : 0.85);
      },
      [&](const Spot&) { return (radius_ + 1) / 2; });
  }

  // One color per shape, and black where a point is marked. Points without a shape are pale, and smaller, so that
  // clutter does not hide the shapes.
  Picture draw(const Detection& detection, const std::vector<Color>& colors, const std::vector<bool>& is_marked) const
  {
    std::vector<Color> shaded;
    for(std::size_t s = 0; s < colors.size(); ++s)
      shaded.push_back(scaled(colors[s], light(detection.planes[s].normal)));
    return drawn(
      [&](const Spot& spot) {
        std::int32_t s = detection.label[spot.point];
        Color color = s < 0 ? Color{200, 200, 200} : shaded[std::size_t(s)];
        return is_marked[spot.point] ? Color{20, 20, 20} : color;
      },
      [&](const Spot& spot) { return detection.label[spot.point] < 0 ? radius_ / 3 : radius_; });
  }

private:
  struct Spot {
    std::uint32_t point;
    int x, y;
    float depth; // towards the viewer
  };

  Spot spot_of(std::size_t i) const
  {
    const Vec& p = cloud_.points[i];
    const Window& w = camera_.window;
    auto pixel = [](double share, int size) {
      return int((std::max)(-1e6, (std::min)(std::floor(share * size), 1e6)));
    };
    return {std::uint32_t(i), pixel((dot(p, camera_.right) - w.left) / (w.right - w.left), width_),
            pixel((w.top - dot(p, camera_.up)) / (w.top - w.bottom), height_),
            float(dot(p - cloud_.points[0], camera_.to_viewer))};
  }

  // From the upper left of the viewer; planes have two sides.
  double light(const Vec& normal) const
  {
    double l = length(normal);
    double cosine = std::abs(-0.42 * dot(camera_.right, normal) + 0.60 * dot(camera_.up, normal) +
                             0.68 * dot(camera_.to_viewer, normal));
    return l > 0 ? 0.6 + 0.4 * cosine / l : 0.8;
  }

  template <class Color_of, class Radius_of>
  Picture drawn(Color_of color_of, Radius_of radius_of) const
  {
    Picture picture(width_, height_, {255, 255, 255});
    std::vector<float> depth(std::size_t(width_) * std::size_t(height_), nothing);
    for(const Spot& spot : spots_) {
      Color color = color_of(spot);
      int r = radius_of(spot);
      for(int y = (std::max)(spot.y - r, 0); y <= (std::min)(spot.y + r, height_ - 1); ++y)
        for(int x = (std::max)(spot.x - r, 0); x <= (std::min)(spot.x + r, width_ - 1); ++x) {
          float& d = depth[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
          if(spot.depth > d) {
            d = spot.depth;
            picture.at(x, y) = color;
          }
        }
    }
    darken_edges(depth, picture);
    return picture.halved();
  }

  // Eye-dome lighting: a pixel is darker the more its neighbors lie in front of it.
  void darken_edges(const std::vector<float>& depth, Picture& picture) const
  {
    const float unit = float(0.012 * (camera_.window.right - camera_.window.left));
    const int reach = 3;
    auto depth_at = [&](int x, int y) {
      bool is_inside = x >= 0 && y >= 0 && x < width_ && y < height_;
      return is_inside ? depth[std::size_t(y) * std::size_t(width_) + std::size_t(x)] : nothing;
    };
    for(int y = 0; y < height_; ++y)
      for(int x = 0; x < width_; ++x) {
        float own = depth_at(x, y), hidden = 0;
        if(own == nothing)
          continue;
        for(auto step : {std::make_pair(-reach, 0), {reach, 0}, {0, -reach}, {0, reach}})
          hidden += (std::max)(0.f, (std::min)((depth_at(x + step.first, y + step.second) - own) / unit, 1.f));
        picture.at(x, y) = scaled(picture.at(x, y), 1 - 0.13 * hidden);
      }
  }

  static constexpr float nothing = -3e38f;

  const Ply_cloud& cloud_;
  int width_, height_; // twice the picture's: it is halved in the end
  Camera camera_;
  std::vector<Spot> spots_;
  int radius_;
};

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SCENE_VIEW_H
