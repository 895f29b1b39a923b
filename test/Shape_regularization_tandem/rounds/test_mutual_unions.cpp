// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unions of shapes. Their gain beside the definition, in double, where samples have all points, also of points with one
// tolerance of their own; of a step and of a bend. The samples. The rounds of mutual choice beside a slow definition,
// which fits every link anew in every round, in any order of the links.

#include "testing/body_fixture.h"
#include "testing/same_bits.h"

#include <CGAL/Tandem/internal/rounds/Shape_samples.h>
#include <CGAL/Tandem/internal/rounds/merge_shapes.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_mutual_unions)

using namespace CGAL::Tandem::internal;

using Grid_points = std::vector<Grid_point>;
using Links = std::vector<Link>;

constexpr double epsilon = 60; // in grid steps

const std::uint32_t upright = encode_normal({0, 0, 1});

Stage_parameters union_options(std::int64_t minimum_size = 100)
{
  Stage_parameters o = Stage_parameters();
  o.score = Score(std::uint64_t(minimum_size), 12);
  o.minimum_region_size = minimum_size;
  o.maximum_distance_steps = epsilon;
  o.growth.tolerance = make_tolerance(epsilon, cosine_deg(25));
  return o;
}

// By both steps of the test.
double gain_of(const Union_gain& gain, const Sampled_shape& a, const Sampled_shape& b, const Contact& contact)
{
  return gain.may_gain(a.fitted, b.fitted, contact) ? gain(a, b, contact) : 0;
}

// A contact of so many links at one place.
Contact contact_of(std::uint64_t links, const Grid_point& at)
{
  Contact contact;
  contact.add(links, at);
  return contact;
}

// The least hashes of all these.
Shape_sample least_of(std::vector<Sampled_point> all)
{
  std::sort(all.begin(), all.end(), [](const Sampled_point& a, const Sampled_point& b) { return a.hash < b.hash; });
  Shape_sample sample = Shape_sample();
  for(; sample.size < all.size() && sample.size < Shape_sample::capacity; ++sample.size)
    sample.item[sample.size] = all[sample.size];
  return sample;
}

bool are_equal(const Shape_sample& a, const Shape_sample& b)
{
  return a.size == b.size && std::equal(a.item, a.item + a.size, b.item, [](const auto& p, const auto& q) {
           return p.hash == q.hash && p.level == q.level && p.point.x == q.point.x && p.point.y == q.point.y &&
                  p.point.z == q.point.z;
         });
}

// Points of one shape, all of one tolerance.
struct Fragment {
  Grid_points point;
  Fitted_moments fitted;
  Shape_sample sample;

  // Positions of points are consecutive.
  void finish(std::uint32_t position, std::uint8_t level = 0)
  {
    std::vector<Sampled_point> all;
    for(const Grid_point& p : point) {
      fitted.moments.add(p, 1, level);
      all.push_back({hash_of_position(position++), level, p});
    }
    refit(fitted);
    sample = least_of(all);
  }
  // Without its points.
  void join(const Fragment& other)
  {
    fitted.moments += other.fitted.moments;
    refit(fitted);
    std::vector<Sampled_point> both(sample.item, sample.item + sample.size);
    both.insert(both.end(), other.sample.item, other.sample.item + other.sample.size);
    sample = least_of(both);
  }
  std::int64_t size() const { return std::int64_t(point.size()); }
  Sampled_shape sampled() const { return {fitted, sample}; }
};

using Fragments = std::vector<Fragment>;

// The definition, by all points.
class Slow_gain {
public:
  explicit Slow_gain(const Stage_parameters& options) : options_(options) {}

  // Sets the error of a continuity that is rounded, and whether the result is near the limit of a decision.
  double operator()(const Fragment& a, const Fragment& b, const Contact& contact, double& error, bool& is_close) const
  {
    Fragment joint = a;
    joint.join(b);
    const Value before_a = value(a.point, a.fitted.local), after_a = value(a.point, joint.fitted.local);
    const Value before_b = value(b.point, b.fitted.local), after_b = value(b.point, joint.fitted.local);
    const std::int64_t before = before_a.points + before_b.points, after = after_a.points + after_b.points;
    const double size = bonus(after) - bonus(before_a.points) - bonus(before_b.points);
    const double fit = after_a.fit + after_b.fit - before_a.fit - before_b.fit;
    const double links = double(contact.links);
    const Grid_point at = contact.center();
    const auto height = [&](const Regular_plane& p) {
      return dot(p.normal, {double(at.x), double(at.y), double(at.z)}) - p.offset;
    };
    const double sign = dot(a.fitted.local.normal, b.fitted.local.normal) < 0 ? -1 : 1;
    const double step = (height(a.fitted.local) - sign * height(b.fitted.local)) / epsilon;
    const double cosine = dot(a.fitted.local.normal, b.fitted.local.normal);
    const double turn = (1 - cosine * cosine) / (1 - cosine_deg(25) * cosine_deg(25));
    const double continuity = std::pow((std::max)(0., 1 - step * step), 2) * (std::max)(0., 1 - turn);
    const double saved = Score::unit * (.3 * double(options_.minimum_region_size) + links / 2 / 12);
    const double gain = saved + continuity * size + fit;
    // Squares, which count all points, say of some unions that they cost more than is saved, without a look at points.
    const double squares = after_a.squares + after_b.squares - before_a.squares - before_b.squares;
    error = 2 + 3 * std::fabs(size) / Score::unit;
    is_close = std::fabs(gain) < error || before < a.size() + b.size() ||
               (gain > 0 && Score::unit * squares > saved + continuity * size);
    return 10 * (b.size() - after_b.points) <= b.size() && 10 * (a.size() - after_a.points) <= a.size() ? gain : 0;
  }

private:
  // Of points with one plane.
  struct Value {
    double fit = 0;          // of the points that fit
    std::int64_t points = 0; // that fit
    double squares = 0;      // of distances in epsilons, of all points
  };

  Value value(const Grid_points& points, const Regular_plane& regular) const
  {
    Value v;
    const Plane plane = rounded(regular);
    for(const Grid_point& p : points) {
      const double d = double(signed_distance(plane, p)) / normal_scale / epsilon;
      v.squares += d * d;
      if(fits(plane, p, options_.growth.tolerance)) {
        v.fit += Score::unit * (1 - d * d);
        ++v.points;
      }
    }
    return v;
  }

  double bonus(std::int64_t points) const { return double(options_.score.size_bonus(points)); }

  Stage_parameters options_;
};

// Up to 64 points of a square on a plane, with noise; some normals lean too much for the plane. Coordinates are
// multiples of the factor.
Fragment random_fragment(int n, int x, int factor, std::mt19937& random)
{
  const auto uniform = [&](double low, double high) { return low + (high - low) * double(random() % 100000) / 100000; };
  const double slope_x = uniform(-.1, .1), slope_y = uniform(-.05, .05), height = uniform(-1, 1) * epsilon;
  const double noise = uniform(0, .6) * epsilon;
  const bool has_outliers = random() % 2 == 0;
  Fragment s;
  for(int i = 0; i < n; ++i) {
    const double u = uniform(-500, 500), v = uniform(-500, 500), z = slope_x * u + slope_y * v + height;
    const double lean = has_outliers && random() % 12 == 0 ? .45 : 0; // 24 degrees, and the slope
    const auto rounded = [&](double c) { return int(c) / factor * factor; };
    s.point.push_back(
      {rounded(x + u), rounded(v), rounded(z + uniform(-noise, noise)), encode_normal({lean - slope_x, -slope_y, 1})});
  }
  return s;
}

// Points with a tolerance of epsilon / factor are as those of epsilon that are larger by the factor.
BOOST_AUTO_TEST_CASE(gains)
{
  int accepted = 0, rejected = 0, misfit = 0, close = 0;
  std::mt19937 random(11);
  for(int repetition = 0; repetition < 8000; ++repetition) {
    const std::string where = "case " + std::to_string(repetition);
    const Stage_parameters options = union_options(random() % 4 == 0 ? 200 : 20);
    const Union_gain gain(options);
    const int octaves = int(random() % 3), factor = 1 << octaves, n = 3 + int(random() % 62),
              m = 3 + int(random() % 62);
    Fragment a = random_fragment(n, 0, factor, random), b = random_fragment(m, 1000, factor, random), small[] = {a, b};
    for(std::uint32_t part : {0u, 1u}) {
      for(Grid_point& p : small[part].point)
        p = {p.x / factor, p.y / factor, p.z / factor, p.normal};
      small[part].finish(64 * part, std::uint8_t(8 * octaves));
    }
    a.finish(0);
    b.finish(64);
    const Grid_point at = {int(random() % 2000), int(random() % 1000), int(random() % 40), no_normal};
    const std::uint64_t links = 1 + random() % 30;
    const Contact contact = contact_of(links, {factor * at.x, factor * at.y, factor * at.z, no_normal}),
                  small_contact = contact_of(links, at);
    const double got = gain_of(gain, a.sampled(), b.sampled(), contact),
                 of_small = gain_of(gain, small[0].sampled(), small[1].sampled(), small_contact);
    bool is_close = false;
    double error = 0;
    const double expected = Slow_gain(options)(a, b, contact, error, is_close);
    CHECK_AT(is_close || ((got > 0) == (of_small > 0) && (got <= 0 || std::fabs(got - of_small) < error)),
             where + ": with a smaller tolerance");
    close += is_close;
    if(is_close && (got > 0) != (expected > 0))
      continue;
    check_equal(got > 0, expected > 0, where + ": gains");
    if(got > 0)
      check_close(got, expected, error, where + ": gain");
    accepted += expected > 0;
    rejected += expected < 0;
    misfit += expected == 0;
  }
  for(int count : {accepted, rejected, misfit})
    CHECK_AT(count > 40, std::to_string(count) + " of a kind");
  CHECK_AT(close < 2000, std::to_string(close) + " are close");
}

// Two pieces of 40,000 points of .1 epsilon noise, side by side. The second one is higher by a step, or has a slope.
double gain_of_pieces(double step, double slope, double simplicity)
{
  Stage_parameters options = union_options();
  options.score = Score(100, 12, simplicity);
  std::mt19937 random(4);
  Fragment piece[2];
  for(int at : {0, 1}) {
    for(int i = 0; i < 40000; ++i) {
      const int x = int(random() % 4000);
      const double z = epsilon * (at * (step + slope * x / 4000) + .2 * (double(random() % 1000) / 1000 - .5));
      piece[at].point.push_back({4000 * at + x, int(random() % 4000), int(std::lround(z)), upright});
    }
    piece[at].finish(std::uint32_t(40000 * at));
  }
  Contact contact;
  for(int y = 0; y < 4000; y += 10)
    contact.add(2, {4000, y, 0, upright});
  return gain_of(Union_gain(options), piece[0].sampled(), piece[1].sampled(), contact);
}

// Size does not join layers, however much it counts; a slight bend is no reason to keep a face in pieces.
BOOST_AUTO_TEST_CASE(steps_and_bends)
{
  for(double simplicity : {.01, .04, .3, 3.}) {
    const std::string where = " with simplicity " + std::to_string(simplicity);
    CHECK_AT(gain_of_pieces(1.1, 0, simplicity) <= 0, "a step" + where);
    CHECK_AT(gain_of_pieces(0, .4, simplicity) > 0, "a bend" + where);
  }
}

// As the only rank, and as one after others. Of the labels, and where two shapes have no point, and one has nearly all.
BOOST_AUTO_TEST_CASE(samples)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    const std::size_t n = f.plane.size() + 2;
    for(std::uint32_t first : {0u, 0xfffffff0u})
      for(bool is_large : {false, true}) {
        std::vector<std::uint32_t> label = f.label;
        for(std::uint32_t i = 0; is_large && i < label.size(); ++i)
          label[i] = i % 50 == 0 ? free_label : i % 40 == 0 ? 2 : 1;
        std::vector<std::vector<Sampled_point>> all(n);
        for(std::uint32_t i = 0; i < label.size(); ++i)
          if(label[i] < first_mark)
            all[label[i]].push_back({hash_of_position(first + i), f.level_of(i), f.point[i]});
        Labeled_cloud<decltype(backend)> points(backend);
        take_cloud(f, points);
        points.cloud.first = first;
        set_labels(points, label);
        auto shapes = make_table(backend, f.shapes_of_labels(n, label));
        const auto got = sample_shapes(points, shapes, Has_points{shapes.counted(), 1});
        for(std::size_t s = 0; s < n; ++s) {
          const std::string where = name + ", shape " + std::to_string(s) + " of " + std::to_string(all[s].size());
          CHECK_AT(are_equal(got.sample.data()[s], least_of(all[s])), where);
        }
      }
  });
}

struct Outcome {
  std::vector<std::uint32_t> root; // these by shape
  Regular_planes plane;
  std::vector<Shape_sample> sample;
  int rounds = 0;
};

// What Mutual_unions.h says, by tables of all links and no other state than which shape is where.
class Slow_unions {
public:
  Slow_unions(const Fragments& fragments, const Links& links) : whole_(fragments), root_(fragments.size())
  {
    std::iota(root_.begin(), root_.end(), 0u);
    while(unite(links))
      ++rounds_;
  }

  Outcome outcome() const
  {
    Outcome o = {root_, {}, {}, rounds_};
    for(std::uint32_t r : root_) {
      o.plane.push_back(whole_[r].fitted.local);
      o.sample.push_back(whole_[r].sample);
    }
    return o;
  }

private:
  using Key =
    std::tuple<double, std::int64_t, std::uint64_t, std::uint32_t, std::uint32_t, bool>; // the last: 4 times larger

  bool unite(const Links& links)
  {
    std::map<std::uint32_t, Key> choice;
    for(const Link& link : links) {
      std::uint32_t a = root_[link.first()], b = root_[link.second()];
      const std::int64_t na = whole_[a].fitted.moments.count, nb = whole_[b].fitted.moments.count;
      if(na < nb || (na == nb && b < a))
        std::swap(a, b);
      const double gain = a == b ? 0 : gain_of(gain_, whole_[a].sampled(), whole_[b].sampled(), link.contact);
      const Key key = {-gain, -na - nb, mixed_ids(a, b), a, b, (std::max)(na, nb) > 4 * (std::min)(na, nb)};
      for(std::uint32_t s : {a, b})
        if(gain > 0 && (choice.count(s) == 0 || key < choice[s]))
          choice[s] = key;
    }
    std::map<std::uint32_t, std::uint32_t> joins;
    for(const auto& c : choice) {
      const std::uint32_t stays = std::get<3>(c.second), joining = std::get<4>(c.second);
      const Key& other = choice[stays];
      if(c.first == joining &&
         (other == c.second || (std::get<5>(c.second) && std::get<5>(other) && std::get<3>(other) == stays)))
        joins[joining] = stays;
    }
    for(std::uint32_t& r : root_)
      r = joins.count(r) == 0 ? r : joins[r];
    for(const auto& [joining, stays] : joins)
      whole_[stays].join(whole_[joining]);
    return !joins.empty();
  }

  const Union_gain gain_{union_options()};
  Fragments whole_;                 // by root
  std::vector<std::uint32_t> root_; // by shape
  int rounds_ = 1;
};

// Notes what is exchanged by an atomic operation. What is changed in another way, another thread may change as well.
struct Noting_backend : Sequential_backend {
  inline static std::map<const void*, int> exchanges;

  template <class T>
  static T atomic_exchange_if(T& target, T expected, T value)
  {
    const T old = Sequential_backend::atomic_exchange_if(target, expected, value);
    exchanges[&target] += old == expected;
    return old;
  }
};

template <class Backend>
Outcome unite(Backend& backend, const Fragments& fragments, const Links& links, const std::string& name)
{
  Noting_backend::exchanges.clear();
  const std::size_t n = fragments.size();
  std::vector<Shape> shape(n);
  Shape_samples<Backend> samples;
  samples.sample.reset(n);
  for(std::size_t id = 0; id < n; ++id) {
    static_cast<Fitted_moments&>(shape[id]) = fragments[id].fitted;
    samples.sample.data()[id] = fragments[id].sample;
  }
  Shape_table<Backend> shapes = make_table(backend, shape);
  shapes.set_fitted();
  const auto unions = unite_shapes(Labeled_cloud<Backend>(backend), shapes, Union_gain(union_options()), samples,
                                   to_buffer(backend, links));
  Outcome o;
  o.rounds = int(to_vector(backend, unions.total).front());
  std::set<std::uint32_t> united;
  for(std::uint32_t id = 0; id < n; ++id) {
    const std::uint32_t root = root_of(unions.target.data(), id), place = unions.root[root].place;
    o.root.push_back(root);
    o.plane.push_back(place == no_index ? shape[root].local : unions.whole[place].local);
    o.sample.push_back(samples.sample.data()[root]);
    if(root != id)
      united.insert(root);
    if(std::is_same<Backend, Noting_backend>::value)
      check_equal(Noting_backend::exchanges[&unions.target[id]], int(root != id),
                  name + ": atomic claims of shape " + std::to_string(id));
  }
  CHECK_AT(to_vector(backend, unions.total).back() >= united.size(), name + ": number of unions");
  check_equal(to_vector(backend, unions.total).back() > 0, !united.empty(), name + ": whether shapes unite");
  CHECK_AT(std::none_of(shapes.delta.begin(), shapes.delta.end(), is_any), name + ": deltas that stay");
  return o;
}

// In other orders of the links. Returns the number of roots.
std::size_t check_unions(const std::string& scene, const Fragments& fragments, Links links, int most_rounds)
{
  const Outcome expected = Slow_unions(fragments, links).outcome();
  CHECK_AT(expected.rounds <= most_rounds, scene + ": " + std::to_string(expected.rounds) + " rounds");
  std::shuffle(links.begin(), links.end(), std::mt19937(7));
  const auto check = [&](auto backend, const std::string& of) {
    const std::string name = scene + ", " + of;
    const Outcome got = unite(backend, fragments, links, name);
    check_equal(got.rounds, expected.rounds, name + ": rounds");
    check_lists(got.root, expected.root, name + ": roots");
    for(std::size_t id = 0; id < fragments.size(); ++id) {
      CHECK_AT(are_equal(got.sample[id], expected.sample[id]), name + ": sample of " + std::to_string(id));
      CHECK_AT(is_same(got.plane[id], expected.plane[id]), name + ": plane of " + std::to_string(id));
    }
  };
  check(Thread_backend(8), "8 threads");
  check(Noting_backend(), "atomic operations");
  on_body_backends(check);
  return std::set<std::uint32_t>(expected.root.begin(), expected.root.end()).size();
}

constexpr int columns = 60, rows = 50, width = 1000; // of square fragments, in grid steps

// Of a square whose corner is at x, y; z = height(x, y).
template <class Height>
void add_fragment(Fragments& fragments, int points, int x, int y, std::mt19937& random, Height height)
{
  std::uint32_t position = 0;
  for(const Fragment& f : fragments)
    position += std::uint32_t(f.point.size());
  fragments.emplace_back();
  for(int i = 0; i < points; ++i) {
    const int px = x + int(random() % width), py = y + int(random() % width);
    fragments.back().point.push_back({px, py, height(px, py), upright});
  }
  fragments.back().finish(position);
}

// Roofs of three slopes and a few steps, so that some neighbors have one plane, some nearly, some not: the more uneven,
// the fewer. With links between neighbors in rows, columns and one diagonal.
std::size_t check_roofs(const std::string& name, int unevenness)
{
  std::mt19937 random(3);
  Fragments fragments;
  Links links;
  const auto height = [&](int x, int y) {
    const int slope = x < 20 * width ? x / 8 : x < 40 * width ? 2500 - (x - 20 * width) / 10 : 500;
    const int step = 70 * (y / (5 * width)) + unevenness * (37 * (x / width % 7) + 61 * (y / width % 5));
    return slope + step + int(random() % 60);
  };
  for(std::uint32_t id = 0; id < columns * rows; ++id) {
    add_fragment(fragments, 20 + int(random() % 200), int(id % columns) * width, int(id / columns) * width, random,
                 height);
    for(const std::uint32_t other : {id + 1, id + columns, id + columns + 1})
      if(other < columns * rows && (other == id + columns || id % columns + 1 < columns))
        links.push_back({std::uint64_t(id) << 32 | other, contact_of(1 + id % 5, fragments[id].point[0])});
  }
  return check_unions(name, fragments, links, 100);
}

BOOST_AUTO_TEST_CASE(roofs)
{
  constexpr std::size_t all = columns * rows;
  const std::size_t roots = check_roofs("roofs", 1), of_uneven = check_roofs("uneven roofs", 4);
  CHECK_AT(roots > all / 30 && roots < all / 3, std::to_string(roots));
  CHECK_AT(of_uneven > all - 30 && of_uneven < all, std::to_string(of_uneven));
}

// Exactly level shapes become one. Small ones beside a large one join it in one round, and the second round finds no
// pair. Equal ones in a row, where all gains are equal at first, and most unions of a size: a number of rounds like
// that of the shapes would be quadratic in time.
BOOST_AUTO_TEST_CASE(level_shapes)
{
  for(bool is_row : {false, true}) {
    std::mt19937 random(1);
    Fragments fragments;
    Links links;
    for(std::uint32_t i = 0; i < (is_row ? 2000 : 300); ++i) {
      const int size = is_row ? 50 : i == 0 ? 2000 : 5 + int(i);
      add_fragment(fragments, size, int(i) * width, 0, random, [](int, int) { return 0; });
      if(i > 0)
        links.push_back(
          {std::uint64_t(is_row ? i - 1 : 0) << 32 | i, contact_of(is_row ? 1 : 3, fragments[i].point[0])});
    }
    const std::string name = is_row ? "a row" : "many beside one";
    check_equal(check_unions(name, fragments, links, is_row ? 300 : 2), 1u, name);
  }
}

BOOST_AUTO_TEST_SUITE_END()
