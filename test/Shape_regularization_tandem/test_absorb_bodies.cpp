// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bodies of the end game, over the points, against naive versions of them, on
// several back ends: absorption, reassignment, components, and sums from the labels.

#undef NDEBUG

#include "body_fixture.h"

#include <CGAL/Tandem/internal/finish/components.h>

#include <map>
#include <set>

using namespace CGAL::Tandem::internal;

template <class Backend>
class Absorb_bodies {
public:
  Absorb_bodies(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f) {}

  void run()
  {
    test_offers();
    test_rounds();
    test_reassignment();
    test_take_chosen();
    test_components();
    test_sums();
  }

private:
  // Both ends of a relation offer; the nearest shape wins, then the smallest.
  void test_offers()
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::set<std::pair<std::uint64_t, std::uint32_t>>> offers(n);
    auto make = [&](std::uint32_t i, std::uint32_t q) {
      if(f_.label[i] < first_mark && f_.label[q] >= first_mark && f_.fits(f_.label[i], q))
        offers[q].emplace(f_.distance(f_.label[i], q) >> 16, f_.label[i]);
    };
    for(std::uint32_t i = 0; i < n; ++i)
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        make(i, q);
        make(q, i);
      });
    std::vector<std::uint32_t> label = f_.label, expected = label, offered(n), end = {0, 0, 0}, expected_offered;
    for(std::uint32_t i = 0; i < n; ++i)
      if(!offers[i].empty()) {
        expected[i] = offers[i].begin()->second;
        expected_offered.push_back(i);
      }
    std::vector<std::uint8_t> state(n, 0);
    std::vector<std::uint64_t> offer(n, no_proposal);
    Offer<Backend> pass = {f_.cloud,     label.data(), state.data(),   f_.plane.data(),
                           offer.data(), f_.tolerance, offered.data(), end.data() + 1};
    backend_.for_each(n, pass);
    const Offered first = {offered.data(), end.data()};
    const std::size_t items = 7;
    backend_.for_each(items, Accept_proposals{{label.data(), state.data()}, offer.data(), first, items});
    check_lists(label, expected, name_ + ": absorption");
    CHECK_AT(std::count(offer.begin(), offer.end(), no_proposal) == std::ptrdiff_t(n), name_ + ": offers that stay");
    const std::uint32_t size = end[1];
    std::sort(offered.begin(), offered.begin() + size);
    check_lists(std::vector<std::uint32_t>(offered.begin(), offered.begin() + size), expected_offered,
                name_ + ": points that got offers");
    for(std::uint32_t i = 0; i < n; i += 2) // so that there are many to pass offers on to
      if(!std::binary_search(expected_offered.begin(), expected_offered.end(), i))
        label[i] = free_label;
    test_offers_again({pass, {label.data(), state.data()}, first, size - 1}, items, size);
  }

  // The points that were absorbed pass offers of their shapes on, once each, unless they were few.
  void test_offers_again(Absorption<Backend> rounds, std::size_t items, std::uint32_t size)
  {
    const Offer<Backend>& pass = rounds.offer;
    const Offered& absorbed = rounds.offered;
    std::set<std::uint32_t> expected;
    for(std::uint32_t at = 0; at < size; ++at) {
      const std::uint32_t i = absorbed.point[at], s = pass.label[i];
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        if(pass.label[q] >= first_mark && f_.fits(s, q))
          expected.insert(q);
      });
    }
    CHECK_AT(!rounds.is_last(0), name_ + ": no offers again");
    backend_.for_each(items, rounds.propose_again(0, items));
    const std::set<std::uint32_t> got(absorbed.point + size, absorbed.point + absorbed.end[2]);
    CHECK_AT(absorbed.end[2] - size == got.size() && got == expected, name_ + ": points that get offers later");
    CHECK_AT(2 * expected.size() >= size, name_ + ": there are too few of these");
    rounds.few = size;
    CHECK_AT(rounds.is_last(0), name_ + ": few points pass offers on");
  }

  using Offers = std::map<std::uint32_t, std::pair<std::uint64_t, std::uint32_t>>; // the best one, by point

  // From a point that has a shape to its neighbors.
  void make_offers(const std::vector<std::uint32_t>& label, std::uint32_t i, Offers& offers) const
  {
    f_.for_each_neighbor(i, [&](std::uint32_t q) { make_offer(label, i, q, offers); });
  }

  void make_offer(const std::vector<std::uint32_t>& label, std::uint32_t from, std::uint32_t to, Offers& offers) const
  {
    const std::uint32_t s = label[from];
    if(s >= first_mark || label[to] < first_mark || !f_.fits(s, to))
      return;
    const auto offer = std::make_pair(f_.distance(s, to) >> 16, s);
    const auto found = offers.emplace(to, offer);
    found.first->second = (std::min)(found.first->second, offer);
  }

  // Round by round. Returns how many points joined shapes in each.
  std::vector<std::size_t> absorb_naively(std::vector<std::uint32_t>& label, std::size_t maximum_rounds,
                                          std::size_t few) const
  {
    Offers offers;
    for(std::uint32_t i = 0; i < label.size(); ++i)
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        make_offer(label, i, q, offers);
        make_offer(label, q, i, offers);
      });
    std::vector<std::size_t> joined;
    while(joined.size() < maximum_rounds && (joined.empty() || joined.back() > few)) {
      for(const auto& offer : offers)
        label[offer.first] = offer.second.second;
      joined.push_back(offers.size());
      Offers next;
      for(const auto& offer : offers)
        make_offers(label, offer.first, next);
      offers.swap(next);
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
    const std::vector<std::size_t> joined = absorb_naively(all, 16, 0);
    if(n < 100)
      return; // nobody joins anybody
    CHECK_AT(joined.size() > 3, name_ + ": there are too few rounds");
    const std::pair<std::size_t, std::size_t> ends[] = {{16, 0}, {2, 0}, {16, joined[1]}};
    for(const auto& end : ends) {
      std::vector<std::uint32_t> expected = sparse, label = sparse, offered(n), counters(end.first + 2, 0);
      absorb_naively(expected, end.first, end.second);
      std::vector<std::uint8_t> state(n, 0);
      std::vector<std::uint64_t> offer(n, no_proposal);
      const Offer<Backend> first = {f_.cloud,     label.data(), state.data(),   f_.plane.data(),
                                    offer.data(), f_.tolerance, offered.data(), counters.data() + 1};
      backend_.for_each(n, first);
      run_label_propagation(
        backend_, end.first,
        Absorption<Backend>{first, {label.data(), state.data()}, {offered.data(), counters.data()}, end.second});
      check_lists(label, expected, name_ + ": rounds of absorption");
      CHECK_AT((label == all) == (end.first == 16 && end.second == 0), name_ + ": the end of absorption");
    }
  }

  // The largest of the shapes that are not much farther than the nearest one.
  void test_reassignment()
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::int64_t> size;
    std::vector<std::uint8_t> may_lose, may_gain, state(n, 0);
    for(std::size_t s = 0; s < f_.plane.size(); ++s) {
      size.push_back(std::int64_t(s * 7 % 10));
      may_lose.push_back(s % 3 != 0);
      may_gain.push_back(s % 4 != 0);
    }
    std::vector<std::uint32_t> chosen(n), expected = f_.label;
    for(std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t own = f_.label[i];
      if(own >= first_mark || !may_lose[own])
        continue;
      std::set<std::uint32_t> shapes = {own};
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        const std::uint32_t t = f_.label[q];
        if(t < first_mark && may_gain[t] && f_.fits(t, i))
          shapes.insert(t);
      });
      std::int64_t least = f_.distance(own, i);
      for(std::uint32_t t : shapes)
        least = (std::min)(least, std::int64_t(f_.distance(t, i)));
      std::set<std::pair<std::int64_t, std::uint32_t>> choice;
      for(std::uint32_t t : shapes)
        if(std::int64_t(f_.distance(t, i)) <= least + f_.tolerance.distance / 4)
          choice.emplace(-size[t], t);
      expected[i] = choice.begin()->second;
    }
    backend_.for_each(n, Choose_largest{f_.cloud, f_.label.data(), state.data(), f_.plane.data(), size.data(),
                                        may_lose.data(), may_gain.data(), chosen.data(), f_.tolerance});
    check_lists(chosen, expected, name_ + ": reassignment");
  }

  // Every third point goes to the next shape.
  void test_take_chosen()
  {
    const std::uint32_t shapes = std::uint32_t(f_.plane.size());
    std::vector<std::uint32_t> label = f_.label, chosen = label;
    std::vector<std::uint8_t> state(label.size(), interior_bit | failed_seed_bit), expected_state = state;
    std::vector<Shared_moments> change(shapes), expected(shapes);
    for(std::uint32_t i = 0; i < f_.cloud.size; i += 3)
      if(label[i] < first_mark && shapes > 1) {
        chosen[i] = (label[i] + 1) % shapes;
        expected_state[i] = failed_seed_bit;
        add_point(expected[label[i]], f_.point[i], -1);
        add_point(expected[chosen[i]], f_.point[i], 1);
      }
    backend_.template for_each_cell<Moment_table>(
      f_.cells.size(),
      Take_chosen<Backend>{f_.cloud, f_.cells.data(), chosen.data(), {label.data(), state.data()}, change.data()});
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
    Tandem_state<Backend> t(backend_);
    take_cloud(f_, t);
    find_border(t);
    find_components(t, f_.label.data(), component.data());
    check_lists(component, expected, name_ + ": components");
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
  test_on_all_backends<Absorb_bodies>();
  return report();
}
