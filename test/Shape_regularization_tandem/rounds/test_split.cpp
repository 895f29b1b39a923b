// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Splits against plain loops: which shapes split, which planes their parts have, and what becomes of points, shapes and
// lists. What a split gains is compared with the score before and after, of shapes that have to split: two layers, a
// roof of a small angle, faces of different normals. And some that must not.

#include "testing/body_fixture.h"
#include "testing/same_bits.h"

#include <CGAL/Tandem/internal/rounds/split_shapes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_split)

using namespace CGAL::Tandem::internal;
using namespace std::string_literals;

using Labels = std::vector<std::uint32_t>;

bool is_same(const Plane& a, const Plane& b) { return a.nx == b.nx && a.ny == b.ny && a.nz == b.nz && a.d == b.d; }

struct Slow_split {
  std::uint32_t id;
  Split best;
  bool is_accepted;
};

// The definition: all shapes that may split, by rising id.
std::vector<Slow_split> slow_splits(const Fixture& f, const std::vector<Shape>& shape, const Stage_parameters& options,
                                    std::uint32_t first)
{
  const Split_gain gain(options);
  std::vector<Slow_split> result;
  for(std::uint32_t id = 0; id < shape.size(); ++id) {
    if(!shape[id].is_live() || !gain.may_split(shape[id]))
      continue;
    std::vector<Sampled_point> sample;
    for(std::uint32_t i = 0; i < f.label.size(); ++i)
      if(f.label[i] == id && hash_of_position(first + i) <= sample_bound(shape[id], Split_gain::sample_size))
        sample.push_back({hash_of_position(first + i), f.level_of(i), f.point[i]});
    std::sort(sample.begin(), sample.end(), [](const auto& a, const auto& b) { return a.hash < b.hash; });
    Split best;
    for(int start = 0; start < Split_gain::starts; ++start) {
      const Split split = gain.trial(shape[id], {sample.data(), std::uint32_t(sample.size())}, start);
      if(split.gain > best.gain)
        best = split;
    }
    const auto is_second = [&](std::uint32_t i) { return is_nearer(best.second, best.first, f.point[i]); };
    std::int64_t cut = 0; // links between both parts
    for(std::uint32_t i = 0; i < f.label.size() && best.gain > 0; ++i)
      if(f.label[i] == id)
        f.for_each_neighbor(i, [&](std::uint32_t j) { cut += f.label[j] == id && is_second(i) != is_second(j); });
    // Half a point for all of a point.
    result.push_back({id, best, best.gain > cut * (Score::unit / 2) / f.cloud.k});
  }
  return result;
}

std::vector<Shape> fitted_shapes(const Fixture& f, std::size_t n)
{
  std::vector<Shape> shape = f.shapes_of_labels(n);
  for(Shape& s : shape)
    if(s.is_live())
      refit(s);
  return shape;
}

std::set<std::uint32_t> listed(const Cell_shapes& list)
{
  return std::set<std::uint32_t>(list.shape, list.shape + (std::min)(list.size, Cell_shapes::capacity));
}

// What follows from labels, which are those of the fixture.
template <class Backend>
void check_tables(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Fixture& f,
                  const std::string& where)
{
  CHECK_AT(shapes.has_moments(), where + ": moments have to be made again");
  update_tables(points, shapes, tables::fits | tables::lists);
  const std::vector<Shape> expected = fitted_shapes(f, shapes.size);
  for(std::uint32_t id = 0; id < shapes.size; ++id) {
    const Fitted_moments &got = shapes.fitted()[id], &e = expected[id];
    CHECK_AT(are_equal(got.moments, e.moments), where + ": moments of shape " + std::to_string(id));
    CHECK_AT(!expected[id].is_live() || CGAL::Tandem::internal::is_same(got.local, e.local),
             where + ": fit of shape " + std::to_string(id));
  }
  CHECK_AT(std::none_of(shapes.delta.begin(), shapes.delta.end(), is_any), where + ": deltas that stay");
  const std::vector<Cell_shapes> lists = f.list_shapes(f.label);
  for(std::size_t c = 0; c < lists.size(); ++c) {
    const bool is_listed = lists[c].size <= Cell_shapes::capacity;
    CHECK_AT((points.lists()[c].size <= Cell_shapes::capacity) == is_listed &&
               (!is_listed || listed(points.lists()[c]) == listed(lists[c])),
             where + ": list of cell " + std::to_string(c));
  }
}

// Shapes of the labels, on all back ends. There is no room for more of them. Returns how many split, and how many do
// not although they would gain by their planes.
std::array<int, 2> check_splits(const Fixture& f, std::uint32_t first)
{
  Stage_parameters options = Stage_parameters();
  options.score = Score(30, f.cloud.k);
  options.minimum_region_size = 30;
  options.maximum_distance_steps = double(f.tolerance.distance) / normal_scale;
  options.growth.tolerance = f.tolerance;
  const std::vector<Shape> shape = fitted_shapes(f, f.plane.size());
  const std::vector<Slow_split> expected = slow_splits(f, shape, options, first);
  Fixture after = f;
  std::array<int, 2> count = {0, 0};
  for(const Slow_split& s : expected) {
    count[s.is_accepted ? 0 : 1] += s.best.gain > 0;
    if(!s.is_accepted)
      continue;
    for(std::uint32_t i = 0; i < after.label.size(); ++i)
      if(after.label[i] == s.id && is_nearer(s.best.second, s.best.first, f.point[i]))
        after.label[i] = std::uint32_t(after.plane.size());
    after.plane[s.id] = s.best.first;
    after.plane.push_back(s.best.second);
  }
  on_body_backends([&](auto backend, const std::string& name) {
    const std::string where = name + ", " + f.name;
    Labeled_cloud<decltype(backend)> points(backend);
    take_cloud(f, points);
    points.cloud.first = first;
    set_labels(points, f.label, f.state);
    auto shapes = make_table(backend, shape);
    shapes.plane = to_buffer(backend, f.plane);
    update_tables(points, shapes, tables::fits | tables::lists);
    split_shapes(points, shapes, options);
    check_equal(shapes.size, after.plane.size(), where + ": number of shapes");
    if(shapes.size != after.plane.size())
      return;
    check_lists(to_vector(backend, points.label(), f.label.size()), after.label, where + ": labels");
    for(std::size_t id = 0; id < shapes.size; ++id)
      CHECK_AT(is_same(shapes.plane[id], after.plane[id]), where + ", shape " + std::to_string(id) + ": plane");
    check_tables(points, shapes, after, where);
  });
  return count;
}

// Shapes that have the points of two or three faces of a scene, or of one.
BOOST_AUTO_TEST_CASE(bodies)
{
  for(const Fixture& fixture : fixtures()) {
    int accepted = 0, refused = 0;
    for(std::uint32_t joined : {1u, 2u, 3u}) {
      Fixture f = fixture;
      for(std::uint32_t& s : f.label)
        s = s < first_mark ? s - s % joined : s;
      const auto count = check_splits(f, joined == 2 ? 0xfffffff1u : 0u);
      accepted += count[0];
      refused += count[1];
    }
    CHECK_AT(fixture.point.size() < 1000 || (accepted > 0 && refused > 0),
             fixture.name + ": " + std::to_string(accepted) + " splits, " + std::to_string(refused) + " refused");
  }
}

constexpr double epsilon = 60; // grid steps
constexpr std::int64_t minimum_size = 100;

Stage_parameters split_options(int k)
{
  Stage_parameters o = Stage_parameters();
  o.score = Score(std::uint64_t(minimum_size), k);
  o.minimum_region_size = minimum_size;
  o.maximum_distance_steps = epsilon;
  o.growth.tolerance = make_tolerance(epsilon, cosine_deg(25));
  return o;
}

// Points of a square. Heights and noise are in epsilons.
struct Scene {
  const char* name;
  int points;
  double width;
  double gap;   // between layers, of which the second one has two points of five
  double ridge; // over the eaves, where both faces meet
  double noise;
  bool is_sharp; // normals are those of the faces
  bool gains;    // without links

  std::vector<Grid_point> point = {};
  std::vector<int> face = {}; // by point; -1: either

  bool has_faces() const { return gap >= 1 || ridge > 0; }

  void make()
  {
    scenes::Random random(5);
    for(int i = 0; i < points; ++i) {
      const double x = random.uniform(), from_ridge = x - .5, slope = 2 * ridge * epsilon / width;
      face.push_back(ridge == 0 ? i % 5 < 2 : std::fabs(from_ridge) < .15 ? -1 : from_ridge > 0);
      const double z = face.back() * gap + ridge * (1 - std::fabs(2 * from_ridge)) + noise * random.gaussian();
      point.push_back({std::int32_t(width * x), std::int32_t(width * random.uniform()),
                       std::int32_t(std::lround(epsilon * z)),
                       encode_normal({!is_sharp        ? 0
                                      : from_ridge > 0 ? slope
                                                       : -slope,
                                      0, 1})});
    }
  }
};

// The definition of what a split gains, without links, in units of the score: as many points as the shape has are like
// those of the sample. And its standard deviation, which is 0 for all points.
std::pair<double, double> slow_gain(const std::vector<Sampled_point>& sample, const Shape& shape, const Split& split,
                                    const Stage_parameters& o)
{
  const auto weight = [&](const Plane& plane, const Grid_point& p) {
    const double d = double(signed_distance(plane, p)) / double(o.growth.tolerance.distance);
    return fits(plane, p, o.growth.tolerance) ? 1 - d * d : 0;
  };
  const auto bonus = [](double n) { return Parameters().simplicity * n * std::log2(n / double(minimum_size)); };
  const double n = double(shape.moments.count), scale = n / double(sample.size());
  double sum = 0, squares = 0, count[2] = {0, 0};
  for(const Sampled_point& s : sample) {
    const double first = std::fabs(double(signed_distance(split.first, s.point)));
    const bool second = std::fabs(double(signed_distance(split.second, s.point))) < first;
    const double w = weight(second ? split.second : split.first, s.point);
    const double change = w - weight(rounded(shape.local), s.point);
    sum += change;
    squares += change * change;
    count[second] += w > 0 ? scale : 0;
  }
  const double gain = scale * sum + bonus(count[0]) + bonus(count[1]) - bonus(n) - .3 * double(minimum_size);
  return {double(Score::unit) * (std::min(count[0], count[1]) < double(minimum_size) / 2 ? 0 : gain),
          double(Score::unit) * (scale > 1 ? scale * std::sqrt(squares) : 0)};
}

// Whether any start gains, by the first points of the scene. A gain has to be more than its standard deviation. The
// first part of the best split is the larger one; where there are faces, each part has the points of one.
bool gains(const Scene& scene, std::size_t sample_size)
{
  const Stage_parameters options = split_options(12);
  Shape shape;
  std::vector<Sampled_point> sample;
  for(const Grid_point& p : scene.point) {
    shape.moments.add(p);
    if(sample.size() < sample_size)
      sample.push_back({std::uint32_t(sample.size()), 0, p});
  }
  refit(shape);
  Split best;
  for(int start = 0; start < Split_gain::starts; ++start) {
    const Split split = Split_gain(options).trial(shape, {sample.data(), std::uint32_t(sample.size())}, start);
    if(split.gain == 0)
      continue;
    const auto [expected, deviation] = slow_gain(sample, shape, split, options);
    const std::string where = scene.name + (", start " + std::to_string(start));
    check_close(double(split.gain) / double(Score::unit), expected / double(Score::unit), 1e-3 * scene.points + 2,
                where + ": gain");
    CHECK_AT(expected > .99 * deviation, where + ": a gain that is not certain");
    if(split.gain > best.gain)
      best = split;
  }
  std::size_t of_face[2][2] = {{0, 0}, {0, 0}}, number[2] = {0, 0};
  for(std::size_t i = 0; i < scene.point.size(); ++i) {
    const bool is_second = is_nearer(best.second, best.first, scene.point[i]);
    ++number[is_second];
    if(scene.face[i] >= 0)
      ++of_face[is_second][scene.face[i]];
  }
  CHECK_AT(best.gain == 0 || 10 * number[0] > 9 * number[1], scene.name + ": the second part is larger"s);
  CHECK_AT(best.gain == 0 || !scene.has_faces() || of_face[0][1] + of_face[1][0] == 0 ||
             of_face[0][0] + of_face[1][1] == 0,
           scene.name + ": points in the part of the other face"s);
  return best.gain > 0;
}

BOOST_AUTO_TEST_CASE(scenes_of_two_faces)
{
  for(Scene scene : {Scene{"layers", 2000, 1000, 1.5, 0, .125, false, true},
                     {"large layers", 20000, 3000, 1.5, 0, .125, false, true},
                     {"a low roof", 2000, 4000, 0, 3, .125, false, true},
                     {"faces of different normals", 2000, 4000, 0, 20, .125, true, true},
                     {"a plane", 2000, 4000, 0, 0, .125, false, false},
                     {"a noisy plane", 2000, 4000, 0, 0, .3, false, true}, // links would cost more
                     {"near layers", 2000, 500, 1, 0, .125, false, true},
                     {"a small shape", int(minimum_size) - 2, 300, 1.5, 0, .125, false, false}}) {
    scene.make();
    for(std::size_t sample_size : {250u, 2000u})
      check_equal(gains(scene, sample_size), scene.gains,
                  scene.name + (": whether it gains, by " + std::to_string(sample_size)));
  }
}

// Of a small sample: not for all layers that gain.
BOOST_AUTO_TEST_CASE(certain_gains)
{
  int certain = 0;
  for(int gap = 30; gap < 150; gap += 3) {
    Scene scene = {"sampled layers", 1000, 1000, gap / 100., 0, .125, false, true};
    scene.make();
    certain += gains(scene, 60);
  }
  CHECK_AT(certain > 5 && certain < 40, std::to_string(certain) + " gains");
}

BOOST_AUTO_TEST_SUITE_END()
