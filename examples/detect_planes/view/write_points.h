// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of the view: a line of Base64 for each block of them. points.js reads it.

#ifndef DETECT_PLANES_WRITE_POINTS_H
#define DETECT_PLANES_WRITE_POINTS_H

#include "view/Base64_lines.h"
#include "view/Thinned_points.h"

#include <CGAL/Bbox_3.h>

#include <cmath>
#include <ostream>
#include <sstream>
#include <string>

namespace program {

inline Kernel::Point_3 point_at(const Point_set& points, std::size_t position)
{
  return points.point(*(points.begin() + std::ptrdiff_t(position)));
}

// A block has a box: its corner, relative to the center of the page, and the step of the coordinates along each axis,
// as floats; then three 16-bit coordinates for each point; then a byte each for the distance to the plane of its shape,
// 128 + 127 d / (largest distance).
class Point_block_writer {
public:
  static constexpr std::size_t block_size = 4096;

  Point_block_writer(const Point_set& points, const Shapes& shapes, const Kernel::Point_3& center)
    : points(points), shapes(shapes), center(center)
  {}

  using Iterator = std::vector<std::uint32_t>::const_iterator; // of positions in the cloud

  void write(std::ostream& out, Iterator first, Iterator last) const
  {
    while(first != last) {
      const Iterator end = first + (std::min)(std::ptrdiff_t(block_size), last - first);
      out << base64(block(first, end)) << '\n';
      first = end;
    }
  }

private:
  std::string block(Iterator first, Iterator last) const
  {
    std::ostringstream bytes;
    Binary_writer binary(bytes);
    CGAL::Bbox_3 box;
    for(Iterator i = first; i != last; ++i)
      box += point_at(points, *i).bbox();
    std::array<double, 3> step;
    for(int k = 0; k < 3; ++k)
      binary.write(float(box.min(k) - center[k]));
    for(int k = 0; k < 3; ++k) {
      step[std::size_t(k)] = (box.max(k) - box.min(k)) / 65535;
      binary.write(float(step[std::size_t(k)]));
    }
    for(Iterator i = first; i != last; ++i) {
      const Kernel::Point_3 p = point_at(points, *i);
      for(int k = 0; k < 3; ++k) {
        const double h = step[std::size_t(k)];
        binary.write(std::uint16_t(h > 0 ? std::lround((std::min)((p[k] - box.min(k)) / h, 65535.)) : 0));
      }
    }
    for(Iterator i = first; i != last; ++i)
      binary.write(distance_byte(*i));
    return bytes.str();
  }

  std::uint8_t distance_byte(std::size_t position) const
  {
    const int shape = shapes.shape_index(position);
    if(shape < 0)
      return 128;
    const auto& c = shapes.coefficients(std::size_t(shape));
    const Kernel::Point_3 p = point_at(points, position);
    const double distance = std::fma(c[0], p.x(), std::fma(c[1], p.y(), std::fma(c[2], p.z(), c[3])));
    const double share = distance / shapes.parameters().maximum_distance;
    return std::uint8_t(128 + std::lround(127 * (std::max)(-1., (std::min)(share, 1.))));
  }

  const Point_set& points;
  const Shapes& shapes;
  Kernel::Point_3 center;
};

} // namespace program

#endif // DETECT_PLANES_WRITE_POINTS_H
