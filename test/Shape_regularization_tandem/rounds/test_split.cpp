// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Splits against plain loops: parts and what they change, which shapes split, which planes their parts have, and what
// becomes of points, shapes and lists. Of layers and steps, which have to split, and of faces that must not.

#include "testing/body_fixture.h"
#include "testing/same_bits.h"

#include <CGAL/Tandem/internal/rounds/split_shapes.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_split)

using namespace CGAL::Tandem::internal;
using namespace std::string_literals;

using Labels = std::vector<std::uint32_t>;

// The definition of one trial, by surfels that stand for these numbers of points.
struct Slow_trial {
  std::vector<char> nearest, smooth; // whether a surfel is in the second part
  Split_account account;

  Slow_trial(const Fixture& f, std::uint32_t id, const Split& split, const std::vector<std::uint32_t>& points)
    : nearest(f.label.size(), 0)
  {
    const auto distance = [&](const Plane& p, std::uint32_t i) { return std::abs(signed_distance(p, f.point[i])); };
    for(std::uint32_t i = 0; i < f.label.size(); ++i)
      nearest[i] = f.label[i] == id && distance(split.second, i) < distance(split.first, i);
    smooth = nearest;
    for(std::uint32_t i = 0; i < f.label.size(); ++i) {
      int number[2] = {0, 0};
      f.for_each_neighbor(i, [&](std::uint32_t q) { number[int(nearest[q])] += f.label[q] == id; });
      if(f.label[i] == id && number[0] != number[1])
        smooth[i] = number[1] > number[0];
    }
    const auto weight = [&](const Plane& p, std::uint32_t i) {
      const Tolerance t = f.tolerance_of(i);
      return fits(p, f.point[i], t) ? Score::weight(t, signed_distance(p, f.point[i])) : 0;
    };
    for(std::uint32_t i = 0; i < f.label.size(); ++i) {
      if(f.label[i] != id)
        continue;
      account.fit += points[i] * (weight(smooth[i] ? split.second : split.first, i) - weight(f.plane[id], i));
      account.second += smooth[i] ? points[i] : 0;
      f.for_each_neighbor(
        i, [&](std::uint32_t q) { account.links += f.label[q] == id && smooth[q] != smooth[i] ? points[i] : 0; });
    }
  }

  std::int64_t gain(const Stage_parameters& options) const
  {
    return account.fit + options.score.price() + options.score.links(account.links);
  }
};

struct Slow_split {
  std::uint32_t id;
  Split best;
  std::int64_t gain;
};

std::vector<Sampled_point> sample_of(const Fixture& f, const Shape& shape, std::uint32_t id, std::uint32_t first)
{
  std::vector<Sampled_point> sample;
  for(std::uint32_t i = 0; i < f.label.size(); ++i)
    if(f.label[i] == id && hash_of_position(first + i) <= sample_bound(shape, Split_trials::sample_size))
      sample.push_back({hash_of_position(first + i), f.level_of(i), f.point[i]});
  std::sort(sample.begin(), sample.end(), [](const auto& a, const auto& b) { return a.hash < b.hash; });
  return sample;
}

// All shapes that may split, by rising id: those whose squared distances count more than the price of a shape.
std::vector<Slow_split> slow_splits(const Fixture& f, const std::vector<Shape>& shape, const Stage_parameters& options,
                                    std::uint32_t first)
{
  const Split_trials trials(options);
  const std::vector<std::uint32_t> ones(f.label.size(), 1);
  std::vector<Slow_split> result;
  for(std::uint32_t id = 0; id < shape.size(); ++id) {
    double squares = 0;
    for(std::uint32_t i = 0; i < f.label.size(); ++i)
      if(f.label[i] == id) {
        const double d = double(signed_distance(rounded(shape[id].local), f.point[i])) / double(f.tolerance.distance);
        squares += d * d;
      }
    const double price = .3 * double(options.minimum_region_size);
    const bool may_split = shape[id].is_live() && trials.may_split(shape[id]);
    CHECK_AT(!f.level.empty() || may_split == (squares > price) || std::fabs(squares - price) < .01 * price,
             f.name + ": whether a shape may split");
    if(!may_split)
      continue;
    const std::vector<Sampled_point> sample = sample_of(f, shape[id], id, first);
    Slow_split best = {id, {}, std::numeric_limits<std::int64_t>::min()};
    for(int start = 0; start < Split_trials::starts; ++start) {
      Split split = trials(shape[id], {sample.data(), std::uint32_t(sample.size())}, start);
      const Slow_trial trial(f, id, split, ones);
      const std::int64_t gain = trial.gain(options);
      if(2 * trial.account.second > shape[id].moments.count)
        std::swap(split.first, split.second);
      if(split.is_any() && gain > best.gain)
        best = {id, split, gain};
    }
    result.push_back(best);
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

// What follows from labels, which are those of the fixture.
template <class Backend>
void check_tables(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Fixture& f,
                  const std::string& where)
{
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

Stage_parameters split_options(const Fixture& f, std::int64_t minimum_size)
{
  Stage_parameters o = Stage_parameters();
  o.score = Score(std::uint64_t(minimum_size), f.cloud.k);
  o.minimum_region_size = minimum_size;
  o.maximum_distance_steps = double(f.tolerance.distance) / normal_scale;
  o.growth.tolerance = f.tolerance;
  return o;
}

// Shapes of the labels, on all back ends. There is no room for more of them. Returns how many of those that may split
// do, and how many do not.
std::array<int, 2> check_splits(const Fixture& f, std::uint32_t first)
{
  const Stage_parameters options = split_options(f, 30);
  const std::vector<Shape> shape = fitted_shapes(f, f.plane.size());
  const std::vector<Slow_split> expected = slow_splits(f, shape, options, first);
  Fixture after = f;
  std::array<int, 2> count = {0, 0};
  for(const Slow_split& s : expected) {
    ++count[s.gain > 0 ? 0 : 1];
    if(s.gain <= 0)
      continue;
    for(std::uint32_t i = 0; i < after.label.size(); ++i)
      if(after.label[i] == s.id && Nearer_plane(s.best, f.point[i]).is_second)
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
      CHECK_AT(shapes.plane[id] == after.plane[id], where + ", shape " + std::to_string(id) + ": plane");
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

// Parts, smoothed ones, and accounts of all trials. Every second shape is a candidate; surfels stand for up to three
// points.
BOOST_AUTO_TEST_CASE(parts_and_accounts)
{
  constexpr std::uint32_t starts = Split_trials::starts;
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    const std::uint32_t n = f.cloud.size, shapes = std::uint32_t(f.plane.size());
    std::vector<std::uint32_t> points, first = {0}, candidate_of;
    for(std::uint32_t i = 0; i < n; ++i) {
      points.push_back(1 + i % 3);
      first.push_back(first.back() + points.back());
    }
    std::vector<Split> split;
    std::vector<Split_account> expected;
    std::vector<std::uint8_t> nearest(n, 0), smooth(n, 0);
    for(std::uint32_t s = 0; s < shapes; ++s) {
      candidate_of.push_back(s % 2 == 0 ? s / 2 : no_index);
      for(std::uint32_t t = 0; s % 2 == 0 && t < starts; ++t) {
        Split planes = {f.plane[s], f.plane[t < 2 ? s : (s + t) % shapes]};
        planes.second.d += f.tolerance.distance / 3 * (t + 1);
        split.push_back(planes);
        const Slow_trial slow(f, s, planes, points);
        expected.push_back(slow.account);
        for(std::uint32_t i = 0; i < n; ++i) {
          nearest[i] = std::uint8_t(nearest[i] | slow.nearest[i] << t);
          smooth[i] = std::uint8_t(smooth[i] | slow.smooth[i] << t);
        }
      }
    }
    Cloud_view cloud = f.cloud;
    cloud.surfels.first = first.data();
    std::vector<std::uint8_t> parts(n), left(split.size() / starts, 255);
    std::vector<std::int64_t> most(split.size());
    std::vector<Split_account> got(split.size());
    const std::size_t cells = 3 * f.cells.size();
    const Candidates_view view = {cloud,          {f.cells.data(), f.lists.data(), 3},
                                  f.label.data(), candidate_of.data(),
                                  split.data(),   left.data(),
                                  f.plane.data(), f.tolerance};
    using Backend = decltype(backend);
    backend.template for_each_cell<No_scratch>(cells, Choose_parts<Backend>{view, parts.data(), most.data()});
    check_lists(parts, nearest, name + ": parts");
    backend.for_each(n, Smooth_parts{view, nearest.data(), parts.data()});
    for(std::uint32_t i = 0; i < n; ++i) // of others, they do not matter
      CHECK_AT(parts[i] == smooth[i] || f.label[i] >= first_mark || f.label[i] % 2 != 0, name + ": smoothed parts");
    CHECK_AT(n < 100 || smooth != nearest, name + ": nothing to smooth");
    if(!left.empty())
      left[0] = 0;
    backend.template for_each_cell<No_scratch>(cells, Sum_accounts<Backend>{view, parts.data(), got.data()});
    for(std::size_t t = 0; t < got.size(); ++t) {
      const std::string where = name + ", trial " + std::to_string(t) + ": ";
      CHECK_AT(most[t] >= expected[t].fit, where + "bound of the fit");
      if(t < starts) {
        check_equal(got[t].fit, std::int64_t(0), where + "fit of a trial that is left out");
        check_equal(got[t].links, std::int64_t(0), where + "links of a trial that is left out");
        continue;
      }
      check_equal(got[t].fit, expected[t].fit, where + "fit");
      check_equal(got[t].second, expected[t].second, where + "points of the second part");
      check_equal(got[t].links, expected[t].links, where + "links");
    }
  });
}

constexpr double epsilon = 60; // grid steps

// Points of a rectangle. Heights and noise are in epsilons; faces are layers, or side by side.
struct Scene {
  const char* name;
  int points;
  double width, depth;
  double step; // of the second face, which has less points
  double bend; // of the second half
  double noise;
  enum Place { over, right, behind, middle } place;
  bool splits;

  int face(int i, double x, double y) const
  {
    return place == over ? i % 5 < 2 : place == middle ? std::fabs(x - .5) < .2 : (place == right ? x : y) > .52;
  }
};

// A shape that has all points: it splits into the faces of the scene, or stays whole.
BOOST_AUTO_TEST_CASE(scenes_of_two_faces)
{
  for(const Scene& scene : {Scene{"layers", 4000, 1500, 1500, 1.1, 0, 1 / 3., Scene::over, true},
                            {"a step", 4000, 4000, 2000, 1.1, 0, 1 / 3., Scene::right, true},
                            {"a step across", 4000, 4000, 2000, 1.1, 0, 1 / 3., Scene::behind, true},
                            {"a groove", 4000, 4000, 2000, 1.1, 0, 1 / 3., Scene::middle, true},
                            {"a slight bend", 40000, 8000, 8000, 0, .8, .1, Scene::over, false},
                            {"a plane", 4000, 4000, 4000, 0, 0, .1, Scene::over, false},
                            {"a noisy plane", 4000, 4000, 4000, 0, 0, 1 / 3., Scene::over, false}}) {
    scenes::Random random(5);
    std::vector<Grid_point> unsorted;
    std::vector<int> face;
    for(int i = 0; i < scene.points; ++i) {
      const double x = random.uniform(), y = random.uniform();
      face.push_back(scene.face(i, x, y));
      const double z = face.back() * scene.step + (std::max)(0., x - .5) * 2 * scene.bend;
      unsorted.push_back({std::int32_t(scene.width * x), std::int32_t(scene.depth * y),
                          std::int32_t(std::lround(epsilon * (z + scene.noise * random.gaussian()))),
                          encode_normal({0, 0, 1})});
    }
    Fixture f;
    const std::vector<std::size_t> order = set_points(f, unsorted, 12, 8192);
    f.label.assign(order.size(), 0);
    f.tolerance = make_tolerance(epsilon, cosine_deg(25));
    const Stage_parameters options = split_options(f, 100);
    Sequential_backend backend;
    Labeled_cloud<Sequential_backend> points(backend);
    take_cloud(f, points);
    set_labels(points, f.label);
    auto shapes = make_table(backend, fitted_shapes(f, 1));
    shapes.plane = to_buffer(backend, std::vector<Plane>(1, rounded(shapes.table()[0].local)));
    if(!scene.splits && scene.bend == 0) { // by the sample
      const Shape& shape = shapes.table()[0];
      const std::vector<Sampled_point> sample = sample_of(f, shape, 0, 0);
      int tried = 0;
      for(int start = 0; start < Split_trials::starts; ++start)
        tried += Split_trials(options)(shape, {sample.data(), std::uint32_t(sample.size())}, start).is_any();
      CHECK_AT(tried <= 2, scene.name + ": noise is tried by all points"s);
    }
    split_shapes(points, shapes, options);
    check_equal(shapes.size, scene.splits ? 2u : 1u, scene.name + ": shapes"s);
    std::size_t number[2] = {0, 0}, true_ones = 0;
    for(std::size_t i = 0; i < order.size(); ++i) {
      ++number[points.label()[i]];
      true_ones += int(points.label()[i]) == face[order[i]];
    }
    const std::size_t of_faces = (std::max)(true_ones, order.size() - true_ones);
    CHECK_AT(!scene.splits || (10 * of_faces > 9 * order.size() && 10 * number[0] > 9 * number[1]),
             scene.name + ": parts"s);
  }
}

BOOST_AUTO_TEST_SUITE_END()
