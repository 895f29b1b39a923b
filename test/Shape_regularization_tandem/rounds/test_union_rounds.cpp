// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unions of rows and of many groups of shapes: few rounds, and the planes of all their points.

#include "testing/fragments.h"

#include <map>
#include <random>
#include <string>

BOOST_AUTO_TEST_SUITE(test_union_rounds)

using namespace CGAL::Tandem::internal;

// A square fragment, exactly level.
void add_fragment(Fragments<Sequential_backend>& fragments, int x, int y, int z, int size)
{
  std::mt19937 random(unsigned(fragments.shapes.size));
  Grid_points points;
  for(int i = 0; i < size; ++i) {
    const int u = int(random() % width), v = int(random() % width);
    points.push_back({x + u, y + v, z, upright});
  }
  fragments.add(points);
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

// Equal shapes in a row: all gains are equal at first, and most unions of a size. A number of rounds like that of the shapes would be
// quadratic in time.
BOOST_AUTO_TEST_CASE(check_row)
{
  constexpr int n = 2000;
  Sequential_backend backend;
  Fragments<Sequential_backend> fragments(backend, n);
  Link_list links;
  for(int i = 0; i < n; ++i) {
    add_fragment(fragments, i * width, 0, 0, 50);
    if(i > 0)
      links.push_back(link(std::size_t(i) - 1, std::size_t(i)));
  }
  std::uint32_t rounds = 0;
  const Shape_unions<Sequential_backend> unions = unite(backend, fragments, links, &rounds);
  CHECK_AT(rounds < 300, std::to_string(rounds) + " rounds");
  check_equal(unions.member.size(), std::size_t(n), "members of a row");
  for(const std::uint32_t id : unions.member)
    check_equal(root_of(unions.target.data(), id), root_of(unions.target.data(), 0), "root of a row");
  check_planes(fragments.shapes, unions);
}

// In each of many groups, two shapes unite first, and their union joins one that was in no union before.
BOOST_AUTO_TEST_CASE(check_groups)
{
  constexpr int n = 1000;
  Sequential_backend backend;
  Fragments<Sequential_backend> fragments(backend, 3 * n);
  Link_list links;
  for(int g = 0; g < n; ++g) {
    add_fragment(fragments, 0, 3 * g * width, 30, 100);
    add_fragment(fragments, width, 3 * g * width, 0, 30);
    add_fragment(fragments, 2 * width, 3 * g * width, 0, 30);
    const std::size_t first = 3 * std::size_t(g);
    links.push_back(link(first, first + 1));
    links.push_back(link(first + 1, first + 2));
  }
  const Shape_unions<Sequential_backend> unions = unite(backend, fragments, links);
  check_equal(unions.member.size(), std::size_t(3 * n), "members of groups");
  for(const std::uint32_t id : unions.member)
    check_equal(root_of(unions.target.data(), id), id / 3 * 3, "root of a group");
  check_planes(fragments.shapes, unions);
}

BOOST_AUTO_TEST_SUITE_END()
