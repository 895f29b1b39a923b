// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pictures of the benchmark: where the camera stands, and which colors show
// what. Skipped without libpng.

#undef NDEBUG

#if !__has_include(<png.h>)
int main() { return 77; }
#else

#define BOOST_TEST_MODULE benchmark_pictures
#include <boost/test/included/unit_test.hpp>

#include "report/Scene_view.h"

#include <functional>

namespace scenes = CGAL::Tandem::scenes;
using namespace CGAL::Tandem::benchmark;

namespace {

const double pi = 3.141592653589793;

// A box from the origin with a floor, walls and, if asked for, a ceiling; 0 is the floor.
Ply_cloud room(double height, bool has_ceiling, const Vec& at = {0, 0, 0})
{
  Ply_cloud cloud;
  auto add = [&](const Vec& p, const Vec& n, int label) {
    cloud.points.push_back(p + at);
    cloud.normals.push_back(n);
    cloud.label.push_back(label);
  };
  for(int i = 0; i <= 60; ++i)
    for(int j = 0; j <= 60; ++j) {
      double u = i / 6.0, v = j / 6.0, h = height * j / 60;
      add({u, v, 0}, {0, 0, 1}, 0);
      add({u, 0, h}, {0, 1, 0}, 1);
      add({0, u, h}, {1, 0, 0}, 2);
      if(has_ceiling)
        add({u, v, height}, {0, 0, 1}, 3);
    }
  return cloud;
}

Detection detection_of(const Ply_cloud& cloud)
{
  return {cloud.label, {{{0, 0, 1}, 0}, {{0, 1, 0}, 0}, {{1, 0, 0}, 0}, {{0, 0, 1}, -3}}};
}

std::size_t count(const Picture& picture, const std::function<bool(const Color&)>& fits)
{
  std::size_t result = 0;
  for(int y = 0; y < picture.height(); ++y)
    for(int x = 0; x < picture.width(); ++x)
      result += fits(picture.at(x, y));
  return result;
}

bool is_dark(const Color& c) { return c[0] < 40 && c[1] < 40 && c[2] < 40; }

} // namespace

BOOST_AUTO_TEST_CASE(a_ceiling_is_left_out)
{
  Camera camera = find_camera(room(3, true), {}, 4.0 / 3);
  BOOST_TEST(camera.sees({5, 5, 1}));
  BOOST_TEST(!camera.sees({5, 5, 3}));
  camera = find_camera(room(3, false), {}, 4.0 / 3);
  BOOST_TEST(camera.sees({5, 5, 3}));
  BOOST_TEST(!camera.sees({5, 5, std::nan("")}));
}

BOOST_AUTO_TEST_CASE(up_is_found)
{
  BOOST_TEST(find_camera(room(3, false), {}, 1).vertical.z == 1.0);
  // Far from the center of the earth: away from it.
  Vec dehradun{1141745, 5391160, 3201808};
  Vec up = find_camera(room(3, false, dehradun), {}, 1).vertical;
  BOOST_TEST(dot(up, scenes::unit(dehradun)) == 1.0, boost::test_tools::tolerance(1e-9));
  // A camera's y points down: a floor whose normal is y, and nothing across z.
  Ply_cloud seen = room(3, false);
  for(Vec& p : seen.points)
    p = {p.x, -p.z, p.y};
  for(Vec& n : seen.normals)
    n = n.z > 0.5 ? Vec{0, -1, 0} : n.y > 0.5 ? Vec{1, 0, 0} : n;
  BOOST_TEST(find_camera(seen, {}, 1).vertical.y == -1.0);
  // What is given counts.
  View view;
  view.vertical = {0, 2, 0};
  BOOST_TEST(find_camera(seen, view, 1).vertical.y == 1.0);
}

BOOST_AUTO_TEST_CASE(the_camera_is_a_frame_that_holds_the_points)
{
  View view;
  view.azimuth_deg = 20;
  view.elevation_deg = 35;
  Ply_cloud cloud = room(3, false);
  Camera camera = find_camera(cloud, view, 2);
  BOOST_TEST(std::abs(dot(camera.right, camera.up)) < 1e-12);
  BOOST_TEST(std::abs(dot(camera.to_viewer, camera.vertical) - std::sin(35 * pi / 180)) < 1e-12);
  BOOST_TEST(length(cross(camera.right, camera.up) - camera.to_viewer) < 1e-12);
  const Window& w = camera.window;
  BOOST_TEST((w.right - w.left) / (w.top - w.bottom) == 2.0, boost::test_tools::tolerance(1e-9));
  std::size_t outside = 0;
  for(const Vec& p : cloud.points) {
    double x = dot(p, camera.right), y = dot(p, camera.up);
    outside += x < w.left || x > w.right || y < w.bottom || y > w.top;
  }
  BOOST_TEST(100 * outside < cloud.points.size()); // nearly all
}

BOOST_AUTO_TEST_CASE(colors_follow_the_points)
{
  Detection first{{0, 0, 0, 1, 1, -1}, {{{0, 0, 1}, 0}, {{1, 0, 0}, 0}}};
  Detection renumbered{{1, 1, 1, 0, 0, 2}, {{{1, 0, 0}, 0}, {{0, 0, 1}, 0}, {{0, 1, 0}, 0}}};
  std::vector<Color> a = colors_of(first), b = colors_like(first, renumbered);
  BOOST_TEST((b[1] == a[0]));
  BOOST_TEST((b[0] == a[1]));
  BOOST_TEST((b[2] != a[0] && b[2] != a[1]));
  for(std::size_t i = 0; i < 300; ++i)
    for(std::size_t j = 0; j < i; ++j)
      BOOST_REQUIRE_MESSAGE(color_of_index(i) != color_of_index(j), i << " and " << j << " look alike");
}

BOOST_AUTO_TEST_CASE(shapes_clutter_and_violations_look_different)
{
  Ply_cloud cloud = room(3, false);
  Detection detection = detection_of(cloud);
  Scene_view view(cloud, {}, {160, 120});
  std::vector<Color> colors = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {0, 255, 255}};
  std::vector<bool> marks(cloud.points.size(), false);
  auto is_red = [](const Color& c) { return c[0] > 120 && c[1] < 60 && c[2] < 60; };
  Picture picture = view.draw(detection, colors, marks);
  BOOST_TEST(picture.width() == 160);
  std::size_t red = count(picture, is_red);
  BOOST_TEST(red > 1500u); // most of the floor
  BOOST_TEST(count(picture, is_dark) == 0u);
  for(std::size_t i = 0; i < marks.size(); ++i)
    marks[i] = detection.label[i] == 0;
  picture = view.draw(detection, colors, marks);
  BOOST_TEST(count(picture, is_red) == 0u);
  BOOST_TEST(count(picture, is_dark) > red / 2);
  std::fill(detection.label.begin(), detection.label.end(), -1);
  std::fill(marks.begin(), marks.end(), false);
  picture = view.draw(detection, colors, marks);
  BOOST_TEST(count(picture, [](const Color& c) { return c[0] != c[1] || c[1] != c[2]; }) == 0u);
}

BOOST_AUTO_TEST_CASE(side_by_side)
{
  Picture left(4, 2, {10, 20, 30}), right(2, 2, {1, 2, 3});
  Picture both = left.beside(right);
  BOOST_TEST(both.width() == 6);
  BOOST_TEST((both.at(3, 1) == Color{10, 20, 30}));
  BOOST_TEST((both.at(4, 0) == Color{1, 2, 3}));
  left.at(0, 0) = {50, 20, 30};
  BOOST_TEST((left.halved().at(0, 0) == Color{20, 20, 30}));
}

#endif
