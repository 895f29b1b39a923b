// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Square fragments of roofs and of level ground side by side, their links, and their unions, of which the tables are
// checked.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_FRAGMENTS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_FRAGMENTS_H

#include "body_fixture.h"
#include "same_bits.h"

#include <CGAL/Tandem/internal/rounds/unite_shapes.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

constexpr int columns = 60, rows = 50, width = 1000; // of square fragments, in grid steps
constexpr double maximum_distance = 60;

const Joint_fit_criterion criterion = {.95, maximum_distance};

// Level ground is exactly flat, so all costs are 0 there, and sizes and ids decide.
constexpr int level = -1;

// Roofs of three slopes and a few steps, so that some neighbors have one plane, some nearly, some not: the more
// uneven, the fewer.
inline std::int32_t height(int x, int y, int unevenness, std::mt19937& random)
{
  if(unevenness == level)
    return 300 * (y / (5 * width));
  const int slope = x < 20 * width ? x / 8 : x < 40 * width ? 2500 - (x - 20 * width) / 10 : 500;
  const int step = 70 * (y / (5 * width)) + unevenness * (37 * (x / width % 7) + 61 * (y / width % 5));
  return slope + step + int(random() % 60);
}

using Link_list = std::vector<Link>;

template <class Backend>
void make_fragments(Backend& backend, Shape_table<Backend>& shapes, int unevenness, std::int32_t shift = 0)
{
  std::mt19937 random(3);
  shapes.size = columns * rows;
  shapes.table() = filled_buffer(backend, shapes.size, Shape());
  for(int id = 0; id < columns * rows; ++id) {
    Shape& shape = shapes.table()[std::size_t(id)];
    const int size = unevenness == level ? 20 + 30 * int(random() % 3) * int(random() % 3) : 20 + int(random() % 200);
    for(int i = 0; i < size; ++i) {
      const int x = id % columns * width + int(random() % width), y = id / columns * width + int(random() % width);
      shape.moments.add({x + shift, y + shift, height(x, y, unevenness, random) + shift, no_normal}, 1);
    }
    refit(shape);
  }
}

// Between neighbors in rows, columns and one diagonal, in random order.
inline Link_list make_links(unsigned seed)
{
  Link_list links;
  for(std::uint32_t id = 0; id < columns * rows; ++id)
    for(const std::uint32_t other : {id + 1, id + columns, id + columns + 1})
      if(other < columns * rows && (other == id + columns || id % columns + 1 < columns))
        links.push_back({std::uint64_t(id) << 32 | other, 1});
  std::shuffle(links.begin(), links.end(), std::mt19937(seed));
  return links;
}

template <class Backend>
Shape_unions<Backend> unite(Backend& backend, Shape_table<Backend>& shapes, const Link_list& links,
                            std::uint32_t* rounds = nullptr)
{
  shapes.set_fitted();
  Shape_unions<Backend> unions =
    unite_shapes(backend, Ranks<Backend>(backend), shapes, criterion, to_buffer(backend, links));
  if(rounds != nullptr)
    *rounds = to_vector(backend, unions.total).front();
  CHECK(std::is_sorted(unions.member.begin(), unions.member.end(), std::less_equal<std::uint32_t>()));
  for(const Shared_moments& d : shapes.delta)
    CHECK(d.count == 0 && d.sum[0] == 0 && d.low[5] == 0 && d.high[5] == 0);
  std::map<std::uint32_t, int> members;
  for(const std::uint32_t id : unions.member)
    ++members[root_of(unions.target.data(), id)];
  for(const auto& m : members)
    CHECK(m.second > 1 && std::binary_search(unions.member.begin(), unions.member.end(), m.first));
  for(std::uint32_t id = 0; id < shapes.size; ++id)
    CHECK(std::binary_search(unions.member.begin(), unions.member.end(), id) || unions.target[id] == id);
  return unions;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_FRAGMENTS_H
