// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unions in rounds of mutual choice: on all back ends what a slow definition gives, which fits every link anew in every
// round, in any order of the links.

#include "testing/fragments.h"
#include "testing/verdict_of.h"

#include <algorithm>
#include <map>
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

template <class Backend>
Outcome unite(Backend& backend, int unevenness, unsigned seed)
{
  Fragments<Backend> fragments = make_fragments(backend, unevenness);
  const Shape_table<Backend>& shapes = fragments.shapes;
  std::uint32_t rounds = 0;
  const Shape_unions<Backend> unions = unite(backend, fragments, make_links(seed), &rounds);
  Outcome outcome;
  outcome.rounds = int(rounds);
  for(std::uint32_t id = 0; id < shapes.size; ++id) {
    const std::uint32_t root = root_of(unions.target.data(), id), place = unions.root[root].place;
    outcome.root.push_back(root);
    outcome.sample.push_back(fragments.samples.data()[root]);
    outcome.plane.push_back(place == no_index ? shapes.table()[root].local : unions.whole[place].local);
  }
  return outcome;
}

template <class Backend>
void check(Backend& backend, int unevenness, const Outcome& expected, const std::string& name)
{
  const Outcome outcome = unite(backend, unevenness, 7);
  check_equal(outcome.rounds, expected.rounds, name + ": rounds");
  CHECK_AT(outcome.root == expected.root, name);
  CHECK_AT(are_same(outcome.plane, expected.plane), name + ": planes");
  CHECK_AT(std::equal(outcome.sample.begin(), outcome.sample.end(), expected.sample.begin(),
                      [](const Shape_sample& a, const Shape_sample& b) { return are_equal(a, b); }),
           name + ": samples");
}

// What is to be found: more unions than `few` and fewer than `many`.
struct Scene {
  int unevenness;
  std::size_t few, many;
};

void check_scene(const Scene& scene)
{
  Sequential_backend sequential;
  const Outcome expected = Slow_unions(make_fragments(sequential, scene.unevenness), make_links(5)).outcome();
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

BOOST_AUTO_TEST_CASE(all_cases)
{
  constexpr std::size_t all = columns * rows;
  for(const Scene& scene :
      {Scene{level, 9, 11}, {0, 2, all / 3}, {1, all / 30, all / 3}, {2, all / 10, all / 3}, {4, all - 30, all}})
    check_scene(scene);
}

BOOST_AUTO_TEST_SUITE_END()
