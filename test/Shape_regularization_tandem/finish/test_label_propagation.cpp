// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bodies of the end game, over the points, against naive versions of them, on
// several back ends: label propagation, reassignment, components, and sums from the labels.

#undef NDEBUG

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/finish/end_game.h>

#include <map>
#include <set>

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
    test_reassignment();
    test_take_chosen();
    test_components();
    test_sums();
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

  // Until few points join a shape in a round, or for so many rounds.
  void test_rounds()
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::uint32_t> sparse(n, free_label);
    for(std::uint32_t i = 0; i < n; i += 61)
      sparse[i] = f_.label[i];
    std::vector<std::uint32_t> all = sparse;
    const std::vector<std::size_t> joined = propagate_naively(all, 16, 0);
    if(n < 100)
      return; // nobody joins anybody
    CHECK_AT(joined.size() > 3, name_ + ": there are too few rounds");
    const std::pair<std::size_t, std::size_t> ends[] = {{16, 0}, {2, 0}, {16, joined[1]}};
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
      CHECK_AT((label == all) == (end.first == 16 && end.second == 0), name_ + ": the end of label propagation");
    }
  }

  // The distance of two planes along their normals, where they are nearest to a point.
  std::int64_t distance_of_planes(std::uint32_t s, std::uint32_t t, std::uint32_t i) const
  {
    const Plane &a = f_.plane[s], &b = f_.plane[t];
    const double cosine = double(a.nx) * b.nx + double(a.ny) * b.ny + double(a.nz) * b.nz;
    const std::int64_t e = signed_distance(a, f_.point[i]), f = signed_distance(b, f_.point[i]);
    return std::abs(cosine < 0 ? e + f : e - f);
  }

  // The largest of the shapes that are no layers beside the nearest one.
  void test_reassignment()
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::int64_t> size;
    std::vector<std::uint8_t> may_lose, may_receive, state(n, 0);
    for(std::size_t s = 0; s < f_.plane.size(); ++s) {
      size.push_back(std::int64_t(s * 7 % 10));
      may_lose.push_back(s % 3 != 0);
      may_receive.push_back(s % 4 != 0);
    }
    std::vector<std::uint32_t> chosen(n), expected = f_.label;
    for(std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t own = f_.label[i];
      if(own >= first_mark || !may_lose[own])
        continue;
      std::set<std::uint32_t> shapes = {own};
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        const std::uint32_t t = f_.label[q];
        if(t < first_mark && may_receive[t] && f_.fits(t, i))
          shapes.insert(t);
      });
      std::set<std::pair<std::int64_t, std::uint32_t>> nearest, choice;
      for(std::uint32_t t : shapes)
        nearest.emplace(f_.distance(t, i), t);
      const std::int64_t epsilon = f_.tolerance.distance, least = nearest.begin()->first;
      for(std::uint32_t t : shapes)
        if(std::int64_t(f_.distance(t, i)) <= least + epsilon / 4 ||
           10 * distance_of_planes(nearest.begin()->second, t, i) <= 9 * epsilon)
          choice.emplace(-size[t], t);
      expected[i] = choice.begin()->second;
    }
    backend_.for_each(n, Choose_largest{f_.cloud, f_.label.data(), state.data(), f_.plane.data(), size.data(),
                                        may_lose.data(), may_receive.data(), chosen.data(), f_.tolerance});
    check_lists(chosen, expected, name_ + ": reassignment");
  }

  // Every third point goes to the next shape.
  void test_take_chosen()
  {
    const std::uint32_t shapes = std::uint32_t(f_.plane.size());
    std::vector<std::uint32_t> label = f_.label, chosen = label;
    std::vector<std::uint8_t> state(label.size(), interior_bit | tried_seed_bit), expected_state = state;
    std::vector<Shared_moments> change(shapes), expected(shapes);
    for(std::uint32_t i = 0; i < f_.cloud.size; i += 3)
      if(label[i] < first_mark && shapes > 1) {
        chosen[i] = (label[i] + 1) % shapes;
        expected_state[i] = tried_seed_bit;
        add_point(expected[label[i]], f_.point[i], -1);
        add_point(expected[chosen[i]], f_.point[i], 1);
      }
    backend_.template for_each_cell<Moment_table>(
      f_.cells.size(),
      Apply_chosen<Backend>{f_.cloud, f_.cells.data(), chosen.data(), {label.data(), state.data()}, change.data()});
    check_lists(label, chosen, name_ + ": labels that were chosen");
    check_lists(state, expected_state, name_ + ": states of points that change");
    check_moments(change, expected, name_ + ": points that change");
  }

  // By repeated propagation of the smallest position.
  void test_components()
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::uint32_t> component(n), expected(n);
    for(std::uint32_t i = 0; i < n; ++i)
      expected[i] = i;
    for(bool is_changed = true; is_changed;) {
      is_changed = false;
      for(std::uint32_t r = 0; r < n; ++r) {
        std::map<std::uint32_t, std::uint32_t> least; // by label, over the point and its neighbors
        auto look = [&](std::uint32_t q) {
          if(f_.label[q] < first_mark) {
            std::uint32_t& smallest = least.emplace(f_.label[q], expected[q]).first->second;
            smallest = (std::min)(smallest, expected[q]);
          }
        };
        auto take = [&](std::uint32_t q) {
          if(f_.label[q] < first_mark && expected[q] != least[f_.label[q]]) {
            expected[q] = least[f_.label[q]];
            is_changed = true;
          }
        };
        look(r);
        f_.for_each_neighbor(r, look);
        take(r);
        f_.for_each_neighbor(r, take);
      }
    }
    Labeled_cloud<Backend> points(backend_);
    const std::size_t cell_size = take_cloud(f_, points);
    find_border(points);
    find_components(points, cell_size, f_.label.data(), component.data());
    check_lists(component, expected, name_ + ": components");
    test_small_components(points, component);
  }

  // Points of components of less than three points become free; before that, interior bits are cleared, and no others.
  void test_small_components(Labeled_cloud<Backend>& points, const std::vector<std::uint32_t>& component)
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::uint32_t> label = f_.label, expected = f_.label;
    std::vector<std::uint8_t> state(n, interior_bit | tried_seed_bit);
    std::map<std::uint32_t, std::uint32_t> size; // by root
    for(std::uint32_t i = 0; i < n; ++i)
      size[component[i]] += f_.label[i] < first_mark;
    for(std::uint32_t i = 0; i < n; ++i)
      if(expected[i] < first_mark && size[component[i]] < 3)
        expected[i] = free_label;
    const auto sizes = component_sizes(points, label.data(), component.data());
    backend_.for_each(n, Clear_interior{state.data()});
    backend_.for_each(n, Free_small_components{component.data(), sizes.data(), 3, label.data()});
    check_lists(label, expected, name_ + ": labels without small components");
    CHECK_AT(label != f_.label, name_ + ": no component is small");
    check_lists(state, std::vector<std::uint8_t>(n, tried_seed_bit), name_ + ": states without small components");
  }

  void test_sums()
  {
    std::vector<Shared_moments> sum(f_.plane.size()), expected(f_.plane.size());
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i)
      if(f_.label[i] < first_mark)
        add_point(expected[f_.label[i]], f_.point[i], 1);
    backend_.template for_each_cell<Moment_table>(
      f_.cells.size(), Sum_moments<Backend>{f_.cloud, f_.cells.data(), f_.label.data(), sum.data()});
    check_moments(sum, expected, name_ + ": sums");
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
