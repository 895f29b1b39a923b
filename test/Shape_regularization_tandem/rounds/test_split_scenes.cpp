// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shapes that have to split: two layers, a roof of a small angle, faces of different normals. And some that must not: a
// noisy plane, and layers whose points interleave, since the links between them cost more. On all back ends of the
// host, and in any order of the points. What a split gains is compared with the score before and after.

#include "testing/body_fixture.h"
#include "testing/host_backends.h"

#include <CGAL/Tandem/internal/rounds/split_shapes.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_split_scenes)

using namespace CGAL::Tandem::internal;

constexpr double epsilon = 60; // grid steps
constexpr std::int64_t minimum_size = 100;

Options split_options(int k)
{
  Options o = Options();
  o.score = Score(std::uint64_t(minimum_size), k);
  o.minimum_region_size = minimum_size;
  o.maximum_distance = epsilon;
  o.growth.tolerance = make_tolerance(epsilon, cosine_deg(25));
  return o;
}

// A point, and the face that it belongs to; -1: either.
struct Truth {
  Grid_point point;
  int face;
};

using Scene = std::vector<Truth>;

class Generator {
public:
  double uniform() { return double(random_() >> 8) / (1 << 24); }
  double gaussian() // of variance 1, about
  {
    double sum = -6;
    for(int i = 0; i < 12; ++i)
      sum += uniform();
    return sum;
  }

private:
  std::mt19937 random_{5};
};

// n points of a square of the given side, z = height(x, face). The second face has two points of five.
template <class F>
Scene make_faces(int n, double side, F height)
{
  Generator random;
  Scene scene;
  for(int i = 0; i < n; ++i) {
    const double x = side * random.uniform(), y = side * random.uniform();
    Truth t = {{std::int32_t(x), std::int32_t(y), 0, encode_normal({0, 0, 1})}, i % 5 < 2};
    t.point.z = std::int32_t(std::lround(height(x, t.face) + epsilon / 8 * random.gaussian()));
    scene.push_back(t);
  }
  return scene;
}

Scene make_layers(int n, double side, double gap)
{
  return make_faces(n, side, [gap](double, int face) { return face * gap * epsilon; });
}

Scene make_noisy(int n, double side, double noise)
{
  Generator random;
  return make_faces(n, side, [&](double, int) { return noise * epsilon * random.gaussian(); });
}

// The heights of the ridge over the eaves in epsilons. Points near the ridge belong to either side.
Scene make_roof(int n, double side, double height)
{
  Scene scene =
    make_faces(n, side, [=](double x, int) { return height * epsilon * (1 - std::fabs(2 * x / side - 1)); });
  for(Truth& t : scene) {
    const double from_ridge = double(t.point.x) / side - .5;
    t.face = std::fabs(from_ridge) < .15 ? -1 : from_ridge > 0;
  }
  return scene;
}

// The ridge is sharp, and normals are those of the faces.
Scene make_edge(int n, double side)
{
  Scene scene = make_roof(n, side, 20);
  const double slope = 40 * epsilon / side;
  for(Truth& t : scene)
    t.point.normal = encode_normal({2 * t.point.x > side ? slope : -slope, 0, 1});
  return scene;
}

struct Sorted_scene {
  Fixture fixture; // all points have label 0
  std::vector<int> face;
};

Sorted_scene sorted(const Scene& scene, int k)
{
  std::vector<Grid_point> unsorted;
  for(const Truth& t : scene)
    unsorted.push_back(t.point);
  Sorted_scene s;
  Sequential_backend backend;
  const Code_frame frame = make_code_frame(unsorted.data(), unsorted.size());
  auto order = sort_along_curve(backend, {unsorted.data(), unsorted.size()}, frame);
  s.fixture.cells = split_cells(backend, order, frame, 512);
  for(const Host_sort_table::Entry& o : order) {
    s.fixture.point.push_back(unsorted[o.index]);
    s.face.push_back(scene[o.index].face);
  }
  s.fixture.label.assign(scene.size(), 0);
  s.fixture.neighbor.resize(scene.size() * std::size_t(k));
  find_neighbors(backend, s.fixture.point.data(), std::uint32_t(scene.size()), k, s.fixture.neighbor.data());
  s.fixture.cloud = {s.fixture.point.data(),
                     s.fixture.neighbor.data(),
                     std::uint32_t(scene.size()),
                     k,
                     {s.fixture.point.data(), nullptr, nullptr}};
  return s;
}

// The labels after a call, where all points had one shape.
template <class Backend>
std::vector<std::uint32_t> labels_after(Backend& backend, const Fixture& f)
{
  Labeled_cloud<Backend> points(backend);
  take_cloud(f, points);
  set_labels(points, f.label);
  Shape_table<Backend> shapes = make_table(backend, f.shapes_of_labels(1));
  shapes.plane = filled_buffer(backend, 1, Plane());
  split_shapes(points, shapes, split_options(f.cloud.k));
  return to_vector(backend, points.label(), f.label.size());
}

// Whether the shape splits; then each part has a face, and the larger one keeps the id.
void test(const std::string& name, Scene scene, bool splits)
{
  std::mt19937 random(3);
  for(bool is_shuffled : {false, true}) {
    if(is_shuffled)
      std::shuffle(scene.begin(), scene.end(), random);
    const Sorted_scene s = sorted(scene, 12);
    on_host_backends([&](auto backend, const std::string& of) {
      const std::string where = name + ", " + of + (is_shuffled ? ", shuffled" : "");
      const std::vector<std::uint32_t> label = labels_after(backend, s.fixture);
      std::size_t of_face[2][2] = {{0, 0}, {0, 0}}, other = 0;
      for(std::size_t i = 0; i < label.size(); ++i)
        if(label[i] > 1)
          ++other;
        else if(s.face[i] >= 0)
          ++of_face[label[i]][s.face[i]];
      check_equal(other, std::size_t(0), where + ": other labels");
      const bool is_straight = of_face[0][1] + of_face[1][0] == 0, is_crossed = of_face[0][0] + of_face[1][1] == 0;
      check_equal(std::size_t(std::count(label.begin(), label.end(), 1u)) > 0, splits, where + ": whether it splits");
      CHECK_AT(!splits || is_straight || is_crossed, where + ": points in the part of the other face");
      const std::size_t kept = of_face[0][0] + of_face[0][1], moved = of_face[1][0] + of_face[1][1];
      CHECK_AT(10 * kept > 9 * moved, where + ": the smaller part keeps the id");
    });
  }
}

// The definition of what a split gains, by all points of a small shape; without links. In units of the score.
double slow_gain(const std::vector<Sampled_point>& sample, const Plane& before, const Split& split, const Options& o)
{
  const auto weight = [&](const Plane& plane, const Grid_point& p) {
    const double d = double(signed_distance(plane, p)) / double(o.growth.tolerance.distance);
    return fits(plane, p, o.growth.tolerance) ? 1 - d * d : 0;
  };
  const auto bonus = [](double n) { return Parameters().simplicity * n * std::log2(n / double(minimum_size)); };
  double gain = 0, count[2] = {0, 0};
  for(const Sampled_point& s : sample) {
    const double first = std::fabs(double(signed_distance(split.first, s.point)));
    const bool second = std::fabs(double(signed_distance(split.second, s.point))) < first;
    const double w = weight(second ? split.second : split.first, s.point);
    gain += w - weight(before, s.point);
    count[second] += w > 0;
  }
  gain += bonus(count[0]) + bonus(count[1]) - bonus(double(sample.size())) - .3 * double(minimum_size);
  return std::min(count[0], count[1]) < double(minimum_size) / 2 ? 0 : double(Score::unit) * gain;
}

void test_gain(const std::string& name, const Scene& scene, bool is_any)
{
  const Options options = split_options(12);
  const Split_gain gain(options);
  Shape shape;
  std::vector<Sampled_point> sample;
  for(const Truth& t : scene) {
    shape.moments.add(t.point);
    sample.push_back({std::uint32_t(sample.size()), 0, t.point});
  }
  refit(shape);
  double most = 0;
  for(int start = 0; start < Split_gain::starts; ++start) {
    const Split split = gain.trial(shape, {sample.data(), std::uint32_t(sample.size())}, start);
    if(split.gain == 0)
      continue;
    const double expected = slow_gain(sample, rounded(shape.local), split, options);
    check_close(double(split.gain), expected, 1e-3 * double(Score::unit * minimum_size),
                name + ": gain of start " + std::to_string(start));
    most = (std::max)(most, double(split.gain));
  }
  check_equal(most > 0, is_any, name + ": whether a split gains");
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  test("layers", make_layers(2000, 1000, 1.5), true);
  test("large layers", make_layers(20000, 3000, 1.5), true);
  test("a low roof", make_roof(2000, 4000, 3), true);
  test("faces of different normals", make_edge(2000, 4000), true);
  test("a plane", make_noisy(2000, 4000, 0), false);
  test("a noisy plane", make_noisy(2000, 4000, 1. / 3), false);
  // Each gains by its planes; in a thin cloud, half of the neighbors are in the other layer.
  test("near layers", make_layers(2000, 500, 1), true);
  test("layers that interleave", make_layers(2000, 20000, 1), false);
  test("a small shape", make_layers(int(minimum_size) - 2, 300, 1.5), false);

  test_gain("layers", make_layers(250, 1000, 1.5), true);
  test_gain("a low roof", make_roof(250, 4000, 3), true);
  test_gain("a noisy plane", make_noisy(250, 4000, 1. / 3), false);
  test_gain("too few points", make_layers(90, 1000, 1.5), false);
}

BOOST_AUTO_TEST_SUITE_END()
