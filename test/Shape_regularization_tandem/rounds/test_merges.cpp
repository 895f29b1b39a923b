// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shapes that touch and have one plane become one, against plain loops on several back ends: which one stays, and what
// becomes of the shapes and of their points.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/rounds/merge_shapes.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_merges)

using namespace CGAL::Tandem::internal;

using Ids = std::vector<std::uint32_t>;

// Few different numbers of points, so that many shapes are of one size; every ninth one is out of use. Links in any
// order, some twice, some of a shape with itself. Of shapes that are linked and have one plane, the largest stays, of
// equal ones that with the smallest id.
void check_coplanar(std::uint32_t n, std::size_t number)
{
  std::mt19937 random(unsigned(n + number));
  std::vector<Shape> shape(n);
  for(std::size_t id = 0; id < n; ++id) {
    shape[id].moments.count = id % 9 == 4 ? 0 : 1 + std::int64_t(random() % 5) * (std::int64_t(1) << 33);
    shape[id].plane_number = int(random() % 7) - 1;
  }
  std::vector<Link> link;
  for(std::size_t l = 0; l < 2 * number; ++l) {
    const std::uint32_t a = std::uint32_t(random() % n), b = (std::min)(a + std::uint32_t(random() % 50), n - 1);
    if(shape[a].is_live() && shape[b].is_live())
      link.insert(link.end(), 1 + l % 2, {std::uint64_t(a) << 32 | b, {2}});
  }
  std::shuffle(link.begin(), link.end(), random);
  Ids expected(n);
  std::iota(expected.begin(), expected.end(), 0u);
  for(bool goes_on = true; goes_on;) {
    goes_on = false;
    for(const Link& l : link) {
      std::uint32_t &a = expected[l.first()], &b = expected[l.second()];
      const int plane = shape[l.first()].plane_number;
      if(plane < 0 || plane != shape[l.second()].plane_number || a == b)
        continue;
      const auto key = [&](std::uint32_t id) { return std::make_pair(-shape[id].moments.count, id); };
      a = b = key(a) < key(b) ? a : b;
      goes_on = true;
    }
  }
  const std::size_t stay = std::set<std::uint32_t>(expected.begin(), expected.end()).size();
  CHECK_AT(n < 1000 || number < n || stay < n - 50, "hardly any shapes merge");
  on_body_backends([&](auto backend, const std::string& name) {
    const auto target = coplanar_targets(backend, make_table(backend, shape), to_buffer(backend, link));
    check_lists(to_vector(backend, target), expected,
                name + ": " + std::to_string(link.size()) + " links of " + std::to_string(n) + " shapes");
  });
}

BOOST_AUTO_TEST_CASE(targets)
{
  for(std::uint32_t n : {1, 2, 33, 5000})
    for(std::uint32_t number : {1u, n / 5 + 1, n})
      check_coplanar(n, number);
}

// Shapes of the labels of a fixture, and what merges make of them and of the points.
struct Merged_cloud {
  std::vector<Shape> before, after;
  Ids target, label;
  std::vector<std::uint8_t> state;

  // Some are dissolved, some go to one before them that stays.
  explicit Merged_cloud(const Fixture& f)
    : before(f.shapes_of_labels(f.plane.size() + 7)), target(before.size()), label(f.label), state(f.state)
  {
    std::mt19937 random(unsigned(label.size()));
    for(std::uint32_t id = 0; id < before.size(); ++id) {
      before[id].age = int(random() % 7);
      before[id].history.is_fitted = random() % 5 != 0;
      before[id].history.is_linked = random() % 5 != 0;
      const std::uint32_t other = std::uint32_t(random() % (id + 1)), dice = std::uint32_t(random() % 4);
      const bool may_join = before[id].is_live() && target[other] == other && before[other].is_live();
      target[id] = before[id].is_live() && dice == 0 ? +free_label : may_join && dice == 1 ? other : id;
    }
    merge(f.name);
  }

  void merge(const std::string& where)
  {
    after = before;
    std::size_t merged = 0, dissolved = 0;
    for(std::uint32_t id = 0; id < target.size(); ++id) {
      const std::uint32_t t = target[id];
      if(t == id)
        continue;
      after[id].moments = Moments();
      dissolved += t >= first_mark;
      if(t >= first_mark)
        continue;
      ++merged;
      after[t].moments += before[id].moments;
      after[t].box.add(before[id].box);
      after[t].age = (std::max)(after[t].age, before[id].age);
      after[t].history.is_fitted = false;
      after[t].history.is_linked = false;
    }
    for(std::uint32_t i = 0; i < label.size(); ++i) {
      if(label[i] >= first_mark)
        continue;
      label[i] = target[label[i]];
      if(label[i] >= first_mark)
        state[i] = std::uint8_t((state[i] | tried_seed_bit) & ~interior_bit);
    }
    CHECK_AT(label.size() < 100 || (merged > 0 && dissolved > 0), where + ": nothing is merged or dissolved");
  }

  // Then the shapes of less points are dissolved.
  void drop(std::int64_t minimum)
  {
    for(std::uint32_t& l : label)
      l = l < first_mark && after[l].moments.count < minimum ? free_label : l;
    for(Shape& s : after)
      if(s.moments.count < minimum)
        s.moments = Moments();
  }
};

template <class Backend>
void check_cloud(Backend& backend, const Labeled_cloud<Backend>& points, const Shape_table<Backend>& shapes,
                 const Merged_cloud& expected, const std::string& where)
{
  std::vector<Shared_moments> sums(expected.after.size());
  for(std::size_t id = 0; id < sums.size(); ++id) {
    const Shape &s = shapes.table()[id], &e = expected.after[id];
    atomic_add<Sequential_backend>(sums[id], e.moments, e.box);
    CHECK_AT(s.age == e.age && s.history.is_fitted == e.history.is_fitted && s.history.is_linked == e.history.is_linked,
             where + ", shape " + std::to_string(id) + ": age and changes");
  }
  check_moments(shapes, sums, where);
  check_lists(to_vector(backend, points.label(), expected.label.size()), expected.label, where + ": labels");
}

BOOST_AUTO_TEST_CASE(points)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    Merged_cloud expected(f);
    Labeled_cloud<decltype(backend)> points(backend);
    take_cloud(f, points);
    set_labels(points, f.label, f.state);
    auto shapes = make_table(backend, expected.before);
    shapes.plane = filled_buffer(backend, expected.before.size(), Plane());
    merge_surfels(points, shapes, to_buffer(backend, expected.target));
    check_cloud(backend, points, shapes, expected, name + ": merge");
    check_lists(to_vector(backend, points.state(), f.state.size()), expected.state, name + ": states");
    const std::int64_t minimum = std::int64_t(f.label.size() / 30);
    expected.drop(minimum);
    drop_shapes(points, shapes, [=](const Shape& s, std::size_t) { return s.moments.count < minimum; });
    check_cloud(backend, points, shapes, expected, name + ": drop");
  });
}

BOOST_AUTO_TEST_SUITE_END()
