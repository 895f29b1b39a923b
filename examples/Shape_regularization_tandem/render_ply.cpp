// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Draws the output of detect_planes as a PPM picture: the cloud as it came on the
// left, the shapes in their colors on the right.
//   render_ply SHAPES.ply PICTURE.ppm [azimuth elevation (degrees)]

#include "read_cloud.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace {

using program::Point_set;
using Color = std::array<double, 3>;

constexpr int width = 720, height = 560, margin = 16;
constexpr int shadow = 1; // pixels around a point that it covers

struct Camera {
  double right[3], up[3], to_viewer[3];

  // Looks down the direction from which azimuth and elevation are measured; z is up.
  Camera(double azimuth, double elevation)
  {
    const double radian = std::acos(-1.0) / 180;
    const double ca = std::cos(azimuth * radian), sa = std::sin(azimuth * radian);
    const double ce = std::cos(elevation * radian), se = std::sin(elevation * radian);
    set(right, -sa, ca, 0);
    set(up, -se * ca, -se * sa, ce);
    set(to_viewer, ce * ca, ce * sa, se);
  }

  static void set(double* v, double x, double y, double z) { v[0] = x, v[1] = y, v[2] = z; }
};

template <class Vector>
double along(const double* axis, const Vector& v)
{
  return axis[0] * v.x() + axis[1] * v.y() + axis[2] * v.z();
}

struct Splat {
  double x, y, depth; // right, up, towards the viewer
  Color plain, shape;
};

// Light from the viewer's upper left; normals may point either way.
Color shaded(const Camera& camera, const program::Kernel::Vector_3& normal, const Color& color)
{
  const double length = std::sqrt(normal.squared_length());
  const double light = std::fabs(-.35 * along(camera.right, normal) + .5 * along(camera.up, normal) +
                                 .79 * along(camera.to_viewer, normal));
  const double brightness = length > 0 ? .45 + .55 * light / length : .7;
  return {brightness * color[0], brightness * color[1], brightness * color[2]};
}

std::vector<Splat> make_splats(Point_set& points, const Camera& camera)
{
  const auto channel = [&](const char* name) { return points.add_property_map<std::uint8_t>(name, 128).first; };
  const auto red = channel("red"), green = channel("green"), blue = channel("blue");
  const auto shape = points.add_property_map<std::int32_t>("shape", -1).first;
  std::vector<Splat> splats;
  for(Point_set::Index i : points) {
    const auto& p = points.point(i);
    if(!program::is_finite(p))
      continue;
    const auto normal = points.has_normal_map() ? points.normal(i) : program::Kernel::Vector_3(0, 0, 0);
    const Color color = shape[i] < 0 ? Color{222, 222, 222} : Color{double(red[i]), double(green[i]), double(blue[i])};
    splats.push_back({along(camera.right, p), along(camera.up, p), along(camera.to_viewer, p),
                      shaded(camera, normal, {235, 235, 235}), shape[i] < 0 ? color : shaded(camera, normal, color)});
  }
  return splats;
}

// Both views of all points in one picture.
class Picture {
public:
  Picture() : pixels(2 * width * height, Color{255, 255, 255}), depths(pixels.size(), -1e300) {}

  void draw(const std::vector<Splat>& splats)
  {
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    for(const Splat& s : splats) {
      low[0] = (std::min)(low[0], s.x), high[0] = (std::max)(high[0], s.x);
      low[1] = (std::min)(low[1], s.y), high[1] = (std::max)(high[1], s.y);
    }
    const double scale = (std::min)((width - 2 * margin) / (std::max)(high[0] - low[0], 1e-300),
                                    (height - 2 * margin) / (std::max)(high[1] - low[1], 1e-300));
    for(const Splat& s : splats) {
      const int x = int(width / 2 + scale * (s.x - (low[0] + high[0]) / 2));
      const int y = int(height / 2 - scale * (s.y - (low[1] + high[1]) / 2));
      cover(x, y, s.depth, s.plain);
      cover(width + x, y, s.depth, s.shape);
    }
  }

  void write(std::ostream& out) const
  {
    out << "P6\n" << 2 * width << ' ' << height << "\n255\n";
    for(const Color& pixel : pixels)
      for(double c : pixel)
        out.put(char(std::uint8_t(c)));
  }

private:
  void cover(int x, int y, double depth, const Color& color)
  {
    for(int v = (std::max)(y - shadow, 0); v <= (std::min)(y + shadow, height - 1); ++v)
      for(int u = (std::max)(x - shadow, 0); u <= (std::min)(x + shadow, 2 * width - 1); ++u) {
        const std::size_t i = std::size_t(v) * 2 * width + std::size_t(u);
        if(depth > depths[i]) {
          depths[i] = depth;
          pixels[i] = color;
        }
      }
  }

  std::vector<Color> pixels;
  std::vector<double> depths;
};

} // namespace

int main(int argc, char* argv[])
{
  if(argc != 3 && argc != 5) {
    std::cerr << "usage: render_ply SHAPES.ply PICTURE.ppm [azimuth elevation]" << std::endl;
    return 2;
  }
  try {
    Point_set points;
    program::read_cloud(argv[1], points);
    const Camera camera(argc == 5 ? std::atof(argv[3]) : 40, argc == 5 ? std::atof(argv[4]) : 35);
    Picture picture;
    picture.draw(make_splats(points, camera));
    std::ofstream out(argv[2], std::ios::binary);
    picture.write(out);
    out.close();
    if(!out)
      throw std::runtime_error(std::string(argv[2]) + ": cannot be written");
  } catch(const std::exception& e) {
    std::cerr << "render_ply: " << e.what() << std::endl;
    return 1;
  }
  return 0;
}
