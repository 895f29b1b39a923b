// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bodies of a round, over the points, against naive versions of them, on several
// back ends: proposals, growth, shapes of cells, links, misfits, and the update of labels.

#undef NDEBUG

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/rounds/Misfit_counter.h>
#include <CGAL/Tandem/internal/growth/grow_shapes.h>
#include <CGAL/Tandem/internal/shapes/links.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <map>
#include <set>

using namespace CGAL::Tandem::internal;

template <class Backend>
class Growth_bodies {
public:
  Growth_bodies(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f) {}

  void run()
  {
    test_propose();
    test_growth();
    test_lists();
    test_links();
    test_misfits();
    test_update();
  }

private:
  void test_propose()
  {
    std::vector<std::uint32_t> border, proposal, expected;
    for(std::uint32_t i = 0; i < f_.cloud.size; i += 2)
      border.push_back(i);
    for(std::uint32_t i : border) {
      std::set<std::pair<std::uint64_t, std::uint32_t>> proposals;
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        if(f_.label[i] == free_label && f_.label[q] < first_mark && f_.fits(f_.label[q], i))
          proposals.emplace(f_.distance(f_.label[q], i), f_.label[q]);
      });
      expected.push_back(proposals.empty() ? no_index : proposals.begin()->second);
    }
    proposal.resize(border.size());
    backend_.for_each(
      border.size(), Propose{f_.cloud, f_.label.data(), f_.plane.data(), border.data(), proposal.data(), f_.tolerance});
    check_lists(proposal, expected, name_ + ": Propose");
  }

  // Round by round, in each cell alone; ties go to the smallest shape.
  std::vector<std::uint32_t> flood_fill(std::vector<std::uint32_t> label, const std::vector<std::uint8_t>& state,
                                        const std::vector<std::uint16_t>& rounds) const
  {
    for(const Range& cell : f_.cells) {
      std::vector<std::uint32_t> frontier;
      for(std::uint32_t i = cell.first; i < cell.last; ++i)
        if(label[i] < first_mark && (state[i] & frontier_bit))
          frontier.push_back(i);
      for(int round = 0; !frontier.empty(); ++round) {
        std::map<std::uint32_t, std::uint32_t> claims;
        for(std::uint32_t i : frontier)
          f_.for_each_neighbor(i, [&](std::uint32_t q) {
            if(round < rounds[label[i]] && q >= cell.first && q < cell.last && label[q] == free_label &&
               f_.fits(label[i] % std::uint32_t(f_.plane.size()), q))
              claims[q] = claims.count(q) ? (std::min)(claims[q], label[i]) : label[i];
          });
        frontier.clear();
        for(const auto& claim : claims) {
          label[claim.first] = claim.second;
          frontier.push_back(claim.first);
        }
      }
    }
    return label;
  }

  void test_growth()
  {
    // Three shapes of each plane, which race for its points.
    std::vector<std::uint32_t> label = f_.label, cursor(f_.cells.size(), 0);
    std::vector<std::uint8_t> state = f_.state;
    const std::uint32_t faces = std::uint32_t(f_.plane.size());
    for(std::size_t i = 0; i < label.size(); ++i)
      if(label[i] < first_mark)
        label[i] = i % 7 == 0 ? label[i] + faces * std::uint32_t(i % 3) : free_label;
    std::vector<Plane> plane;
    for(int copy = 0; copy < 3; ++copy)
      plane.insert(plane.end(), f_.plane.begin(), f_.plane.end());
    std::vector<std::uint16_t> rounds;
    for(std::size_t s = 0; s < plane.size(); ++s)
      rounds.push_back(std::uint16_t(s % 3 == 0 ? 256 : s % 5));
    const std::vector<std::uint32_t> expected = flood_fill(label, state, rounds);
    std::vector<std::uint8_t> is_restarted(plane.size(), 0);
    std::vector<Shared_moments> delta(plane.size()), expected_delta(plane.size());
    for(std::size_t i = 0; i < label.size(); ++i)
      if(label[i] != expected[i])
        add_point(expected_delta[expected[i]], f_.point[i], 1);
    // No points of the border, no seeds.
    const std::vector<Range> border(f_.cells.size(), Range{0, 0});
    const std::vector<std::uint32_t> none(f_.cells.size(), 0);
    const std::vector<Cell_shapes> lists = f_.list_shapes(label);
    const Cells_view cells = {f_.cells.data(), lists.data()};
    const Cell_tables tables = {cells, border.data(), nullptr, nullptr, nullptr, none.data(), cursor.data()};
    const Grow_cells<Backend> body = {f_.cloud,
                                      {plane.data(), rounds.data(), is_restarted.data(), delta.data()},
                                      {label.data(), state.data()},
                                      {f_.tolerance, 8, 64, 7, 0},
                                      tables,
                                      none.data()};
    if(std::all_of(f_.cells.begin(), f_.cells.end(), [](const Range& r) { return r.size() <= small_cell; }))
      backend_.template for_each_cell<Growth_scratch<small_cell>>(f_.cells.size(), body);
    else
      backend_.template for_each_cell<Growth_scratch<largest_cell>>(f_.cells.size(), body);
    check_lists(label, expected, name_ + ": growth");
    check_moments(delta, expected_delta, name_ + ": growth");
  }

  // Of few shapes a cell, and of more than fit into a list.
  void test_lists()
  {
    std::vector<std::uint32_t> many(f_.label);
    for(std::size_t i = 0; i < many.size(); ++i)
      many[i] = i % 5 == 0 ? free_label : std::uint32_t(i);
    for(const std::vector<std::uint32_t>& label : {f_.label, many}) {
      std::vector<Cell_shapes> list(f_.cells.size());
      backend_.template for_each_cell<List_scratch>(f_.cells.size(),
                                                    List_shapes{f_.cells.data(), label.data(), list.data()});
      for(std::size_t c = 0; c < list.size(); ++c) {
        std::set<std::uint32_t> expected(label.begin() + f_.cells[c].first, label.begin() + f_.cells[c].last);
        expected.erase(expected.lower_bound(first_mark), expected.end());
        const std::size_t size = list[c].size;
        const std::set<std::uint32_t> got(list[c].shape,
                                          list[c].shape + (std::min)(size, std::size_t(Cell_shapes::capacity)));
        const bool is_complete = size == expected.size() && got == expected;
        const bool has_overflown = size > Cell_shapes::capacity && expected.size() > Cell_shapes::capacity;
        CHECK_AT(is_complete || has_overflown, name_ + ": shapes of cell " + std::to_string(c));
      }
    }
  }

  void test_links()
  {
    std::vector<std::uint8_t> state(f_.state.size(), 0), expected_state(state), is_selected;
    for(std::size_t s = 0; s < f_.plane.size(); ++s)
      is_selected.push_back(s % 4 != 1);
    std::map<std::uint64_t, std::uint32_t> expected, got;
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const std::uint32_t s = f_.label[i];
      if(s >= first_mark || !is_selected[s])
        continue;
      expected_state[i] = interior_bit;
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        const std::uint32_t t = f_.label[q];
        if(t != s)
          expected_state[i] = 0;
        if(t != s && t < first_mark)
          ++expected[std::uint64_t((std::min)(s, t)) << 32 | (std::max)(s, t)];
      });
    }
    Link_list links(f_.neighbor.size());
    std::uint32_t size = 0;
    std::vector<std::uint32_t> label = f_.label;
    backend_.template for_each_cell<Link_scratch>(
      f_.cells.size(), Collect_links<Backend>{f_.cloud,
                                              f_.cells_view(),
                                              {label.data(), state.data()},
                                              is_selected.data(),
                                              {links.data(), &size, std::uint32_t(links.size())}});
    for(std::uint32_t l = 0; l < size; ++l)
      got[links[l].pair] += links[l].count;
    CHECK_AT(got == expected && expected.size() > 3, name_ + ": links");
    check_lists(state, expected_state, name_ + ": interior points");
  }

  // The planes, shifted by half of epsilon.
  std::vector<Plane> moved_planes() const
  {
    std::vector<Plane> planes = f_.plane;
    for(Plane& p : planes)
      p.d += f_.tolerance.distance / 2;
    return planes;
  }

  void test_misfits()
  {
    const std::vector<Plane> after = moved_planes();
    std::vector<std::uint32_t> query_of, mask, expected;
    Unset_vector<Misfit_query> query;
    for(std::uint32_t s = 0; s < after.size(); ++s) {
      const bool is_selected = s % 4 != 3;
      query_of.push_back(is_selected ? std::uint32_t(query.size()) : no_index);
      if(is_selected)
        query.push_back({f_.plane[s], after[s]});
      mask.push_back(s % 5 == 4 ? no_sample : s % 4 == 2 ? 3 : s % 4);
    }
    expected.resize(query.size(), 0);
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const std::uint32_t s = f_.label[i], q = s < first_mark ? query_of[s] : no_index;
      if(q != no_index && (i & mask[s]) == 0)
        expected[q] += f_.fits(s, i) && !fits(after[s], f_.point[i], f_.tolerance);
    }
    std::vector<std::uint32_t> count(query.size(), 0);
    std::vector<Sample> sample(f_.cloud.size);
    std::vector<Range> range(f_.cells.size());
    std::uint32_t samples = 0, expected_samples = 0;
    backend_.template for_each_cell<Count_scratch>(
      range.size(), Collect_samples<Backend>{f_.cloud, f_.cells_view(), f_.label.data(), mask.data(), sample.data(),
                                             &samples, range.data()});
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i)
      expected_samples += f_.label[i] < first_mark && (i & mask[f_.label[i]]) == 0;
    check_equal(samples, expected_samples, name_ + ": samples");
    backend_.template for_each_cell<Count_scratch>(
      range.size(), Count_misfits<Backend>{f_.cells_view(), sample.data(), range.data(), query_of.data(), query.data(),
                                           count.data(), f_.tolerance});
    check_lists(count, expected, name_ + ": misfits");
    CHECK_AT(f_.cloud.size < 100 || std::count(count.begin(), count.end(), 0u) < long(count.size()),
             name_ + ": no misfits");
  }

  void test_update()
  {
    const std::vector<Plane> plane = moved_planes();
    std::vector<std::uint32_t> target, label = f_.label, expected = label;
    std::vector<std::uint8_t> is_checked, state = f_.state;
    for(std::uint32_t s = 0; s < plane.size(); ++s) {
      target.push_back(s % 5 == 0 ? free_label : s % 5 == 1 ? 2 : s);
      is_checked.push_back(s % 2);
    }
    std::vector<Shared_moments> loss(plane.size()), expected_loss(plane.size());
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const std::uint32_t old = label[i], s = old < first_mark ? target[old] : old;
      expected[i] = s;
      if(s < first_mark && is_checked[old] && !fits(plane[s], f_.point[i], f_.tolerance)) {
        expected[i] = state[i] & detached_bit ? locked_label : free_label;
        add_point(expected_loss[s], f_.point[i], -1);
      }
    }
    std::vector<Cell_shapes> lists = f_.lists;
    lists[0].size = Cell_shapes::capacity + 1; // of all shapes, maybe: stays so
    backend_.template for_each_cell<Update_scratch>(f_.cells.size(),
                                                    Update_points<Backend>{f_.cloud,
                                                                           f_.cells.data(),
                                                                           lists.data(),
                                                                           {label.data(), state.data()},
                                                                           target.data(),
                                                                           is_checked.data(),
                                                                           plane.data(),
                                                                           loss.data(),
                                                                           f_.tolerance});
    check_lists(label, expected, name_ + ": update");
    CHECK_AT(lists[0].size == Cell_shapes::capacity + 1, name_ + ": a list that has overflown");
    for(std::size_t c = 1; c < lists.size(); ++c) {
      std::multiset<std::uint32_t> relabeled;
      for(std::uint32_t i = 0; i < f_.lists[c].size; ++i)
        if(target[f_.lists[c].shape[i]] < first_mark)
          relabeled.insert(target[f_.lists[c].shape[i]]);
      CHECK_AT(f_.lists[c].size <= Cell_shapes::capacity &&
                 relabeled == std::multiset<std::uint32_t>(lists[c].shape, lists[c].shape + lists[c].size),
               name_ + ": list of cell " + std::to_string(c) + " after an update");
    }
    check_moments(loss, expected_loss, name_ + ": update");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

int main()
{
  test_on_all_backends<Growth_bodies>();
  return report();
}
