// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unions of touching shapes where Joint_fit_criterion.h accepts one plane for both, in rounds of mutual choice. Works
// on the host and changes nothing but itself; merge_by_joint_fit.h tests the points and merges. See the manual,
// "Merging by Joint Fit".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_MUTUAL_UNIONS_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_MUTUAL_UNIONS_H

#include <CGAL/Tandem/internal/rounds/Joint_fit_criterion.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>
#include <CGAL/Tandem/internal/shapes/links.h>

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// A number of its own for each pair of ids. In the order of the ids, equal shapes in a row would join one after the
// other, one in a round.
inline std::uint64_t mixed_ids(std::uint32_t a, std::uint32_t b)
{
  const std::uint64_t pair = std::uint64_t(a) << 32 | b, mixed = pair * 0x9e3779b97f4a7c15u;
  return (mixed ^ mixed >> 32) * 0x9e3779b97f4a7c15u;
}

// Each shape chooses the link of the smallest key: the cost of the joint fit, then the larger union, then the mixed
// ids. Two shapes that choose each other become one. A shape that tolerates the plane of a much larger one joins it
// without being chosen, so a large shape takes all of these in one round. All unions of a round are independent, then
// they are fitted and their links tested anew, until no two shapes join. The link of the smallest key is chosen by both
// of its shapes, so each round has a union as long as there is a link that is accepted. No order matters.
template <class Backend>
class Mutual_unions {
public:
  Mutual_unions(Backend& backend, const Shape_table<Backend>& shapes, const Joint_fit_criterion& test)
    : backend_(backend), shapes_(shapes), test_(test), target_(identity_targets(shapes.size())),
      whole_(shapes.size(), no_index), choice_(shapes.size(), no_index), is_changed_(shapes.size(), 1)
  {}

  // Returns the number of rounds.
  int unite_along(const Link_list& links)
  {
    pairs_.resize(links.size());
    backend_.for_each_on_host(links.size(), [&](std::size_t i) {
      pairs_[i] = {links[i].first(), links[i].second(), Verdict()};
    });
    int rounds = 0;
    do {
      ++rounds;
      test_pairs();
      choose();
    } while(join());
    return rounds;
  }

  // The next three are valid after unite_along(). Whether other shapes are in the union of this one.
  bool is_merged(std::uint32_t id) const { return whole_[root(id)] != no_index; }

  std::uint32_t root(std::uint32_t id) const
  {
    while(target_[id] != id)
      id = target_[id];
    return id;
  }

  const Fitted_moments& whole(std::uint32_t root) const
  {
    return whole_[root] == no_index ? static_cast<const Fitted_moments&>(shapes_[root]) : merged_[whole_[root]];
  }

private:
  // Two roots, and what the test says of them. The first one has more points, or as many and the smaller id.
  struct Pair {
    std::uint32_t first, second;
    Verdict verdict;
  };

  // A root with one of its pairs.
  struct Incidence {
    std::uint32_t shape, pair;
  };

  // Pairs of shapes that have changed get new roots and a new verdict.
  void test_pairs()
  {
    backend_.for_each_on_host(pairs_.size(), [&](std::size_t i) {
      Pair& p = pairs_[i];
      const bool is_old =
        target_[p.first] == p.first && target_[p.second] == p.second && !is_changed_[p.first] && !is_changed_[p.second];
      if(is_old)
        return;
      p.first = root(p.first);
      p.second = root(p.second);
      if(is_before(p.second, p.first))
        std::swap(p.first, p.second);
      p.verdict = p.first == p.second ? Verdict() : test_.verdict(whole(p.first), whole(p.second));
    });
    pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(), [](const Pair& p) { return p.first == p.second; }),
                 pairs_.end());
    std::fill(is_changed_.begin(), is_changed_.end(), 0);
  }

  bool is_before(std::uint32_t a, std::uint32_t b) const
  {
    const std::int64_t na = whole(a).moments.count, nb = whole(b).moments.count;
    return na > nb || (na == nb && a < b);
  }

  // Each shape its pair of the smallest key.
  void choose()
  {
    incidences_.clear();
    for(std::uint32_t i = 0; i < pairs_.size(); ++i)
      if(pairs_[i].verdict.is_accepted) {
        incidences_.push_back({pairs_[i].first, i});
        incidences_.push_back({pairs_[i].second, i});
      }
    backend_.sort_on_host(incidences_.begin(), incidences_.end(), [](const Incidence& a, const Incidence& b) {
      return std::tie(a.shape, a.pair) < std::tie(b.shape, b.pair);
    });
    backend_.for_each_on_host(incidences_.size(), [&](std::size_t first) {
      const std::uint32_t shape = incidences_[first].shape;
      if(first > 0 && incidences_[first - 1].shape == shape)
        return;
      std::uint32_t best = incidences_[first].pair;
      for(std::size_t i = first + 1; i < incidences_.size() && incidences_[i].shape == shape; ++i)
        if(key(incidences_[i].pair) < key(best))
          best = incidences_[i].pair;
      choice_[shape] = best;
    });
  }

  std::tuple<double, std::int64_t, std::uint64_t> key(std::uint32_t pair) const
  {
    const Pair& p = pairs_[pair];
    return {p.verdict.cost, -whole(p.first).moments.count - whole(p.second).moments.count,
            mixed_ids(p.first, p.second)};
  }

  // The unions of the round. Returns whether there was any.
  bool join()
  {
    std::vector<std::uint64_t> joins; // the root that stays << 32 | the one that joins it
    for(const Incidence& i : incidences_) {
      const std::uint32_t stays = pairs_[i.pair].first;
      if(i.pair == choice_[i.shape] && i.shape != stays && is_joined(pairs_[i.pair]))
        joins.push_back(std::uint64_t(stays) << 32 | i.shape);
    }
    std::sort(joins.begin(), joins.end());
    Ids grown;
    for(std::uint64_t j : joins) {
      const std::uint32_t stays = std::uint32_t(j >> 32), joining = std::uint32_t(j);
      if(grown.empty() || grown.back() != stays)
        grown.push_back(stays);
      Fitted_moments& joint = own_whole(stays); // may move the others, so it comes before whole()
      joint.moments += whole(joining).moments;
      target_[joining] = stays;
    }
    backend_.for_each_on_host(grown.size(), [&](std::size_t i) {
      refit(merged_[whole_[grown[i]]]);
      is_changed_[grown[i]] = 1;
    });
    return !joins.empty();
  }

  // Whether the second shape of the pair, which has chosen it, joins the first one. That one has chosen it, too, or it
  // takes shapes in this round: otherwise its plane is about to change.
  bool is_joined(const Pair& p) const
  {
    const Pair& choice = pairs_[choice_[p.first]];
    return choice.first == p.first && (choice.second == p.second || (p.verdict.is_taken && choice.verdict.is_taken));
  }

  Fitted_moments& own_whole(std::uint32_t root)
  {
    if(whole_[root] == no_index) {
      whole_[root] = std::uint32_t(merged_.size());
      merged_.push_back(shapes_[root]);
    }
    return merged_[whole_[root]];
  }

  Backend& backend_;
  const Shape_table<Backend>& shapes_;
  const Joint_fit_criterion test_;
  Targets target_;                    // by shape: what it has joined, or itself
  std::vector<std::uint32_t> whole_;  // index into merged_, by root
  std::vector<std::uint32_t> choice_; // index into pairs_, by root
  std::vector<std::uint8_t> is_changed_;
  std::vector<Fitted_moments> merged_;
  std::vector<Pair> pairs_;
  std::vector<Incidence> incidences_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_MUTUAL_UNIONS_H
