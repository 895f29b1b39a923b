// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Label propagation, over the points, against naive versions of it on several back ends: proposals, rounds, and the whole.

#undef NDEBUG

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/finish/propagate_labels.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::Tandem::internal;

template <class Backend>
class Label_propagation_bodies {
public:
  Label_propagation_bodies(Backend& backend, const std::string& name, const Fixture& f)
    : backend_(backend), name_(name), f_(f)
  {}

  void run()
  {
    test_proposals();
    test_rounds();
    test_propagation();
  }

private:
  // Both ends of a relation propose; the nearest shape wins, then the smallest.
  void test_proposals()
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::set<std::pair<std::uint64_t, std::uint32_t>>> proposals(n);
    auto make = [&](std::uint32_t i, std::uint32_t q) {
      if(f_.label[i] < first_mark && f_.label[q] >= first_mark && f_.fits(f_.label[i], q))
        proposals[q].emplace(f_.distance(f_.label[i], q) >> 16, f_.label[i]);
    };
    for(std::uint32_t i = 0; i < n; ++i)
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        make(i, q);
        make(q, i);
      });
    std::vector<std::uint32_t> label = f_.label, expected = label, proposed(n), end = {0, 0, 0}, expected_proposed;
    for(std::uint32_t i = 0; i < n; ++i)
      if(!proposals[i].empty()) {
        expected[i] = proposals[i].begin()->second;
        expected_proposed.push_back(i);
      }
    std::vector<std::uint8_t> state(n, 0);
    std::vector<std::uint64_t> proposal(n, no_proposal);
    Propose_label<Backend> pass = {f_.cloud,        label.data(), state.data(),    f_.plane.data(),
                                   proposal.data(), f_.tolerance, proposed.data(), end.data() + 1};
    backend_.for_each(n, pass);
    const Proposed_points first = {proposed.data(), end.data()};
    const std::size_t items = 7;
    backend_.for_each(items, Accept_proposals{{label.data(), state.data()}, proposal.data(), first, items});
    check_lists(label, expected, name_ + ": label propagation");
    CHECK_AT(std::count(proposal.begin(), proposal.end(), no_proposal) == std::ptrdiff_t(n),
             name_ + ": proposals that stay");
    const std::uint32_t size = end[1];
    std::sort(proposed.begin(), proposed.begin() + size);
    check_lists(std::vector<std::uint32_t>(proposed.begin(), proposed.begin() + size), expected_proposed,
                name_ + ": points that got proposals");
    for(std::uint32_t i = 0; i < n; i += 2) // so that there are many to pass proposals on to
      if(!std::binary_search(expected_proposed.begin(), expected_proposed.end(), i))
        label[i] = free_label;
    test_proposals_again({pass, {label.data(), state.data()}, first, size - 1}, items, size);
  }

  // The points that joined a shape pass proposals of their shapes on, once each, unless they were few.
  void test_proposals_again(Label_propagation<Backend> rounds, std::size_t items, std::uint32_t size)
  {
    const Propose_label<Backend>& pass = rounds.proposal;
    const Proposed_points& joined = rounds.proposed;
    std::set<std::uint32_t> expected;
    for(std::uint32_t at = 0; at < size; ++at) {
      const std::uint32_t i = joined.point[at], s = pass.label[i];
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        if(pass.label[q] >= first_mark && f_.fits(s, q))
          expected.insert(q);
      });
    }
    CHECK_AT(!rounds.is_last(0), name_ + ": no proposals again");
    backend_.for_each(items, [&](std::size_t lane) { rounds.run(rounds.propose, 0, lane, items); });
    const std::set<std::uint32_t> got(joined.point + size, joined.point + joined.end[2]);
    CHECK_AT(joined.end[2] - size == got.size() && got == expected, name_ + ": points that get proposals later");
    CHECK_AT(2 * expected.size() >= size, name_ + ": there are too few of these");
    rounds.few_points = size;
    CHECK_AT(rounds.is_last(0), name_ + ": few points pass proposals on");
  }

  using Proposals = std::map<std::uint32_t, std::pair<std::uint64_t, std::uint32_t>>; // the best one, by point

  // From a point that has a shape to its neighbors.
  void make_proposals(const std::vector<std::uint32_t>& label, std::uint32_t i, Proposals& proposals) const
  {
    f_.for_each_neighbor(i, [&](std::uint32_t q) { make_proposal(label, i, q, proposals); });
  }

  void make_proposal(const std::vector<std::uint32_t>& label, std::uint32_t from, std::uint32_t to,
                     Proposals& proposals) const
  {
    const std::uint32_t s = label[from];
    if(s >= first_mark || label[to] < first_mark || !f_.fits(s, to))
      return;
    const auto proposal = std::make_pair(f_.distance(s, to) >> 16, s);
    const auto found = proposals.emplace(to, proposal);
    found.first->second = (std::min)(found.first->second, proposal);
  }

  // Round by round. Returns how many points joined shapes in each.
  std::vector<std::size_t> propagate_naively(std::vector<std::uint32_t>& label, std::size_t maximum_rounds,
                                             std::size_t few) const
  {
    Proposals proposals;
    for(std::uint32_t i = 0; i < label.size(); ++i)
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        make_proposal(label, i, q, proposals);
        make_proposal(label, q, i, proposals);
      });
    std::vector<std::size_t> joined;
    while(joined.size() < maximum_rounds && (joined.empty() || joined.back() > few)) {
      for(const auto& proposal : proposals)
        label[proposal.first] = proposal.second.second;
      joined.push_back(proposals.size());
      Proposals next;
      for(const auto& proposal : proposals)
        make_proposals(label, proposal.first, next);
      proposals.swap(next);
    }
    return joined;
  }

  // Few points have theirs.
  std::vector<std::uint32_t> sparse_labels() const
  {
    std::vector<std::uint32_t> sparse(f_.cloud.size, free_label);
    for(std::uint32_t i = 0; i < sparse.size(); i += 61)
      sparse[i] = f_.label[i];
    return sparse;
  }

  // Until few points join a shape in a round, or for so many rounds.
  void test_rounds()
  {
    const std::uint32_t n = f_.cloud.size;
    const std::vector<std::uint32_t> sparse = sparse_labels();
    std::vector<std::uint32_t> all = sparse;
    constexpr std::size_t rounds = tuning::end_game::propagation_rounds;
    const std::vector<std::size_t> joined = propagate_naively(all, rounds, 0);
    if(n < 100)
      return; // nobody joins anybody
    CHECK_AT(joined.size() > 3, name_ + ": there are too few rounds");
    const std::pair<std::size_t, std::size_t> ends[] = {{rounds, 0}, {2, 0}, {rounds, joined[1]}};
    for(const auto& end : ends) {
      std::vector<std::uint32_t> expected = sparse, label = sparse, proposed(n), counters(end.first + 2, 0);
      propagate_naively(expected, end.first, end.second);
      std::vector<std::uint8_t> state(n, 0);
      std::vector<std::uint64_t> proposal(n, no_proposal);
      const Propose_label<Backend> first = {f_.cloud,        label.data(), state.data(),    f_.plane.data(),
                                            proposal.data(), f_.tolerance, proposed.data(), counters.data() + 1};
      backend_.for_each(n, first);
      backend_.run_rounds(end.first, n,
                          Label_propagation<Backend>{
                            first, {label.data(), state.data()}, {proposed.data(), counters.data()}, end.second});
      check_lists(label, expected, name_ + ": rounds of label propagation");
      CHECK_AT((label == all) == (end.first == rounds && end.second == 0), name_ + ": the end of label propagation");
    }
  }

  // The whole of it, with the numbers of rounds and of points of the end game.
  void test_propagation()
  {
    const std::uint32_t n = f_.cloud.size;
    const std::vector<std::uint32_t> sparse = sparse_labels();
    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    set_labels(points, sparse, std::vector<std::uint8_t>(n, tried_seed_bit));
    Shape_table<Backend> shapes;
    shapes.size = f_.plane.size();
    shapes.plane = to_buffer(backend_, f_.plane);
    propagate_labels(points, shapes, f_.tolerance, Phase::end);
    CHECK_AT(!shapes.has_moments() && !points.has_lists(), name_ + ": tables that follow from labels");
    std::vector<std::uint32_t> expected = sparse;
    propagate_naively(expected, tuning::end_game::propagation_rounds, n / tuning::end_game::points_per_late_point);
    check_lists(to_vector(backend_, points.label(), n), expected, name_ + ": propagation");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

int main()
{
  test_on_all_backends<Label_propagation_bodies>();
  return report();
}
