// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A picture of pixels, written as PNG.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PICTURE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PICTURE_H

#include <png.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace benchmark {

using Color = std::array<std::uint8_t, 3>; // red, green, blue

inline Color scaled(const Color& color, double factor)
{
  Color result;
  for(std::size_t c = 0; c < 3; ++c)
    result[c] = std::uint8_t((std::min)(factor * color[c] + 0.5, 255.0));
  return result;
}

class Picture {
public:
  Picture(int width, int height, const Color& background)
    : width_(width), height_(height), pixels_(std::size_t(width) * std::size_t(height), background)
  {}

  int width() const { return width_; }
  int height() const { return height_; }
  Color& at(int x, int y) { return pixels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)]; }
  const Color& at(int x, int y) const { return pixels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)]; }

  // Half as wide and high, each pixel the mean of four: smooth edges.
  Picture halved() const
  {
    Picture half(width_ / 2, height_ / 2, Color{});
    for(int y = 0; y < half.height_; ++y)
      for(int x = 0; x < half.width_; ++x)
        for(std::size_t c = 0; c < 3; ++c) {
          int sum =
            at(2 * x, 2 * y)[c] + at(2 * x + 1, 2 * y)[c] + at(2 * x, 2 * y + 1)[c] + at(2 * x + 1, 2 * y + 1)[c];
          half.at(x, y)[c] = std::uint8_t((sum + 2) / 4);
        }
    return half;
  }

  // This one on the left, the other, as high, on the right.
  Picture beside(const Picture& other) const
  {
    Picture both(width_ + other.width_, height_, Color{});
    for(int y = 0; y < height_; ++y) {
      std::copy(&at(0, y), &at(0, y) + width_, &both.at(0, y));
      std::copy(&other.at(0, y), &other.at(0, y) + other.width_, &both.at(width_, y));
    }
    return both;
  }

  // With the 256 colors that are most frequent; the others, at edges, become the most similar of these.
  void write_png(const std::string& path) const
  {
    std::map<Color, std::size_t> count;
    for(const Color& pixel : pixels_)
      ++count[coarse(pixel)];
    std::vector<Color> palette;
    for(const auto& entry : count)
      palette.push_back(entry.first);
    std::stable_sort(palette.begin(), palette.end(),
                     [&](const Color& a, const Color& b) { return count[a] > count[b]; });
    palette.resize((std::min)(palette.size(), std::size_t(256)));
    std::map<Color, std::uint8_t> index;
    for(const auto& entry : count)
      index[entry.first] = maximum_similar(palette, entry.first);
    std::vector<std::uint8_t> bytes;
    for(const Color& pixel : pixels_)
      bytes.push_back(index[coarse(pixel)]);
    write(path, bytes, palette);
  }

private:
  // Steps of eight, which the eye does not see.
  static Color coarse(Color color)
  {
    for(std::uint8_t& value : color)
      value = std::uint8_t(value >= 252 ? 255 : (value + 4) / 8 * 8);
    return color;
  }

  static std::uint8_t maximum_similar(const std::vector<Color>& palette, const Color& color)
  {
    auto difference = [&](const Color& other) {
      int sum = 0;
      for(std::size_t c = 0; c < 3; ++c)
        sum += (int(color[c]) - other[c]) * (int(color[c]) - other[c]);
      return sum;
    };
    auto best = std::min_element(palette.begin(), palette.end(),
                                 [&](const Color& a, const Color& b) { return difference(a) < difference(b); });
    return std::uint8_t(best - palette.begin());
  }

  void write(const std::string& path, const std::vector<std::uint8_t>& bytes, const std::vector<Color>& palette) const
  {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = png_uint_32(width_);
    image.height = png_uint_32(height_);
    image.format = PNG_FORMAT_RGB_COLORMAP;
    image.colormap_entries = png_uint_32(palette.size());
    if(!png_image_write_to_file(&image, path.c_str(), 0, bytes.data(), 0, palette.data()))
      throw std::runtime_error(path + ": cannot be written: " + image.message);
  }

  int width_, height_;
  std::vector<Color> pixels_;
};

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PICTURE_H
