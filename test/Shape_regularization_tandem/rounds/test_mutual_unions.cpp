// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unions in rounds of mutual choice: what a slow definition gives, which fits every link anew in every round, in any order
// of the links. And few rounds unite a row of equal shapes.

#include "testing/fragments.h"
#include "testing/verdict_of.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_mutual_unions)

using namespace CGAL::Tandem::internal;

struct Outcome {
  std::vector<std::uint32_t> root;
  Regular_planes plane;
  std::vector<Shape_sample> sample;
  int rounds = 0;
};

// What Mutual_unions.h says, by tables of all links and no other state than which shape is where.
class Slow_unions {
public:
  template <class Backend>
  Slow_unions(const Fragments<Backend>& fragments, const Link_list& links)
  {
    for(std::uint32_t id = 0; id < fragments.shapes.size; ++id) {
      root_.push_back(id);
      whole_[id] = fragments.shapes.table()[id];
      sample_[id] = fragments.samples.data()[id];
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
      o.sample.push_back(sample_.at(r));
    }
    return o;
  }

private:
  using Key =
    std::tuple<double, std::int64_t, std::uint64_t, std::uint32_t, std::uint32_t, bool>; // the last: no new fit

  Verdict verdict(std::uint32_t a, std::uint32_t b, std::uint32_t links) const
  {
    return verdict_of(criterion, {whole_.at(a), sample_.at(a)}, {whole_.at(b), sample_.at(b)}, links);
  }

  bool unite(const Link_list& links)
  {
    std::map<std::uint32_t, Key> choice;
    for(const Link& link : links) {
      std::uint32_t a = root_[link.first()], b = root_[link.second()];
      const std::int64_t na = whole_[a].moments.count, nb = whole_[b].moments.count;
      if(na < nb || (na == nb && b < a))
        std::swap(a, b);
      const Verdict v = a == b ? Verdict() : verdict(a, b, link.count);
      const Key key = {-v.gain, -na - nb, mixed_ids(a, b), a, b, v.is_taken};
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
      Shape_sample &stays = sample_[j.second], &joining = sample_[j.first];
      std::vector<Sampled_point> both(stays.item, stays.item + stays.size);
      both.insert(both.end(), joining.item, joining.item + joining.size);
      stays = least_of(both);
    }
    return !joins.empty();
  }

  std::vector<std::uint32_t> root_; // by shape
  std::map<std::uint32_t, Fitted_moments> whole_;
  std::map<std::uint32_t, Shape_sample> sample_;
  int rounds_ = 1;
};

// In other orders of the links. More unions than `few` and fewer than `many` are found.
void check_scene(int unevenness, std::size_t few, std::size_t many)
{
  Sequential_backend sequential;
  const Outcome expected = Slow_unions(make_fragments(sequential, unevenness), make_links(5)).outcome();
  const std::set<std::uint32_t> roots(expected.root.begin(), expected.root.end());
  CHECK_AT(roots.size() > few && roots.size() < many, std::to_string(roots.size()));
  const auto check = [&](auto backend, const std::string& name) {
    auto fragments = make_fragments(backend, unevenness);
    std::uint32_t rounds = 0;
    const auto unions = unite(backend, fragments, make_links(7), &rounds);
    check_equal(int(rounds), expected.rounds, name + ": rounds");
    for(std::uint32_t id = 0; id < fragments.shapes.size; ++id) {
      const std::uint32_t root = root_of(unions.target.data(), id), place = unions.root[root].place;
      CHECK_AT(root == expected.root[id], name + ": roots");
      CHECK_AT(are_equal(fragments.samples.data()[root], expected.sample[id]), name + ": samples");
      CHECK_AT(is_same(place == no_index ? fragments.shapes.table()[root].local : unions.whole[place].local,
                       expected.plane[id]),
               name + ": planes");
    }
  };
  check(Thread_backend(8), "8 threads");
  on_body_backends(check);
}

constexpr std::size_t all = columns * rows;

BOOST_AUTO_TEST_CASE(level_ground) { check_scene(level, 9, 11); }
BOOST_AUTO_TEST_CASE(roofs) { check_scene(1, all / 30, all / 3); }
BOOST_AUTO_TEST_CASE(uneven_roofs) { check_scene(4, all - 30, all); }

// Equal shapes in a row, exactly level: all gains are equal at first, and most unions of a size. A number of rounds like
// that of the shapes would be quadratic in time.
BOOST_AUTO_TEST_CASE(rows_of_shapes)
{
  constexpr int n = 2000;
  std::mt19937 random(1);
  Sequential_backend backend;
  Fragments<Sequential_backend> fragments(backend, n);
  Link_list links;
  for(int i = 0; i < n; ++i) {
    Grid_points points;
    for(int j = 0; j < 50; ++j)
      points.push_back({i * width + int(random() % width), int(random() % width), 0, upright});
    fragments.add(points);
    if(i > 0)
      links.push_back({std::uint64_t(i - 1) << 32 | std::uint64_t(i), 1});
  }
  std::uint32_t rounds = 0;
  const auto unions = unite(backend, fragments, links, &rounds);
  CHECK_AT(rounds < 300, std::to_string(rounds) + " rounds");
  check_equal(unions.member.size(), std::size_t(n), "members of a row");
  for(const std::uint32_t id : unions.member)
    check_equal(root_of(unions.target.data(), id), root_of(unions.target.data(), 0), "root of a row");
}

BOOST_AUTO_TEST_SUITE_END()
