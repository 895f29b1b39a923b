// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unions in rounds of mutual choice: on all back ends what a slow definition gives, which fits every link anew in every
// round, in any order of the links. What is rejected without a fit would have been rejected with it.

#undef NDEBUG

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/rounds/unite_shapes.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <set>

using namespace CGAL::Tandem::internal;

constexpr int columns = 60, rows = 50, width = 1000; // of square fragments, in grid steps
constexpr double maximum_distance = 60;

// Level ground is exactly flat, so all costs are 0 there, and sizes and ids decide.
constexpr int level = -1;

// Roofs of three slopes and a few steps, so that some neighbors have one plane, some nearly, some not: the more
// uneven, the fewer.
std::int32_t height(int x, int y, int unevenness, std::mt19937& random)
{
  if(unevenness == level)
    return 300 * (y / (5 * width));
  const int slope = x < 20 * width ? x / 8 : x < 40 * width ? 2500 - (x - 20 * width) / 10 : 500;
  const int step = 70 * (y / (5 * width)) + unevenness * (37 * (x / width % 7) + 61 * (y / width % 5));
  return slope + step + int(random() % 60);
}

using Link_list = std::vector<Link>;

template <class Backend>
void make_fragments(Backend& backend, Shape_table<Backend>& shapes, int unevenness, std::int32_t shift = 0)
{
  std::mt19937 random(3);
  shapes.size = columns * rows;
  shapes.table() = filled_buffer(backend, shapes.size, Shape());
  for(int id = 0; id < columns * rows; ++id) {
    Shape& shape = shapes.table()[std::size_t(id)];
    const int size = unevenness == level ? 20 + 30 * int(random() % 3) * int(random() % 3) : 20 + int(random() % 200);
    for(int i = 0; i < size; ++i) {
      const int x = id % columns * width + int(random() % width), y = id / columns * width + int(random() % width);
      shape.moments.add({x + shift, y + shift, height(x, y, unevenness, random) + shift, no_normal}, 1);
    }
    refit(shape);
  }
}

// Between neighbors in rows, columns and one diagonal, in random order.
Link_list make_links(unsigned seed)
{
  Link_list links;
  for(std::uint32_t id = 0; id < columns * rows; ++id)
    for(const std::uint32_t other : {id + 1, id + columns, id + columns + 1})
      if(other < columns * rows && (other == id + columns || id % columns + 1 < columns))
        links.push_back({std::uint64_t(id) << 32 | other, 1});
  std::shuffle(links.begin(), links.end(), std::mt19937(seed));
  return links;
}

struct Outcome {
  std::vector<std::uint32_t> root;
  Regular_planes plane;
  int rounds = 0;
};

const Joint_fit_criterion criterion = {.95, maximum_distance};

// What Mutual_unions.h says, by tables of all links and no other state than which shape is where.
class Slow_unions {
public:
  template <class Backend>
  Slow_unions(const Shape_table<Backend>& shapes, const Link_list& links)
  {
    for(std::uint32_t id = 0; id < shapes.size; ++id) {
      root_.push_back(id);
      whole_[id] = shapes.table()[id];
    }
    while(unite(links))
      ++rounds_;
  }

  Outcome outcome() const
  {
    Outcome o;
    o.rounds = rounds_;
    for(std::uint32_t r : root_) {
      o.root.push_back(r);
      o.plane.push_back(whole_.at(r).local);
    }
    return o;
  }

private:
  using Key =
    std::tuple<double, std::int64_t, std::uint64_t, std::uint32_t, std::uint32_t, bool>; // the last: no new fit

  bool unite(const Link_list& links)
  {
    std::map<std::uint32_t, Key> choice;
    for(const Link& link : links) {
      std::uint32_t a = root_[link.first()], b = root_[link.second()];
      const std::int64_t na = whole_[a].moments.count, nb = whole_[b].moments.count;
      if(na < nb || (na == nb && b < a))
        std::swap(a, b);
      const Verdict v = a == b ? Verdict() : criterion.verdict(whole_[a], whole_[b]);
      const Key key = {v.cost, -na - nb, mixed_ids(a, b), a, b, v.is_taken};
      for(std::uint32_t s : {a, b})
        if(v.is_accepted && (choice.count(s) == 0 || key < choice[s]))
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
    for(const auto& j : joins) {
      whole_[j.second].moments += whole_[j.first].moments;
      refit(whole_[j.second]);
    }
    return !joins.empty();
  }

  std::vector<std::uint32_t> root_; // by shape
  std::map<std::uint32_t, Fitted_moments> whole_;
  int rounds_ = 1;
};

template <class Backend>
Shape_unions<Backend> unite(Backend& backend, Shape_table<Backend>& shapes, const Link_list& links,
                            std::uint32_t* rounds = nullptr)
{
  shapes.set_fitted();
  Shape_unions<Backend> unions =
    unite_shapes(backend, Ranks<Backend>(backend), shapes, criterion, to_buffer(backend, links));
  if(rounds != nullptr)
    *rounds = to_vector(backend, unions.total).front();
  CHECK(std::is_sorted(unions.member.begin(), unions.member.end(), std::less_equal<std::uint32_t>()));
  for(const Shared_moments& d : shapes.delta)
    CHECK(d.count == 0 && d.sum[0] == 0 && d.low[5] == 0 && d.high[5] == 0);
  std::map<std::uint32_t, int> members;
  for(const std::uint32_t id : unions.member)
    ++members[root_of(unions.target.data(), id)];
  for(const auto& m : members)
    CHECK(m.second > 1 && std::binary_search(unions.member.begin(), unions.member.end(), m.first));
  for(std::uint32_t id = 0; id < shapes.size; ++id)
    CHECK(std::binary_search(unions.member.begin(), unions.member.end(), id) || unions.target[id] == id);
  return unions;
}

template <class Backend>
Outcome unite(Backend& backend, int unevenness, unsigned seed)
{
  Shape_table<Backend> shapes;
  make_fragments(backend, shapes, unevenness);
  std::uint32_t rounds = 0;
  const Shape_unions<Backend> unions = unite(backend, shapes, make_links(seed), &rounds);
  Outcome outcome;
  outcome.rounds = int(rounds);
  for(std::uint32_t id = 0; id < shapes.size; ++id) {
    const std::uint32_t root = root_of(unions.target.data(), id), place = unions.root[root].place;
    outcome.root.push_back(root);
    outcome.plane.push_back(place == no_index ? shapes.table()[root].local : unions.whole[place].local);
  }
  return outcome;
}

bool is_same(const Regular_plane& a, const Regular_plane& b) { return a.normal == b.normal && a.offset == b.offset; }

template <class Backend>
void check(Backend& backend, int unevenness, const Outcome& expected, const std::string& name)
{
  const Outcome outcome = unite(backend, unevenness, 7);
  check_equal(outcome.rounds, expected.rounds, name + ": rounds");
  CHECK_AT(outcome.root == expected.root, name);
  CHECK_AT(std::equal(outcome.plane.begin(), outcome.plane.end(), expected.plane.begin(), is_same), name + ": planes");
}

void check_apart(std::int32_t shift)
{
  Sequential_backend backend;
  Shape_table<Sequential_backend> shapes;
  make_fragments(backend, shapes, 0, shift);
  int rejected = 0, apart = 0;
  for(const Link& link : make_links(5)) {
    const Shape &a = shapes.table()[link.first()], &b = shapes.table()[link.second()];
    Fitted_moments joint;
    const bool is_rejected = !criterion.fit(a, b, joint), is_apart = criterion.are_apart(a, b);
    rejected += is_rejected;
    apart += is_apart;
    CHECK(!is_apart || (is_rejected && !criterion.is_tolerable(a, b.local) && !criterion.is_tolerable(b, a.local)));
    check_equal(criterion(a, b, joint), !is_rejected, "with and without the shortcut");
  }
  CHECK_AT(rejected > 200 && 3 * apart > rejected, std::to_string(apart) + " of " + std::to_string(rejected));
}

// A square fragment, exactly level. The table has room for it.
void add_fragment(Shape_table<Sequential_backend>& shapes, int x, int y, int z, int size)
{
  std::mt19937 random(unsigned(shapes.size));
  Shape& shape = shapes.table()[shapes.size++];
  shape = Shape();
  for(int i = 0; i < size; ++i)
    shape.moments.add({x + int(random() % width), y + int(random() % width), z, no_normal}, 1);
  refit(shape);
}

Link link(std::size_t a, std::size_t b) { return {std::uint64_t(a) << 32 | b, 1}; }

// The plane of a union is that of the points of all its members.
void check_planes(const Shape_table<Sequential_backend>& shapes, const Shape_unions<Sequential_backend>& unions)
{
  std::map<std::uint32_t, Fitted_moments> whole;
  for(const std::uint32_t id : unions.member)
    whole[root_of(unions.target.data(), id)].moments += shapes.table()[id].moments;
  for(auto& w : whole) {
    refit(w.second);
    CHECK(is_same(unions.whole[unions.root[w.first].place].local, w.second.local));
  }
}

// Equal shapes in a row: all costs are 0, and most unions of a size. A number of rounds like that of the shapes would be
// quadratic in time.
void check_row()
{
  constexpr int n = 2000;
  Sequential_backend backend;
  Shape_table<Sequential_backend> shapes;
  shapes.table().reset(n);
  Link_list links;
  for(int i = 0; i < n; ++i) {
    add_fragment(shapes, i * width, 0, 0, 50);
    if(i > 0)
      links.push_back(link(std::size_t(i) - 1, std::size_t(i)));
  }
  std::uint32_t rounds = 0;
  const Shape_unions<Sequential_backend> unions = unite(backend, shapes, links, &rounds);
  CHECK_AT(rounds < 300, std::to_string(rounds) + " rounds");
  check_equal(unions.member.size(), std::size_t(n), "members of a row");
  for(const std::uint32_t id : unions.member)
    check_equal(root_of(unions.target.data(), id), root_of(unions.target.data(), 0), "root of a row");
  check_planes(shapes, unions);
}

// In each of many groups, two shapes unite first, and their union joins one that was in no union before.
void check_groups()
{
  constexpr int n = 1000;
  Sequential_backend backend;
  Shape_table<Sequential_backend> shapes;
  shapes.table().reset(3 * n);
  Link_list links;
  for(int g = 0; g < n; ++g) {
    add_fragment(shapes, 0, 3 * g * width, 5, 100);
    add_fragment(shapes, width, 3 * g * width, 0, 30);
    add_fragment(shapes, 2 * width, 3 * g * width, 0, 30);
    const std::size_t first = 3 * std::size_t(g);
    links.push_back(link(first, first + 1));
    links.push_back(link(first + 1, first + 2));
  }
  const Shape_unions<Sequential_backend> unions = unite(backend, shapes, links);
  check_equal(unions.member.size(), std::size_t(3 * n), "members of groups");
  for(const std::uint32_t id : unions.member)
    check_equal(root_of(unions.target.data(), id), id / 3 * 3, "root of a group");
  check_planes(shapes, unions);
}

// What is to be found: more unions than `few` and fewer than `many`.
struct Scene {
  int unevenness;
  std::size_t few, many;
};

void check_scene(const Scene& scene)
{
  Sequential_backend sequential;
  Shape_table<Sequential_backend> shapes;
  make_fragments(sequential, shapes, scene.unevenness);
  const Outcome expected = Slow_unions(shapes, make_links(5)).outcome();
  const std::set<std::uint32_t> roots(expected.root.begin(), expected.root.end());
  CHECK_AT(roots.size() > scene.few && roots.size() < scene.many, std::to_string(roots.size()));
  check(sequential, scene.unevenness, expected, "sequential");
  for(unsigned threads = 2; threads <= 8; threads *= 2) {
    Thread_backend backend(threads);
    check(backend, scene.unevenness, expected, std::to_string(threads) + " threads");
  }
  for(unsigned seed = 1; seed <= 3; ++seed) {
    Shuffled_backend backend(seed);
    check(backend, scene.unevenness, expected, "shuffled " + std::to_string(seed));
  }
}

int main()
{
  check_apart(0);
  check_apart(1 << 30);
  check_row();
  check_groups();
  constexpr std::size_t all = columns * rows;
  for(const Scene& scene :
      {Scene{level, 9, 11}, {0, 2, all / 3}, {1, all / 30, all / 3}, {2, all / 3, all}, {4, all - 1, all + 1}})
    check_scene(scene);
  return report();
}
