// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bodies of growth, over the points, against naive versions of them, on several back ends: proposals, and growth in
// the cells.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/growth/grow_shapes.h>
#include <CGAL/Tandem/internal/shapes/Seeds.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_growth_bodies)

using namespace CGAL::Tandem::internal;

template <class Backend>
class Growth_bodies {
public:
  Growth_bodies(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f) {}

  void run()
  {
    test_planarity();
    test_propose();
    test_growth();
  }

private:
  // How planar the surface is within the own tolerance of each point, and the same within tighter bounds.
  void test_planarity()
  {
    const Tolerance tight = {f_.tolerance.distance / 3, (f_.tolerance.squared_cosine + (std::int64_t(1) << 32)) / 2};
    std::size_t differing = 0;
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const Plane own = own_plane(f_.point[i]);
      const Tolerance at = f_.tolerance_of(i), tight_at = f_.level.empty() ? tight : tight.at(f_.level[i]);
      int all = 0, fitting = 0, close = 0, within_epsilon = 0;
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        ++all;
        fitting += fits(own, f_.point[q], at);
        close += fits(own, f_.point[q], tight_at);
        within_epsilon += fits(own, f_.point[q], f_.tolerance);
      });
      const Planarity p = planarity(f_.cloud, i, f_.tolerance, tight);
      CHECK_AT(p.all == all && p.fitting == fitting && p.close == close, name_ + ": planarity");
      differing += fitting != within_epsilon;
    }
    CHECK_AT(f_.cloud.size < 1000 || (differing > 50) == !f_.level.empty(),
             name_ + ": own tolerances matter at " + std::to_string(differing));
  }

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
      rounds.push_back(std::uint16_t(s % 3 == 0 ? tuning::growth::maximum_steps : int(s % 5)));
    const std::vector<std::uint32_t> expected = flood_fill(label, state, rounds);
    std::vector<std::uint8_t> is_restarted(plane.size(), 0);
    std::vector<Shared_moments> delta(plane.size()), expected_delta(plane.size());
    for(std::size_t i = 0; i < label.size(); ++i)
      if(label[i] != expected[i])
        add_point(expected_delta[expected[i]], f_.point[i], 1, f_.level_of(i));
    // No points of the border, no seeds.
    const std::vector<Range> border(f_.cells.size(), Range{0, 0});
    const std::vector<std::uint32_t> none(f_.cells.size(), 0);
    const std::vector<Cell_shapes> lists = f_.list_shapes(label);
    const Cells_view cells = {f_.cells.data(), lists.data()};
    const Cell_tables tables = {cells, {border.data(), nullptr, nullptr}, {nullptr, none.data(), cursor.data()}};
    const Grow_cells<Backend> body = {f_.cloud,
                                      {plane.data(), rounds.data(), is_restarted.data(), delta.data()},
                                      {label.data(), state.data()},
                                      {f_.tolerance, 8, 64, 7, 7, 0},
                                      tables,
                                      0};
    if(std::all_of(f_.cells.begin(), f_.cells.end(), [](const Range& r) { return r.size() <= small_cell; }))
      backend_.template for_each_cell<Growth_scratch<small_cell>>(f_.cells.size(), body);
    else
      backend_.template for_each_cell<Growth_scratch<largest_cell>>(f_.cells.size(), body);
    check_lists(label, expected, name_ + ": growth");
    check_moments(delta, expected_delta, name_ + ": growth");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

BOOST_AUTO_TEST_CASE(all_cases) { test_with_levels_on_all_backends<Growth_bodies>(); }

BOOST_AUTO_TEST_SUITE_END()
