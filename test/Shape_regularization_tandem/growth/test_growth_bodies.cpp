// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bodies of growth, over the points, against naive versions of them, on several back ends: proposals, and growth in
// the cells. And what a pass of growth makes of the table of shapes: shapes that grow, start, or go out of use.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/growth/grow_shapes.h>
#include <CGAL/Tandem/internal/shapes/Seeds.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_growth_bodies)

using namespace CGAL::Tandem::internal;

// How planar the surface is within the own tolerance of each point.
BOOST_AUTO_TEST_CASE(planarity_of_points)
{
  for(const Fixture& f : fixtures()) {
    std::size_t differing = 0;
    for(std::uint32_t i = 0; i < f.cloud.size; ++i) {
      const Plane own = own_plane(f.point[i]);
      const Tolerance at = f.tolerance_of(i);
      int all = 0, fitting = 0, within_epsilon = 0;
      f.for_each_neighbor(i, [&](std::uint32_t q) {
        ++all;
        fitting += fits(own, f.point[q], at);
        within_epsilon += fits(own, f.point[q], f.tolerance);
      });
      const Planarity p = planarity(f.cloud, i, f.tolerance);
      CHECK_AT(p.all == all && p.fitting == fitting, f.name + ": planarity");
      differing += fitting != within_epsilon;
    }
    CHECK_AT(f.cloud.size < 1000 || (differing > 50) == !f.level.empty(), f.name + ": own tolerances matter");
  }
}

BOOST_AUTO_TEST_CASE(proposals)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    std::vector<std::uint32_t> border, expected;
    for(std::uint32_t i = 0; i < f.cloud.size; i += 2) {
      border.push_back(i);
      std::set<std::pair<std::uint64_t, std::uint32_t>> proposed;
      f.for_each_neighbor(i, [&](std::uint32_t q) {
        if(f.label[i] == free_label && f.label[q] < first_mark && f.fits(f.label[q], i))
          proposed.emplace(f.distance(f.label[q], i), f.label[q]);
      });
      expected.push_back(proposed.empty() ? no_index : proposed.begin()->second);
    }
    std::vector<std::uint32_t> proposal(border.size());
    backend.for_each(border.size(),
                     Propose{f.cloud, f.label.data(), f.plane.data(), border.data(), proposal.data(), f.tolerance});
    check_lists(proposal, expected, name);
  });
}

// From all surfels of restarted shapes, layer by layer, in each cell alone; ties go to the smallest shape.
std::vector<std::uint32_t> flood_fill(const Fixture& f, std::vector<std::uint32_t> label,
                                      const std::vector<std::uint8_t>& is_restarted)
{
  for(const Range& cell : f.cells) {
    std::vector<std::uint32_t> frontier;
    for(std::uint32_t i = cell.first; i < cell.last; ++i)
      if(label[i] < first_mark && is_restarted[label[i]])
        frontier.push_back(i);
    while(!frontier.empty()) {
      std::map<std::uint32_t, std::uint32_t> claims;
      for(std::uint32_t i : frontier)
        f.for_each_neighbor(i, [&](std::uint32_t q) {
          if(q >= cell.first && q < cell.last && label[q] == free_label &&
             f.fits(label[i] % std::uint32_t(f.plane.size()), q))
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

BOOST_AUTO_TEST_CASE(growth_in_cells)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    // Three shapes of each plane, which race for its points.
    std::vector<std::uint32_t> label = f.label, cursor(f.cells.size(), 0);
    std::vector<std::uint8_t> state = f.state;
    const std::uint32_t faces = std::uint32_t(f.plane.size());
    for(std::size_t i = 0; i < label.size(); ++i)
      if(label[i] < first_mark)
        label[i] = i % 7 == 0 ? label[i] + faces * std::uint32_t(i % 3) : free_label;
    std::vector<Plane> plane;
    for(int copy = 0; copy < 3; ++copy)
      plane.insert(plane.end(), f.plane.begin(), f.plane.end());
    std::vector<std::uint8_t> is_restarted;
    for(std::size_t s = 0; s < plane.size(); ++s)
      is_restarted.push_back(s % 4 != 1);
    const std::vector<std::uint32_t> expected = flood_fill(f, label, is_restarted);
    std::vector<Shared_moments> delta(plane.size()), expected_delta(plane.size());
    for(std::size_t i = 0; i < label.size(); ++i)
      if(label[i] != expected[i])
        add_point(expected_delta[expected[i]], f.point[i], 1, f.level_of(i));
    // No points of the border, no seeds.
    const std::vector<Range> border(f.cells.size(), Range{0, 0});
    const std::vector<std::uint32_t> none(f.cells.size(), 0);
    const std::vector<Cell_shapes> lists = f.list_shapes(label);
    const Cells_view cells = {f.cells.data(), lists.data()};
    const Cell_tables tables = {cells, {border.data(), nullptr, nullptr}, {nullptr, none.data(), cursor.data()}};
    const Grow_cells<decltype(backend)> body = {f.cloud,
                                                {plane.data(), is_restarted.data(), delta.data()},
                                                {label.data(), state.data()},
                                                {f.tolerance, 7, 7, 0},
                                                tables,
                                                0};
    if(std::all_of(f.cells.begin(), f.cells.end(), [](const Range& r) { return r.size() <= small_cell; }))
      backend.template for_each_cell<Growth_scratch<small_cell>>(f.cells.size(), body);
    else
      backend.template for_each_cell<Growth_scratch<largest_cell>>(f.cells.size(), body);
    check_lists(label, expected, name);
    check_moments(delta, expected_delta, name);
  });
}

// Shapes 0 to size - 1 as they may be before a pass; a live one has some point.
template <class Is_live>
std::vector<Shape> shapes_before(std::uint32_t size, std::uint32_t room, Is_live is_live)
{
  std::vector<Shape> shapes(room); // some of the room may not be used
  for(std::uint32_t id = 0; id < size; ++id) {
    shapes[id].age = int(id % 11);
    shapes[id].is_active = id % 2 == 0;
    shapes[id].history.is_fitted = true;
    shapes[id].history.is_linked = true;
    if(is_live(id))
      shapes[id].moments.add({std::int32_t(id), 1, 2, no_normal}, 1);
  }
  return shapes;
}

// What a pass makes of the table: of few or many ids that are out of use, and of those that start in the pass. Each
// live one has some point before, and every fifth one gets no other. Without room the tables have to grow.
template <class Backend>
void check_pass(Backend& backend, const std::string& where, const Fixture& f, bool is_sparse, std::uint32_t room)
{
  constexpr std::uint32_t size = 60, ids = 101;
  const auto is_live = [=](std::uint32_t id) { return id < size && (id % 3 == 1) == is_sparse; };
  const std::vector<Shape> before = shapes_before(size, room, is_live);
  std::vector<Plane> plane(room, {0, 0, 0, 99999});
  for(std::uint32_t id = 0; id < size; ++id)
    plane[id].d = id;
  std::vector<Shared_moments> delta(ids);
  std::vector<std::uint32_t> label = f.label;
  std::size_t new_points = 0;
  for(std::uint32_t i = 0; i < label.size(); ++i) {
    const std::uint32_t id = i % ids;
    label[i] = is_live(id) || (id >= size && id % 4 == 2) ? id : f.label[i] >= first_mark ? f.label[i] : free_label;
    if(label[i] == id && id % 5 != 0) {
      add_point(delta[id], f.point[i], 1);
      ++new_points;
    } else if(label[i] == id && id >= size)
      label[i] = locked_label;
  }
  Labeled_cloud<Backend> points(backend);
  take_cloud(f, points);
  set_labels(points, label);
  auto shapes = make_table(backend, before);
  shapes.size = size;
  shapes.plane = to_buffer(backend, plane);
  shapes.is_restarted = filled_buffer(backend, room, std::uint8_t(1));
  shapes.delta = to_buffer(backend, delta);
  const auto untried_cells = filled_buffer(backend, 1, std::uint32_t(7));
  const Growth_counts counts = take_growth(points, shapes, ids, untried_cells.data());
  check_equal(counts.points, new_points, where + ": new points");
  check_equal(counts.untried_cells, std::size_t(7), where + ": untried cells");
  std::vector<std::uint32_t> old, new_id(ids, no_index); // ids before, by new id, and the other way round
  for(std::uint32_t id = 0; id < ids; ++id)
    if(id < size ? is_live(id) || !is_sparse : is_any(delta[id])) {
      new_id[id] = std::uint32_t(old.size());
      old.push_back(id);
    }
  check_equal(shapes.size, old.size(), where + ": ids");
  CHECK_AT((std::min)({shapes.table().size(), shapes.plane.size(), shapes.is_restarted.size()}) >= old.size(),
           where + ": room of the tables");
  for(std::size_t s = 0; s < old.size() && shapes.size == old.size(); ++s) {
    const std::string at = where + ", shape " + std::to_string(old[s]);
    const bool is_new = old[s] >= size, is_used = is_new || is_live(old[s]), is_active = is_any(delta[old[s]]);
    Shape expected = is_new ? Shape() : before[old[s]];
    expected.moments += delta[old[s]].moments();
    const Shape& got = shapes.table()[s];
    const Box& box = delta[old[s]].box;
    CHECK_AT(are_equal(got.moments, expected.moments), at + ": moments");
    CHECK_AT(got.box.low[0] == box.low[0] && got.box.high[2] == box.high[2], at + ": box");
    check_equal(shapes.plane[s].d, is_new ? Plane().d : plane[old[s]].d, at + ": plane");
    check_equal(int(shapes.is_restarted[s]), int(is_new), at + ": restart");
    check_equal(got.age, expected.age + is_used, at + ": age");
    CHECK_AT(!is_used || ((got.is_active != 0) == is_active && got.history.is_fitted == !is_active &&
                          got.history.is_linked == !is_active),
             at + ": changes");
  }
  for(std::uint32_t& l : label)
    l = l < first_mark ? new_id[l] : l;
  check_lists(to_vector(backend, points.label(), label.size()), label, where + ": labels");
  CHECK_AT(std::none_of(shapes.delta.begin(), shapes.delta.end(), is_any), where + ": deltas that stay");
}

BOOST_AUTO_TEST_CASE(passes)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    for(bool is_sparse : {false, true})
      for(std::uint32_t room : {60u, 500u})
        check_pass(backend, name + (is_sparse ? ": few shapes, room " : ": shapes, room ") + std::to_string(room), f,
                   is_sparse, room);
  });
}

BOOST_AUTO_TEST_SUITE_END()
