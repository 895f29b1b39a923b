// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of the view: which are shown, and how they are written.

#include "testing/checks.h"

#include "view/write_points.h"

#include <boost/archive/iterators/binary_from_base64.hpp>

#include <limits>
#include <string>
#include <sstream>

BOOST_AUTO_TEST_SUITE(test_view_points)

using program::Kernel;
using program::Point_set;
using program::Shapes;
using program::Thinned_points;

constexpr double shift = 4.5e6;

// A point without a shape, one of shape 0, one of shape 1, and so on. One has no place, one without a shape is far away.
Point_set make_points(std::size_t size)
{
  Point_set points;
  for(std::size_t i = 0; i < size; ++i)
    points.insert(Kernel::Point_3(shift + double(i % 1000), double(i), double(i % 1000) / 1000));
  points.point(*points.begin()) = Kernel::Point_3(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  points.point(*(points.begin() + 3)) = Kernel::Point_3(1e12, 0, 0);
  return points;
}

// Their planes are z = 0 and z = 1.
Shapes make_shapes(std::size_t size)
{
  Shapes::Data data;
  std::vector<std::int32_t> shape_of(size);
  for(std::size_t i = 0; i < size; ++i)
    shape_of[i] = int(i % 3) - 1;
  data.shape_of = std::move(shape_of);
  data.coefficients = {{0, 0, 1, 0}, {0, 0, 1, -1}};
  data.parallel_group = {0, 0};
  data.coplanar_group = {0, 1};
  data.is_flipped = {0, 0};
  data.parameters.maximum_distance = 2;
  return Shapes(data);
}

std::string decoded(std::string text)
{
  namespace it = boost::archive::iterators;
  using Bytes = it::transform_width<it::binary_from_base64<std::string::const_iterator>, 8, 6>;
  const std::size_t padding = std::size_t(std::count(text.begin(), text.end(), '='));
  std::replace(text.begin(), text.end(), '=', 'A');
  const std::string bytes(Bytes(text.begin()), Bytes(text.end()));
  return bytes.substr(0, bytes.size() - padding);
}

template <class T>
T number(const std::string& bytes, std::size_t position)
{
  T result;
  std::memcpy(&result, bytes.data() + position, sizeof result);
  return result;
}

// One of every `stride` points of each shape, not always the same one, none twice.
BOOST_AUTO_TEST_CASE(test_thinning)
{
  const std::size_t size = 30000, largest = 1000, stride = 30;
  const Point_set points = make_points(size);
  const Shapes shapes = make_shapes(size);
  const Thinned_points all(points, shapes, size), some(points, shapes, largest);
  CHECK_AT(all.stride == 1 && all.size() == size - 1, std::to_string(all.size())); // one has no place
  CHECK_AT(some.stride == stride && some.size() <= largest && some.size() >= largest - 1, std::to_string(some.size()));
  std::size_t next = 0, as_first = 0;
  for(std::size_t first = 0; first + stride <= all.size(); first += stride, ++next) {
    const auto begin = all.positions.begin() + std::ptrdiff_t(first), end = begin + std::ptrdiff_t(stride);
    const auto found = std::find(begin, end, some.positions[next]);
    CHECK_AT(found != end, std::to_string(first));
    as_first += found == begin;
  }
  CHECK_AT(as_first > 5 && as_first < 100, std::to_string(as_first));
  for(std::size_t s = 0; s < 3; ++s)
    CHECK_AT(some.shown[s] >= 330 && some.shown[s] <= 336, std::to_string(some.shown[s]));
}

BOOST_AUTO_TEST_CASE(test_base64)
{
  for(const auto& [bytes, text] : {std::pair("f", "Zg=="), std::pair("fo", "Zm8="), std::pair("foo", "Zm9v"),
                                   std::pair("\xff\xfe", "//4="), std::pair("", "")})
    CHECK_AT(program::base64(bytes) == text && decoded(text) == bytes, program::base64(bytes));
}

// Each coordinate is within half a step of the box of its block, and the float of its corner.
BOOST_AUTO_TEST_CASE(test_blocks)
{
  const std::size_t size = 3 * 5000;
  const Point_set points = make_points(size);
  const Shapes shapes = make_shapes(size);
  const Thinned_points thinned(points, shapes, size);
  std::stringstream text;
  const Kernel::Point_3 center(shift + 500, 7500, 0);
  program::Point_block_writer(points, shapes, center).write(text, thinned.positions.begin(), thinned.positions.end());
  std::size_t first = 0;
  for(std::string line; text >> line;) {
    const std::string bytes = decoded(line);
    const std::size_t count = (bytes.size() - 24) / 7;
    CHECK_AT(bytes.size() == 24 + 7 * count && first + count <= thinned.size(), std::to_string(first));
    for(std::size_t i = 0; i < count; ++i) {
      const std::uint32_t position = thinned.positions[first + i];
      const Kernel::Point_3 p = program::point_at(points, position);
      for(int k = 0; k < 3; ++k) {
        const double corner = number<float>(bytes, 4 * std::size_t(k)),
                     step = number<float>(bytes, 12 + 4 * std::size_t(k));
        const double x = corner + step * number<std::uint16_t>(bytes, 24 + 6 * i + 2 * std::size_t(k));
        CHECK_AT(std::fabs(x - (p[k] - center[k])) <= 0.51 * step + 1e-6 * std::fabs(x), std::to_string(position));
      }
      const int shape = shapes.shape_index(position), byte = std::uint8_t(bytes[24 + 6 * count + i]);
      const double distance = shape < 0 ? 0 : p.z() - shape;
      CHECK_AT(std::fabs((byte - 128) / 127. * 2 - distance) < 0.01, std::to_string(position));
    }
    first += count;
  }
  CHECK_AT(first == thinned.size(), std::to_string(first));
}

BOOST_AUTO_TEST_SUITE_END()
