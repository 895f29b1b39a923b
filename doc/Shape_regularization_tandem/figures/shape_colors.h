// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Colors of shapes: distinct, the same in every run, and the same for the shapes of two results that have most points
// in common. Colored clouds are written as PLY files, which viewers show and the figures of the manual draw.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_FIGURES_SHAPE_COLORS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_FIGURES_SHAPE_COLORS_H

#include "clouds/ply_cloud.h"
#include "testing/evaluate.h"

#include <map>

namespace CGAL {
namespace Tandem {
namespace benchmark {

// Hue, saturation and value in [0, 1].
inline Color color_of_hsv(double hue, double saturation, double value)
{
  Color color;
  for(int c = 0; c < 3; ++c) {
    double h = hue * 6 + (c == 0 ? 5 : c == 1 ? 3 : 1);
    h -= 6 * std::floor(h / 6);
    double fraction = (std::max)(0.0, (std::min)({h, 4 - h, 1.0}));
    color[std::size_t(c)] = std::uint8_t(255 * value * (1 - saturation * fraction) + 0.5);
  }
  return color;
}

// Hues in steps of the golden angle: any few in a row are far apart.
inline Color color_of_index(std::size_t index)
{
  static const double saturations[] = {0.60, 0.75, 0.40}, values[] = {0.98, 0.84, 0.92};
  double hue = 0.56 + 0.6180339887498949 * double(index);
  return color_of_hsv(hue - std::floor(hue), saturations[index % 3], values[index / 3 % 3]);
}

// Larger shapes take the earlier colors.
inline std::vector<Color> colors_of(const Detection& detection)
{
  std::vector<std::size_t> size = shape_sizes(detection), order(size.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });
  std::vector<Color> colors(size.size());
  for(std::size_t i = 0; i < order.size(); ++i)
    colors[order[i]] = color_of_index(i);
  return colors;
}

// Of each shape of `other`: the shape of `reference` it corresponds to, or -1. Each is taken once, by the number
// of common points; ties go to the smaller indices.
inline std::vector<std::int32_t> match_shapes(const Detection& reference, const Detection& other)
{
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> common;
  for(std::size_t i = 0; i < reference.label.size(); ++i)
    if(reference.label[i] >= 0 && other.label[i] >= 0)
      ++common[{other.label[i], reference.label[i]}];
  std::vector<std::pair<std::size_t, std::pair<std::int32_t, std::int32_t>>> by_size;
  for(const auto& entry : common)
    by_size.emplace_back(entry.second, entry.first);
  std::stable_sort(by_size.begin(), by_size.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::int32_t> match(other.planes.size(), -1);
  std::vector<bool> is_taken(reference.planes.size(), false);
  for(const auto& entry : by_size) {
    std::size_t s = std::size_t(entry.second.first), r = std::size_t(entry.second.second);
    if(match[s] < 0 && !is_taken[r]) {
      match[s] = entry.second.second;
      is_taken[r] = true;
    }
  }
  return match;
}

// A shape without a counterpart in the reference takes a color that the reference does not use.
inline std::vector<Color> colors_like(const Detection& reference, const Detection& detection)
{
  std::vector<Color> known = colors_of(reference), colors(detection.planes.size());
  std::vector<std::int32_t> match = match_shapes(reference, detection);
  std::size_t next = known.size();
  for(std::size_t s = 0; s < colors.size(); ++s)
    colors[s] = match[s] >= 0 ? known[std::size_t(match[s])] : color_of_index(next++);
  return colors;
}

// The points with the colors and, for even shading, the normals of their shapes. Others are grey.
inline Ply_cloud colored(Ply_cloud cloud, const Detection& detection, const std::vector<Color>& colors)
{
  cloud.normals.resize(cloud.points.size(), Vec{0, 0, 0});
  cloud.color.assign(cloud.points.size(), Color{110, 110, 110});
  cloud.label = detection.label;
  for(std::size_t i = 0; i < cloud.points.size(); ++i)
    if(cloud.label[i] >= 0) {
      const std::size_t shape = std::size_t(cloud.label[i]);
      const Vec& normal = detection.planes[shape].normal;
      cloud.normals[i] = length(normal) > 0 ? scenes::unit(normal) : normal;
      cloud.color[i] = colors[shape];
    }
  return cloud;
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_FIGURES_SHAPE_COLORS_H
