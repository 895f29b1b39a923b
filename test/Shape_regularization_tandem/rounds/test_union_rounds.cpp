// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unions of rows and of many groups of shapes: few rounds, and the planes of all their points. And what is rejected without
// a fit would have been rejected with it.

#undef NDEBUG

#include "testing/fragments.h"

#include <map>
#include <random>
#include <string>

using namespace CGAL::Tandem::internal;

void check_apart(std::int32_t shift)
{
  Sequential_backend backend;
  Shape_table<Sequential_backend> shapes;
  make_fragments(backend, shapes, 0, shift);
  int rejected = 0, apart = 0;
  for(const Link& link : make_links(5)) {
    const Shape &a = shapes.table()[link.first()], &b = shapes.table()[link.second()];
    Fitted_moments joint;
    const bool is_rejected = !criterion.fit(a, b, joint), is_apart = criterion.are_apart(a, b);
    rejected += is_rejected;
    apart += is_apart;
    CHECK(!is_apart || (is_rejected && !criterion.is_tolerable(a, b.local) && !criterion.is_tolerable(b, a.local)));
    check_equal(criterion(a, b, joint), !is_rejected, "with and without the shortcut");
  }
  CHECK_AT(rejected > 200 && 3 * apart > rejected, std::to_string(apart) + " of " + std::to_string(rejected));
}

// A square fragment, exactly level. The table has room for it.
void add_fragment(Shape_table<Sequential_backend>& shapes, int x, int y, int z, int size)
{
  std::mt19937 random(unsigned(shapes.size));
  Shape& shape = shapes.table()[shapes.size++];
  shape = Shape();
  for(int i = 0; i < size; ++i)
    shape.moments.add({x + int(random() % width), y + int(random() % width), z, no_normal}, 1);
  refit(shape);
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

// Equal shapes in a row: all costs are 0, and most unions of a size. A number of rounds like that of the shapes would be
// quadratic in time.
void check_row()
{
  constexpr int n = 2000;
  Sequential_backend backend;
  Shape_table<Sequential_backend> shapes;
  shapes.table().reset(n);
  Link_list links;
  for(int i = 0; i < n; ++i) {
    add_fragment(shapes, i * width, 0, 0, 50);
    if(i > 0)
      links.push_back(link(std::size_t(i) - 1, std::size_t(i)));
  }
  std::uint32_t rounds = 0;
  const Shape_unions<Sequential_backend> unions = unite(backend, shapes, links, &rounds);
  CHECK_AT(rounds < 300, std::to_string(rounds) + " rounds");
  check_equal(unions.member.size(), std::size_t(n), "members of a row");
  for(const std::uint32_t id : unions.member)
    check_equal(root_of(unions.target.data(), id), root_of(unions.target.data(), 0), "root of a row");
  check_planes(shapes, unions);
}

// In each of many groups, two shapes unite first, and their union joins one that was in no union before.
void check_groups()
{
  constexpr int n = 1000;
  Sequential_backend backend;
  Shape_table<Sequential_backend> shapes;
  shapes.table().reset(3 * n);
  Link_list links;
  for(int g = 0; g < n; ++g) {
    add_fragment(shapes, 0, 3 * g * width, 5, 100);
    add_fragment(shapes, width, 3 * g * width, 0, 30);
    add_fragment(shapes, 2 * width, 3 * g * width, 0, 30);
    const std::size_t first = 3 * std::size_t(g);
    links.push_back(link(first, first + 1));
    links.push_back(link(first + 1, first + 2));
  }
  const Shape_unions<Sequential_backend> unions = unite(backend, shapes, links);
  check_equal(unions.member.size(), std::size_t(3 * n), "members of groups");
  for(const std::uint32_t id : unions.member)
    check_equal(root_of(unions.target.data(), id), id / 3 * 3, "root of a group");
  check_planes(shapes, unions);
}

int main()
{
  check_apart(0);
  check_apart(1 << 30);
  check_row();
  check_groups();
  return report();
}
