// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of the view: a line of Base64 for each block of them. points.js reads it.

#ifndef DETECT_PLANES_WRITE_POINTS_H
#define DETECT_PLANES_WRITE_POINTS_H

#include "output/write_results.h"

#include <CGAL/Bbox_3.h>

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

#include <sstream>
#include <vector>

namespace program {

inline std::string base64(std::string bytes)
{
  namespace it = boost::archive::iterators;
  using Digits = it::base64_from_binary<it::transform_width<std::string::const_iterator, 6, 8>>;
  const std::size_t padding = (3 - bytes.size() % 3) % 3;
  bytes.append(padding, '\0');
  std::string text(Digits(bytes.begin()), Digits(bytes.end()));
  return text.replace(text.size() - padding, padding, padding, '=');
}

// Numbers as their bytes, least significant first, as lines of Base64.
class Base64_lines {
public:
  explicit Base64_lines(std::ostream& out) : out(out) {}

  template <class T>
  void write(T value)
  {
    write_binary(bytes, value);
    if(bytes.tellp() >= line_size)
      flush();
  }

  void flush()
  {
    if(bytes.tellp() > 0)
      out << base64(bytes.str()) << '\n';
    bytes.str("");
  }

private:
  static constexpr std::streamoff line_size = 30000;
  std::ostream& out;
  std::ostringstream bytes;
};

// An element of a page that is no markup, with the numbers that write(lines) writes.
template <class Write>
void write_numbers(std::ostream& out, const char* id, const Write& write)
{
  out << "<script type=\"text/plain\" id=\"" << id << "\">\n";
  Base64_lines lines(out);
  write(lines);
  lines.flush();
  out << "</script>\n";
}

// The points that are shown, shape by shape, then those without a shape. Of every `stride` points in this order one is
// taken, by a hash: a fixed one would follow the lines of a scan.
class Thinned_points {
public:
  Thinned_points(const Point_set& points, const Shapes& shapes, std::size_t largest_size)
    : stride((std::max)(std::size_t(1), (points.size() + largest_size - 1) / largest_size)),
      shown(shapes.number_of_shapes() + 1)
  {
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      for(std::uint32_t i : shapes.points(s))
        add(i, s);
    std::uint32_t position = 0;
    for(Point_set::Index i : points) {
      if(shapes.shape_index(position) < 0 && is_finite(points.point(i)))
        add(position, shapes.number_of_shapes());
      ++position;
    }
  }

  std::size_t size() const { return positions.size(); }

  const std::size_t stride;
  std::vector<std::uint32_t> positions; // in the cloud
  std::vector<std::size_t> shown;       // points of each shape; at the end, of none

private:
  static std::uint64_t hash(std::uint64_t x)
  {
    x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdu;
    x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53u;
    return x ^ (x >> 33);
  }

  void add(std::uint32_t position, std::size_t shape)
  {
    const std::size_t row = count / stride;
    if(count++ % stride != hash(row + 1) % stride)
      return;
    positions.push_back(position);
    ++shown[shape];
  }

  std::size_t count = 0;
};

// ---

inline Kernel::Point_3 point_at(const Point_set& points, std::size_t position)
{
  return points.point(*(points.begin() + std::ptrdiff_t(position)));
}

// 128 + 127 d / (largest distance), for the distance d of a point to the plane of its shape.
inline std::uint8_t distance_byte(const Shapes& shapes, const Point_set& points, std::size_t position)
{
  const int shape = shapes.shape_index(position);
  if(shape < 0)
    return 128;
  const auto& c = shapes.coefficients(std::size_t(shape));
  const Kernel::Point_3 p = point_at(points, position);
  const double distance = std::fma(c[0], p.x(), std::fma(c[1], p.y(), std::fma(c[2], p.z(), c[3])));
  const double fraction = distance / shapes.parameters().maximum_distance;
  return std::uint8_t(128 + std::lround(127 * (std::max)(-1., (std::min)(fraction, 1.))));
}

using Positions = std::vector<std::uint32_t>; // in the cloud

// A block has a box: its corner, relative to the center of the page, and the step of the coordinates along each axis,
// as floats; then three 16-bit coordinates for each point; then a byte each for its distance.
inline std::string block_of(const Point_set& points, const Shapes& shapes, const Kernel::Point_3& center,
                            const Positions& positions)
{
  std::ostringstream bytes;
  CGAL::Bbox_3 box;
  for(std::size_t i : positions)
    box += point_at(points, i).bbox();
  std::array<double, 3> step;
  for(int k = 0; k < 3; ++k)
    write_binary(bytes, float(box.min(k) - center[k]));
  for(int k = 0; k < 3; ++k) {
    step[std::size_t(k)] = (box.max(k) - box.min(k)) / 65535;
    write_binary(bytes, float(step[std::size_t(k)]));
  }
  for(std::size_t i : positions) {
    const Kernel::Point_3 p = point_at(points, i);
    for(int k = 0; k < 3; ++k) {
      const double h = step[std::size_t(k)];
      write_binary(bytes, std::uint16_t(h > 0 ? std::lround((std::min)((p[k] - box.min(k)) / h, 65535.)) : 0));
    }
  }
  for(std::size_t i : positions)
    write_binary(bytes, distance_byte(shapes, points, i));
  return bytes.str();
}

} // namespace program

#endif // DETECT_PLANES_WRITE_POINTS_H
