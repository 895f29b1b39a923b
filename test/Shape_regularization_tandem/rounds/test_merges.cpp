// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shapes that become one, against plain loops on several back ends: which one stays, which ones touch and have one
// plane, what becomes of the shapes, and of their points.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/rounds/join_members.h>
#include <CGAL/Tandem/internal/rounds/merge_coplanar.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_merges)

using namespace CGAL::Tandem::internal;

using Ids = std::vector<std::uint32_t>;

// Few different numbers of points, so that many shapes are of one size; every ninth one is out of use.
std::vector<Shape> make_shapes(std::size_t n, std::mt19937& random)
{
  std::vector<Shape> shape(n);
  for(std::size_t id = 0; id < n; ++id) {
    shape[id].moments.count = id % 9 == 4 ? 0 : 1 + std::int64_t(random() % 5) * (std::int64_t(1) << 33);
    shape[id].plane_number = int(random() % 7) - 1;
  }
  return shape;
}

// The largest, of equal ones that with the smallest id.
std::uint32_t largest(const std::vector<Shape>& shape, const Ids& members)
{
  return *std::min_element(members.begin(), members.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::make_pair(-shape[a].moments.count, a) < std::make_pair(-shape[b].moments.count, b);
  });
}

// Some of a list of shapes.
struct Chosen_members {
  const std::uint32_t* member;
  const std::uint8_t* is_chosen;

  bool has(std::uint32_t i) const { return is_chosen[i] != 0; }
  std::uint32_t id(std::uint32_t i) const { return member[i]; }
};

template <class Backend>
class Merges {
public:
  Merges(Backend& backend, const std::string& name) : backend_(backend), name_(name) {}

  void run()
  {
    for(std::size_t n : {1, 2, 10, 33, 1000, 5000})
      for(std::size_t sets : {std::size_t(1), n / 5 + 1, n}) {
        std::mt19937 random(unsigned(n + sets));
        const std::vector<Shape> shape = make_shapes(n, random);
        test_join(shape, sets, random);
        test_coplanar(shape, sets, random);
      }
  }

private:
  void check_targets(const Targets<Backend>& target, const Ids& expected, const std::string& where)
  {
    check_lists(to_vector(backend_, target), expected, where);
  }

  // The paths to the roots of the sets are of any length, and roots are no smallest ids. Some members do not join.
  void test_join(const std::vector<Shape>& shape, std::size_t sets, std::mt19937& random)
  {
    const std::size_t n = shape.size();
    Ids order(n), set(n), member, expected(n);
    std::iota(order.begin(), order.end(), 0u);
    std::iota(expected.begin(), expected.end(), 0u);
    std::shuffle(order.begin(), order.end(), random);
    std::map<std::uint32_t, Ids> joined; // by root
    std::vector<std::uint32_t> root(n);
    for(std::size_t i = 0; i < n; ++i) {
      const std::uint32_t id = order[i];
      set[id] = i < sets ? id : order[random() % (i % 3 == 0 ? sets : i)];
      root[id] = i < sets ? id : root[set[id]];
    }
    std::vector<std::uint8_t> is_joined;
    for(std::uint32_t id = 0; id < n; ++id)
      if(shape[id].is_live() && random() % 8 != 0) {
        member.push_back(id);
        is_joined.push_back(random() % 4 != 0);
        if(is_joined.back())
          joined[root[id]].push_back(id);
      }
    for(const auto& j : joined)
      for(std::uint32_t id : j.second)
        expected[id] = largest(shape, j.second);
    const Shape_table<Backend> shapes = make_table(backend_, shape);
    const auto target =
      join_members(backend_, shapes, member.size(), Chosen_members{member.data(), is_joined.data()}, set.data());
    check_targets(target, expected, name_ + ": " + std::to_string(sets) + " sets of " + std::to_string(n) + " shapes");
  }

  // Links in any order, some twice, some of a shape with itself.
  void test_coplanar(const std::vector<Shape>& shape, std::size_t number, std::mt19937& random)
  {
    const std::uint32_t n = std::uint32_t(shape.size());
    std::vector<Link> link;
    for(std::size_t l = 0; l < 2 * number; ++l) {
      const std::uint32_t a = std::uint32_t(random() % n), b = (std::min)(a + std::uint32_t(random() % 50), n - 1);
      if(shape[a].is_live() && shape[b].is_live())
        link.insert(link.end(), 1 + l % 2, {std::uint64_t(a) << 32 | b, 2});
    }
    std::shuffle(link.begin(), link.end(), random);
    Ids set(n), expected(n); // the smallest id of each set
    std::iota(set.begin(), set.end(), 0u);
    std::iota(expected.begin(), expected.end(), 0u);
    for(bool goes_on = true; goes_on;) {
      goes_on = false;
      for(const Link& l : link) {
        std::uint32_t &a = set[l.first()], &b = set[l.second()];
        const int plane = shape[l.first()].plane_number;
        if(plane < 0 || plane != shape[l.second()].plane_number || a == b)
          continue;
        a = b = (std::min)(a, b);
        goes_on = true;
      }
    }
    std::map<std::uint32_t, Ids> members;
    for(std::uint32_t id = 0; id < n; ++id)
      if(shape[id].is_live())
        members[set[id]].push_back(id);
    for(const auto& m : members)
      for(std::uint32_t id : m.second)
        expected[id] = largest(shape, m.second);
    const auto target = coplanar_targets(backend_, make_table(backend_, shape), to_buffer(backend_, link));
    check_targets(target, expected,
                  name_ + ": " + std::to_string(link.size()) + " links of " + std::to_string(n) + " shapes");
    if(n >= 1000 && number == n)
      CHECK_AT(members.size() < n - n / 9 - 50, name_ + ": hardly any shapes merge");
  }

  Backend& backend_;
  const std::string name_;
};

template <class Backend>
class Merged_clouds {
public:
  Merged_clouds(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f) {}

  // Shapes of the labels: each fourth one is dissolved, each third one goes to the one before it that stays.
  void run()
  {
    const std::uint32_t n = std::uint32_t(f_.plane.size()) + 7;
    std::vector<Shape> shape = make_shapes(n);
    Ids target(n);
    std::iota(target.begin(), target.end(), 0u);
    for(std::uint32_t id = 1; id < n; ++id)
      if(shape[id].is_live() && id % 4 != 3 && id % 3 == 0)
        target[id] = shape[0].is_live() && id % 2 == 0 ? 0 : target[id - 1] == id - 1 ? id - 1 : id;
    for(std::uint32_t id = 3; id < n; id += 4)
      if(shape[id].is_live() && std::count(target.begin(), target.end(), id) == 1)
        target[id] = free_label;
    std::vector<Shape> expected = shape;
    Ids label = f_.label;
    std::vector<std::uint8_t> state = f_.state;
    std::size_t merged = 0, dissolved = 0;
    for(std::uint32_t id = 0; id < n; ++id) {
      const std::uint32_t t = target[id];
      if(t == id)
        continue;
      expected[id].moments = Moments();
      dissolved += t >= first_mark;
      if(t >= first_mark)
        continue;
      ++merged;
      expected[t].moments += shape[id].moments;
      expected[t].box.add(shape[id].box);
      expected[t].age = (std::max)(expected[t].age, shape[id].age);
      expected[t].history.set_fitted(false);
      expected[t].history.set_linked(false);
    }
    for(std::uint32_t i = 0; i < label.size(); ++i) {
      if(label[i] >= first_mark)
        continue;
      label[i] = target[label[i]];
      if(label[i] >= first_mark)
        state[i] = std::uint8_t((state[i] | tried_seed_bit) & ~(frontier_bit | interior_bit));
    }
    CHECK_AT(f_.cloud.size < 100 || (merged > 0 && dissolved > 0), name_ + ": nothing is merged or dissolved");

    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    set_labels(points, f_.label, f_.state);
    Shape_table<Backend> shapes = make_table(backend_, shape);
    shapes.plane = filled_buffer(backend_, n, Plane());
    merge_points(points, shapes, to_buffer(backend_, target));
    check_shapes(shapes, expected, name_ + ": merge");
    check_lists(to_vector(backend_, points.label(), label.size()), label, name_ + ": labels after a merge");
    check_lists(to_vector(backend_, points.state(), label.size()), state, name_ + ": states after a merge");
    test_drop(points, shapes, expected, label);
  }

private:
  std::vector<Shape> make_shapes(std::uint32_t n) const
  {
    std::vector<Shape> shape = f_.shapes_of_labels(n);
    for(std::uint32_t id = 0; id < n; ++id) {
      shape[id].age = int(id * 5 % 7);
      shape[id].history.set_fitted(id % 5 != 0);
      shape[id].history.set_linked(id % 5 != 0);
    }
    return shape;
  }

  // Then the shapes of less than so many points are dissolved.
  void test_drop(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, std::vector<Shape> expected, Ids label)
  {
    const std::int64_t minimum = std::int64_t(label.size() / 30);
    std::vector<std::uint8_t> is_dropped(expected.size(), 0);
    for(std::size_t id = 0; id < expected.size(); ++id)
      if(expected[id].is_live() && expected[id].moments.count < minimum) {
        expected[id].moments = Moments();
        is_dropped[id] = 1;
      }
    for(std::uint32_t& l : label)
      l = l < first_mark && is_dropped[l] ? free_label : l;
    drop_small(points, shapes, minimum);
    check_shapes(shapes, expected, name_ + ": drop");
    check_lists(to_vector(backend_, points.label(), label.size()), label, name_ + ": labels after a drop");
    const Shape_counts counts = count_live(backend_, shapes);
    std::size_t live = 0, assigned = 0;
    for(const Shape& s : expected) {
      live += s.is_live();
      assigned += std::size_t(s.moments.count);
    }
    check_equal(counts.shapes, live, name_ + ": live shapes");
    check_equal(counts.points, assigned, name_ + ": their points");
  }

  void check_shapes(const Shape_table<Backend>& shapes, const std::vector<Shape>& expected, const std::string& where)
  {
    std::vector<Shared_moments> sums(expected.size());
    for(std::size_t id = 0; id < expected.size(); ++id) {
      const Shape &s = shapes.table()[id], &e = expected[id];
      atomic_add<Sequential_backend>(sums[id], e.moments, e.box);
      const std::string at = where + ", shape " + std::to_string(id);
      check_equal(s.age, e.age, at + ": age");
      CHECK_AT(s.history.is_fitted() == e.history.is_fitted() && s.history.is_linked() == e.history.is_linked(),
               at + ": changes");
    }
    check_moments(shapes, sums, where);
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

template <class Backend>
void test(Backend backend, const std::string& name)
{
  Merges<Backend>(backend, name).run();
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  on_body_backends([](auto backend, const std::string& name) { test(backend, name); });
  test_on_all_backends<Merged_clouds>();
}

BOOST_AUTO_TEST_SUITE_END()
