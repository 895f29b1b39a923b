// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Splits against plain loops: which shapes split, which planes their parts have, and what becomes of points, shapes and
// lists. Then shapes that have to split: two layers, a roof of a small angle, faces of different normals. And some that
// must not: a noisy plane, and layers whose points interleave, since the links between them cost more. What a split
// gains is compared with the score before and after.

#include "testing/body_fixture.h"
#include "testing/same_bits.h"

#include <CGAL/Tandem/internal/rounds/split_shapes.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_split)

using namespace CGAL::Tandem::internal;

using Labels = std::vector<std::uint32_t>;
using Sample = std::vector<Sampled_point>;

bool is_same(const Plane& a, const Plane& b) { return a.nx == b.nx && a.ny == b.ny && a.nz == b.nz && a.d == b.d; }

struct Slow_split {
  std::uint32_t id;
  Split best;
  std::uint64_t cut; // links between both parts
  bool is_accepted;
};

// The definition, shape by shape.
class Slow_splits {
public:
  Slow_splits(const Fixture& f, const Labels& label, const Options& options, std::uint32_t first)
    : f_(f), label_(label), gain_(options), first_(first)
  {}

  // Of all shapes that may split, by rising id.
  std::vector<Slow_split> find(const std::vector<Shape>& shape) const
  {
    std::vector<Slow_split> result;
    for(std::uint32_t id = 0; id < shape.size(); ++id) {
      if(!shape[id].is_live() || !gain_.may_split(shape[id]))
        continue;
      const Split best = best_of(shape[id], sample_of(shape[id], id));
      const std::uint64_t cut = best.gain > 0 ? links(id, best) : 0;
      const std::int64_t cost = std::int64_t(cut) * (Score::unit / 2) / f_.cloud.k; // half a point for all of a point
      result.push_back({id, best, cut, best.gain > cost});
    }
    return result;
  }

private:
  Sample sample_of(const Shape& shape, std::uint32_t id) const
  {
    Sample sample;
    for(std::uint32_t i = 0; i < label_.size(); ++i) {
      const std::uint32_t hash = hash_of_position(first_ + i);
      if(label_[i] == id && hash <= sample_bound(shape, Split_gain::sample_size))
        sample.push_back({hash, f_.level_of(i), f_.point[i]});
    }
    std::sort(sample.begin(), sample.end(), [](const auto& a, const auto& b) { return a.hash < b.hash; });
    return sample;
  }

  Split best_of(const Shape& shape, const Sample& sample) const
  {
    Split best;
    for(int start = 0; start < Split_gain::starts; ++start) {
      const Split split = gain_.trial(shape, {sample.data(), std::uint32_t(sample.size())}, start);
      if(split.gain > best.gain)
        best = split;
    }
    return best;
  }

  std::uint64_t links(std::uint32_t id, const Split& split) const
  {
    std::uint64_t result = 0;
    for(std::uint32_t i = 0; i < label_.size(); ++i)
      if(label_[i] == id)
        f_.for_each_neighbor(i, [&](std::uint32_t j) {
          result += label_[j] == id && is_nearer(split.second, split.first, f_.point[i]) !=
                                         is_nearer(split.second, split.first, f_.point[j]);
        });
    return result;
  }

  const Fixture& f_;
  const Labels& label_;
  Split_gain gain_;
  std::uint32_t first_;
};

std::vector<Shape> fitted_shapes(const Fixture& f, std::size_t n)
{
  std::vector<Shape> shape = f.shapes_of_labels(n);
  for(Shape& s : shape)
    if(s.is_live())
      refit(s);
  return shape;
}

template <class Found>
void check_found(const Found& found, const std::vector<Slow_split>& expected, const std::string& where)
{
  std::vector<std::uint32_t> id, accepted;
  for(std::size_t i = 0; i < expected.size(); ++i) {
    id.push_back(expected[i].id);
    if(expected[i].is_accepted)
      accepted.push_back(std::uint32_t(i));
  }
  check_lists({found.id.begin(), found.id.end()}, id, where + ": shapes that may split");
  check_lists({found.accepted.begin(), found.accepted.end()}, accepted, where + ": shapes that split");
  for(std::size_t i = 0; i < expected.size() && i < found.id.size(); ++i) {
    const Split &got = found.split[i * Split_gain::starts], &best = expected[i].best;
    const std::string at = where + ", shape " + std::to_string(expected[i].id);
    check_equal(got.gain, best.gain, at + ": gain");
    CHECK_AT(best.gain == 0 || (is_same(got.first, best.first) && is_same(got.second, best.second)), at + ": planes");
  }
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
  require(points, shapes, tables::fits | tables::lists);
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

// Shapes of the labels, on all back ends. There is no room for more of them. Returns how many split, and how many do not
// although they would gain by their planes.
std::array<int, 2> check_splits(const Fixture& f, std::uint32_t first)
{
  Options options = Options();
  options.score = Score(30, f.cloud.k);
  options.minimum_region_size = 30;
  options.maximum_distance = double(f.tolerance.distance) / normal_scale;
  options.growth.tolerance = f.tolerance;
  const std::vector<Shape> shape = fitted_shapes(f, f.plane.size());
  const std::vector<Slow_split> expected = Slow_splits(f, f.label, options, first).find(shape);
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
    require(points, shapes, tables::fits | tables::lists);
    check_found(find_splits(points, shapes, options), expected, where);
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

// Whether the shape of all points splits; then each part has a face, and the larger one keeps the id.
void check_scene(const std::string& name, const Scene& scene, bool splits)
{
  std::vector<Grid_point> unsorted;
  for(const Truth& t : scene)
    unsorted.push_back(t.point);
  Fixture f;
  const std::vector<std::size_t> order = set_points(f, unsorted, 12, 512);
  f.label.assign(scene.size(), 0);
  on_body_backends([&](auto backend, const std::string& of) {
    const std::string where = name + ", " + of;
    Labeled_cloud<decltype(backend)> points(backend);
    take_cloud(f, points);
    set_labels(points, f.label);
    auto shapes = make_table(backend, f.shapes_of_labels(1));
    shapes.plane = filled_buffer(backend, 1, Plane());
    split_shapes(points, shapes, split_options(f.cloud.k));
    const Labels label = to_vector(backend, points.label(), f.label.size());
    std::size_t of_face[2][2] = {{0, 0}, {0, 0}};
    for(std::size_t i = 0; i < label.size(); ++i) {
      CHECK_AT(label[i] <= 1, where + ": another label");
      const int face = scene[order[i]].face;
      if(label[i] <= 1 && face >= 0)
        ++of_face[label[i]][face];
    }
    const bool is_straight = of_face[0][1] + of_face[1][0] == 0, is_crossed = of_face[0][0] + of_face[1][1] == 0;
    check_equal(std::count(label.begin(), label.end(), 1u) > 0, splits, where + ": whether it splits");
    CHECK_AT(!splits || is_straight || is_crossed, where + ": points in the part of the other face");
    const std::size_t kept = of_face[0][0] + of_face[0][1], moved = of_face[1][0] + of_face[1][1];
    CHECK_AT(10 * kept > 9 * moved, where + ": the smaller part keeps the id");
  });
}

BOOST_AUTO_TEST_CASE(scenes_of_two_faces)
{
  check_scene("layers", make_layers(2000, 1000, 1.5), true);
  check_scene("large layers", make_layers(20000, 3000, 1.5), true);
  check_scene("a low roof", make_roof(2000, 4000, 3), true);
  check_scene("faces of different normals", make_edge(2000, 4000), true);
  check_scene("a plane", make_noisy(2000, 4000, 0), false);
  check_scene("a noisy plane", make_noisy(2000, 4000, 1. / 3), false);
  // Each gains by its planes; in a thin cloud, half of the neighbors are in the other layer.
  check_scene("near layers", make_layers(2000, 500, 1), true);
  check_scene("layers that interleave", make_layers(2000, 20000, 1), false);
  check_scene("a small shape", make_layers(int(minimum_size) - 2, 300, 1.5), false);
}

// The definition of what a split gains, without links, in units of the score: as many points as the shape has are like
// those of the sample. And its standard deviation, which is 0 for all points.
std::pair<double, double> slow_gain(const std::vector<Sampled_point>& sample, const Shape& shape, const Split& split,
                                    const Options& o)
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

// The largest gain of any start, by the first points of the scene.
double largest_gain(const std::string& name, const Scene& scene, std::size_t sample_size)
{
  const Options options = split_options(12);
  const Split_gain gain(options);
  Shape shape;
  std::vector<Sampled_point> sample;
  for(const Truth& t : scene) {
    shape.moments.add(t.point);
    if(sample.size() < sample_size)
      sample.push_back({std::uint32_t(sample.size()), 0, t.point});
  }
  refit(shape);
  double most = 0;
  for(int start = 0; start < Split_gain::starts; ++start) {
    const Split split = gain.trial(shape, {sample.data(), std::uint32_t(sample.size())}, start);
    if(split.gain == 0)
      continue;
    const auto [expected, deviation] = slow_gain(sample, shape, split, options);
    check_close(double(split.gain), expected, 2e-2 * double(Score::unit * minimum_size),
                name + ": gain of start " + std::to_string(start));
    CHECK_AT(expected > .99 * deviation, name + ": a gain that is not certain");
    most = (std::max)(most, double(split.gain));
  }
  return most;
}

BOOST_AUTO_TEST_CASE(gain)
{
  CHECK(largest_gain("layers", make_layers(250, 1000, 1.5), 250) > 0);
  CHECK(largest_gain("a low roof", make_roof(250, 4000, 3), 250) > 0);
  CHECK(largest_gain("a noisy plane", make_noisy(250, 4000, 1. / 3), 250) == 0);
  CHECK(largest_gain("too few points", make_layers(90, 1000, 1.5), 90) == 0);
}

// Of a sample, a gain counts where it is more than its standard deviation: not for all layers that gain.
BOOST_AUTO_TEST_CASE(certain_gains)
{
  int certain = 0;
  for(int gap = 30; gap < 150; gap += 3)
    certain += largest_gain("sampled layers", make_layers(1000, 1000, gap / 100.), 60) > 0;
  CHECK_AT(certain > 5 && certain < 40, std::to_string(certain) + " gains");
}

BOOST_AUTO_TEST_SUITE_END()
